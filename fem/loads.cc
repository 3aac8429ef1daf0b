// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/loads.h"

#include "fem/boundary_facets.h"

#include <algorithm>

namespace ogive::fem
{
template <int dim>
Loads<dim>::Loads(const Parameters &p, const std::vector<BodyMesh<dim>> &meshes,
                  const std::vector<std::size_t> &first_node, const Constraints<dim> &constraints)
    : axisymmetric_(p.axisymmetric)
{
  for (std::size_t b = 0; b < p.boundaries.size(); ++b)
  {
    const input::Boundary &boundary = p.boundaries[b];
    history_.push_back(boundary.history);
    for (std::size_t m = 0; m < meshes.size(); ++m)
    {
      if (meshes[m].body != p.boundary_bodies.at(b))
        continue;
      if (boundary.kind == input::BoundaryKind::pressure)
        for_each_facet(boundary, meshes[m], constraints, m,
                       [&](auto facet)
                       {
                         for (auto &node : facet.node)
                           node += static_cast<std::uint32_t>(first_node[m]);
                         pressures_.push_back({facet, boundary.pressure, b});
                       });
      if (boundary.kind == input::BoundaryKind::body_force)
        body_forces_.push_back(
            {first_node[m], first_node[m] + meshes[m].n_nodes(), b, boundary.acceleration});
    }
  }
}

template <int dim>
void Loads<dim>::gather(const Nodes<dim> &nodes, const Constraints<dim> &constraints, double time,
                        std::array<AlignedVector<double>, dim> &force) const
{
  for (auto &component : force)
    std::fill(component.begin(), component.end(), 0.);
  const auto feels = [&nodes](std::uint32_t a) { return nodes.feels(a); };
  for (const Pressure &load : pressures_)
  {
    if (std::none_of(load.facet.node.begin(), load.facet.node.end(), feels))
      continue;
    const double pressure = load.pressure * history_[load.boundary].at(time);
    for_each_area_share<dim>(nodes, load.facet, axisymmetric_,
                             [&](int a, const auto &area)
                             {
                               for (int i = 0; i < dim; ++i)
                                 force[i][load.facet.node[a]] -= pressure * area[i];
                             });
  }
  for (const BodyForce &load : body_forces_)
  {
    const double factor = history_[load.boundary].at(time);
    for (std::size_t a = load.first_node; a < load.last_node; ++a)
      for (int i = 0; i < dim && nodes.feels(a); ++i)
        force[i][a] += constraints.own_mass(nodes, a) * factor * load.acceleration[i];
  }
}

template class Loads<1>;
template class Loads<2>;
template class Loads<3>;
} // namespace ogive::fem
