// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

/// Damping in proportion to the stiffness, next to seams.
namespace ogive::fem
{
/// Adds the viscous stress of damp(); returns its share of stiffness, s. Its heat
/// is booked with that of the bulk viscosity.
template <class Element>
VDouble OnePointGroup<Element>::add_damping(std::size_t pack, const VDouble &length, const Motion &motion,
                                            VDouble (&sigma)[6])
{
  const std::size_t e       = pack * width;
  const VDouble     density = load(&points_.density[e]), c = load(&points_.sound_speed[e]);
  const VDouble     share   = load(&damping_share_[e]) * length / c;
  const double      shear   = shear_modulus_;
  const VDouble     lame    = density * c * c - 2. * shear;
  const VDouble     trace   = motion.dual[0] + motion.dual[1] + motion.dual[2];
  for (int k = 0; k < 6; ++k)
  {
    const VDouble viscous = share * (k < 3 ? VDouble(lame * trace + 2. * shear * motion.dual[k]) : VDouble(shear * motion.dual[k]));
    store(viscous, &damping_stress_[k][e]);
    sigma[k] += viscous;
  }
  return share;
}

/// Half of the work of the viscous stress in place on a strain, J/m^3.
template <class Element>
VDouble OnePointGroup<Element>::half_damping(std::size_t pack, const Motion &motion) const
{
  VDouble work(0.);
  for (int k = 0; k < 6; ++k)
    work += (k < 3 ? .5 : 1.) * load(&damping_stress_[k][pack * width]) * motion.strain[k];
  return work;
}

template <class Element>
void OnePointGroup<Element>::damp(std::span<const std::size_t> elements, double share)
{
  quiet_.wake();
  if ((!elements.empty() || shared_) && damping_share_.empty())
    prepare_damping();
  std::fill(damping_share_.begin(), damping_share_.end(), 0.);
  for (const std::size_t e : elements)
    for (std::size_t k = e; k < (e + 1 == n_ ? padded_n_ : e + 1); ++k)
      damping_share_[k] = share;
  if (!keeps_forces()) // the stress of t_n has still to do its work
    return;
  for (auto &component : damping_stress_)
    for (std::size_t k = 0; k < component.size(); ++k)
      component[k] *= damping_share_[k] > 0;
}

template <class Element>
void OnePointGroup<Element>::add_damping_stress(std::size_t e, materials::Points &to, std::size_t k) const
{
  for (std::size_t c = 0; c < 6 && !damping_share_.empty(); ++c)
    to.sigma[c][k] += damping_stress_[c][e];
}

template <class Element>
void OnePointGroup<Element>::prepare_damping()
{
  damping_share_.assign(padded_n_, 0.);
  for (auto &component : damping_stress_)
    component.assign(padded_n_, 0.);
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
