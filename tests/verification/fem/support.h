// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tests/unit/fem/support.h"

namespace ogive::fem::test
{
template <int dim>
Solver<dim> solver_for(const input::Body &body, const input::Scene &scene, const materials::Parameters &p)
{
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(make_mesh<dim>(body, scene, 0, make(p)));
  return Solver<dim>({scene.fem, scene.dimension == input::Dimension::axisymmetric, scene.symmetry, scene.walls,
                      scene.boundaries, std::vector<int>(scene.boundaries.size(), 0)},
                     std::move(meshes));
}

/// C1 of validation.md: the copper bar, 3.2 mm by 32.4 mm, that strikes at 227
/// m/s. Along y as a section, along z as a quarter.
inline input::Body taylor_bar(input::Dimension dimension, double spacing)
{
  const Vec3  axis  = dimension == input::Dimension::axisymmetric ? Vec3::UnitY() : Vec3::UnitZ();
  input::Body body  = box(Vec3::Zero(), Vec3::Zero(), spacing, -227 * axis);
  body.shape.kind   = input::ShapeKind::cylinder;
  body.shape.axis   = axis;
  body.shape.radius = 3.2e-3;
  body.shape.length = 32.4e-3;
  return body;
}
} // namespace ogive::fem::test
