// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/mesh.h"
#include "fem/solver.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// A surface node and the place on a facet that it is tied to.
template <int dim>
struct TiedNode
{
  static constexpr int                 n_masters = BodyMesh<dim>::Facet::n_nodes;
  std::uint32_t                        node;     ///< of the slave mesh
  std::array<std::uint32_t, n_masters> master{}; ///< of the master mesh
  std::array<double, n_masters>        weight{};
  double                               gap = 0; ///< m
};

/// Shape functions at the point of a facet nearest to `point`, and how far away
/// it is, m. Weights are within [0, 1]; those below 1e-9 are zero.
template <int dim>
double nearest_on_facet(const BodyMesh<dim> &, const typename BodyMesh<dim>::Facet &,
                        const std::array<double, dim>                     &point,
                        std::array<double, BodyMesh<dim>::Facet::n_nodes> &weight);

/// The surface nodes of `slave` that lie within `tolerance` longest edges of a
/// facet of `master`, each with the nearest facet (in one dimension: of the
/// element behind it).
template <int dim>
std::vector<TiedNode<dim>> find_tied(const BodyMesh<dim> &slave, const BodyMesh<dim> &master,
                                     double tolerance);

/// Facets of `mesh` whose centre lies within `tolerance` longest edges of a
/// facet of `other` that `of_other` marks.
template <int dim>
void mark_covered(const BodyMesh<dim> &mesh, const BodyMesh<dim> &other, const std::vector<bool> &of_other,
                  double tolerance, std::vector<bool> &covered);
} // namespace ogive::fem
