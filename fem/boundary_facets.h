// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "fem/constraints.h"
#include "fem/mesh.h"
#include "fem/nodes.h"

#include <Eigen/Geometry>

#include <numbers>
#include <string>

namespace ogive::fem
{
/// Calls f(facet) for the facets of a scene boundary on mesh `m` of the solver.
/// "all" is all of the surface: without cuts by symmetry planes; what a tie covers
/// is no surface. InputError if the body has no such face, or none that is free.
template <int dim, class F>
void for_each_facet(const input::Boundary &boundary, const BodyMesh<dim> &mesh,
                    const Constraints<dim> &constraints, std::size_t m, F &&f)
{
  bool found = false, open = false;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
  {
    const int b = mesh.facets[k].boundary;
    if (boundary.face == "all" ? mesh.boundary_names[b].starts_with("symmetry") : !mesh.is_called(b, boundary.face))
      continue;
    found = true;
    if (constraints.covered(m, k))
      continue;
    open = true;
    f(mesh.facets[k]);
  }
  if (found && !open)
    throw InputError({"", 0, boundary.name}, "a tie covers the face \"" + boundary.face + "\"",
                     "a free face");
  if (!found)
  {
    std::string names;
    for (const auto &name : mesh.boundary_names)
      names += (names.empty() ? "" : ", ") + name;
    throw InputError({"", 0, boundary.name}, "the body has no face \"" + boundary.face + "\"",
                     "one of: all, " + names);
  }
}

/// Calls f(corner, S) for the corners of a facet whose nodes are those of
/// `nodes`, with S the corner's share of the present outward area, m^2 (per
/// metre in plane strain, 1 in one dimension, of the whole ring in axial
/// symmetry: int N_a 2 pi r ds).
template <int dim, class F>
void for_each_area_share(const Nodes<dim> &nodes, const typename BodyMesh<dim>::Facet &facet,
                         bool axisymmetric, F &&f)
{
  using Vector = Eigen::Matrix<double, dim, 1>;
  const auto x = [&](int a, int i) { return nodes.x[i][facet.node[a]]; };
  if constexpr (dim == 1)
    f(0, Vector(facet.outward));
  else if constexpr (dim == 2)
    for (int a = 0; a < 2; ++a)
    {
      const double share = axisymmetric ? std::numbers::pi / 3 * (2 * x(a, 0) + x(1 - a, 0)) : .5;
      // Outside is on the right of a -> b.
      f(a, Vector(facet.weight[a] * share * Vector(x(1, 1) - x(0, 1), x(0, 0) - x(1, 0))));
    }
  else
  {
    Vector d1, d2;
    for (int i = 0; i < 3; ++i)
    {
      d1[i] = x(2, i) - x(0, i);
      d2[i] = x(3, i) - x(1, i);
    }
    const Vector quarter = .125 * d1.cross(d2);
    for (int a = 0; a < 4; ++a)
      f(a, Vector(facet.weight[a] * quarter));
  }
}
} // namespace ogive::fem
