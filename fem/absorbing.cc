// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/absorbing.h"

#include "fem/boundary_facets.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace ogive::fem
{
template <int dim>
AbsorbingFaces<dim>::AbsorbingFaces(const Parameters &p, const std::vector<BodyMesh<dim>> &meshes,
                                    const std::vector<std::size_t> &first_node,
                                    const Constraints<dim>         &constraints)
    : axisymmetric_(p.axisymmetric)
{
  for (std::size_t b = 0; b < p.boundaries.size(); ++b)
    for (std::size_t m = 0; m < meshes.size(); ++m)
    {
      if (p.boundaries[b].kind != input::BoundaryKind::absorbing || meshes[m].body != p.boundary_bodies.at(b))
        continue;
      const materials::Material &material = *meshes[m].material;
      const double               normal   = material.density() * material.sound_speed();
      const double               shear    = std::sqrt(material.density() * material.shear_modulus());
      for_each_facet(p.boundaries[b], meshes[m], constraints, m,
                     [&](auto facet)
                     {
                       for (auto &node : facet.node)
                       {
                         node += static_cast<std::uint32_t>(first_node[m]);
                         slot(node);
                       }
                       facets_.push_back({facet, normal, shear});
                     });
    }
  for (std::size_t k = 0, n = nodes_.size(); k < n; ++k)
    constraints.for_each_master(nodes_[k], [&](std::uint32_t master, double) { slot(master); });
  damping_.resize(nodes_.size());
  impulse_.assign(nodes_.size(), Vector::Zero());
}

template <int dim>
std::size_t AbsorbingFaces<dim>::slot(std::uint32_t node)
{
  const auto [at, fresh] = slot_.try_emplace(node, nodes_.size());
  if (fresh)
    nodes_.push_back(node);
  return at->second;
}

template <int dim>
void AbsorbingFaces<dim>::apply(const TimeStep &step, const PrescribedMotion<dim> &prescribed,
                                const Constraints<dim> &constraints, Nodes<dim> &nodes,
                                const std::array<AlignedVector<double>, dim> &v_old)
{
  std::fill(damping_.begin(), damping_.end(), Matrix::Zero());
  const auto feels = [&nodes](std::uint32_t a) { return nodes.feels(a); };
  for (const Facet &f : facets_)
    if (std::any_of(f.facet.node.begin(), f.facet.node.end(), feels))
      for_each_area_share<dim>(nodes, f.facet, axisymmetric_,
                               [&](int a, const Vector &share)
                               {
                                 const double area = share.norm();
                                 if (area > 0)
                                   damping_[slot_.at(f.facet.node[a])] +=
                                       (f.normal - f.shear) / area * share * share.transpose() +
                                       f.shear * area * Matrix::Identity();
                               });
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    constraints.for_each_master(nodes_[k], [&](std::uint32_t master, double weight)
                                { damping_[slot_.at(master)] += weight * damping_[k]; });
  for (std::size_t k = 0; k < nodes_.size(); ++k)
  {
    const std::uint32_t a = nodes_[k];
    impulse_[k].setZero();
    if (constraints.is_slave(a) || !nodes.keeps(a))
      continue;
    Matrix C = damping_[k];
    Vector twice_mean;
    for (int i = 0; i < dim; ++i)
    {
      twice_mean[i] = nodes.v[i][a] + v_old[i][a];
      if (prescribed.prescribed(a, i))
      {
        C.row(i).setZero();
        C.col(i).setZero();
      }
    }
    const double per_mass = step.kick / nodes.mass[a];
    twice_mean            = (Matrix::Identity() + .5 * per_mass * C).inverse() * twice_mean;
    impulse_[k]           = -.5 * step.kick * C * twice_mean;
    for (int i = 0; i < dim; ++i)
      nodes.v[i][a] += impulse_[k][i] / nodes.mass[a];
  }
}

template <int dim>
void AbsorbingFaces<dim>::book(const Nodes<dim> &nodes, BoundaryWork &work) const
{
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for (int i = 0; i < dim && nodes.counts(nodes_[k]); ++i)
    {
      work.absorbed -= impulse_[k][i] * nodes.v_mean[i][nodes_[k]];
      work.impulse[i] += impulse_[k][i];
    }
}

template class AbsorbingFaces<1>;
template class AbsorbingFaces<2>;
template class AbsorbingFaces<3>;
} // namespace ogive::fem
