// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

/// The acceleration correction of the bulk viscosity: with a the accelerations
/// that the weak viscosity alone would give the nodes, its forces are replaced by
/// sum_b M_ab (a_a - a_b) between the corners of each element, M_ab >= 0 the
/// entries of a mass matrix whose row sums are the corner masses at most. A node
/// then feels how its acceleration departs from a convex mean of its neighbours'.
/// Pairs are equal and opposite, so momentum is exact; their work is heat of the
/// element, so energy is.
namespace ogive::fem
{
/// 1 - psi, psi = clamp(L |D|/(c M0), 0, 1) where the element is compressed.
template <class Element>
VDouble OnePointGroup<Element>::weak_share(const VDouble &length, const VDouble &rate,
                                           const VDouble &sound_speed) const
{
  if (!split_)
    return VDouble(1.);
  return 1. - stdx::min(VDouble(length * rate / (sound_speed * options_.split_compression)), VDouble(1.));
}

/// Adds the corner forces of a viscous pressure alone to the nodes.
template <class Element>
void OnePointGroup<Element>::add_weak(std::size_t pack, const Shape &shape, const VDouble &pressure)
{
  const std::size_t lanes = std::min(width, n_ - pack * width);
  VDouble           B[corners][dim];
  corner_areas(shape, B);
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
    {
      VDouble force = pressure * B[a][i];
      if constexpr (Element::hoop)
        if (i == 0)
          force += pressure * shape.hoop[a];
      for (std::size_t lane = 0; lane < lanes; ++lane)
        weak_force_[i][node_[(pack * corners + a) * width + lane] - first_node_] += force[lane];
    }
}

/// sum_b M_ab (a_a - a_b), N. A brick, box or line takes the consistent mass
/// matrix of the undistorted element, a product of [2 1; 1 2]/3 along each axis;
/// rings the least of the two corner masses times the same shares.
template <class Element>
void OnePointGroup<Element>::pair_forces(std::size_t pack, const Corners &acceleration, Corners &force) const
{
  constexpr auto across = [](int a, int axis) { return axis == 0 ? a ^ 1 : axis == 1 ? a ^ 3 : a ^ 4; };
  if constexpr (Element::hoop)
  {
    VDouble mass[corners];
    for (int a = 0; a < corners; ++a)
    {
      mass[a] = load(&corner_mass_[(pack * corners + a) * width]);
      std::fill(std::begin(force[a]), std::end(force[a]), VDouble(0.));
    }
    for (int a = 0; a < corners; ++a)
      for (int b = 0; b < a; ++b)
      {
        const VDouble shared = stdx::min(mass[a], mass[b]) * ((a ^ b) == 2 ? 1. / 9 : 2. / 9);
        for (int i = 0; i < dim; ++i)
        {
          const VDouble pair = shared * (acceleration[a][i] - acceleration[b][i]);
          force[a][i] += pair;
          force[b][i] -= pair;
        }
      }
  }
  else
  {
    const VDouble mass = load(&(inertia_.empty() ? mass_ : inertia_)[pack * width]) * (1. / corners);
    for (int i = 0; i < dim; ++i)
    {
      VDouble mean[corners], next[corners];
      for (int a = 0; a < corners; ++a)
        mean[a] = acceleration[a][i];
      for (int axis = 0; axis < dim; ++axis)
      {
        for (int a = 0; a < corners; ++a)
          next[a] = (2. * mean[a] + mean[across(a, axis)]) * (1. / 3);
        std::copy(std::begin(next), std::end(next), std::begin(mean));
      }
      for (int a = 0; a < corners; ++a)
        force[a][i] = mass * (acceleration[a][i] - mean[a]);
    }
  }
}

/// Work of the element against the corrected forces of t_n, J: as internal_work.
template <class Element>
VDouble OnePointGroup<Element>::correction_work(std::size_t pack, const Corners &v, double kick) const
{
  Corners acceleration, force;
  gather(weak_acceleration_, pack, acceleration, first_node_);
  pair_forces(pack, acceleration, force);
  VDouble power = load(&half_correction_[pack * width]);
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
      power -= .5 * force[a][i] * v[a][i];
  return power * kick;
}

/// From the weak forces of all elements to the corrected forces at the nodes.
template <class Element>
void OnePointGroup<Element>::correct(const Nodes<dim> &nodes)
{
  if (shared_)
  {
    std::array<double *, dim> sums;
    for (int i = 0; i < dim; ++i)
      sums[i] = weak_force_[i].data();
    shared_->sum(sums, first_node_, first_node_ + weak_force_[0].size());
  }
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < weak_force_[i].size(); ++a) // a held component does not accelerate
      weak_acceleration_[i][a] =
        nodes.held[i][first_node_ + a] ? 0. : weak_force_[i][a] / nodes.mass[first_node_ + a];
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    Corners acceleration, v, force;
    gather(weak_acceleration_, pack, acceleration, first_node_);
    gather(nodes.v, pack, v);
    pair_forces(pack, acceleration, force);
    VDouble           power(0.);
    const std::size_t lanes = std::min(width, n_ - pack * width);
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i)
      {
        power -= .5 * force[a][i] * v[a][i];
        for (std::size_t lane = 0; lane < lanes; ++lane)
          nodal_force_[i][node_[(pack * corners + a) * width + lane] - first_node_] += force[a][i][lane];
      }
    store(power, &half_correction_[pack * width]);
  }
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
