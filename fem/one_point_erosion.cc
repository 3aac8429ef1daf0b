// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>
#include <cmath>
#include <utility>

/// One-point elements that leave the mesh: death, and before it turns into particles.
namespace ogive::fem
{
template <class Element>
void OnePointGroup<Element>::prepare_erosion(Nodes<dim> &nodes)
{
  own_ = node_;
  alive_.assign(padded_n_, 1.);
  // The grave has the shape of the heaviest element of all ranks: it never sets the step.
  const std::size_t heaviest = std::max_element(mass_.begin(), mass_.begin() + n_) - mass_.begin();
  if (n_ > 0)
  {
    model_.element = own_elements_ ? (*own_elements_)[heaviest] : heaviest;
    model_.mass    = mass_[heaviest];
    model_.inertia = inertia_.empty() ? 0. : inertia_[heaviest];
    for (int a = 0; a < corners; ++a)
    {
      model_.corner_mass[a] = Element::hoop ? corner_mass_[slot(heaviest, a, corners)] : 0.;
      for (int i = 0; i < dim; ++i)
        model_.x[a][i] = nodes.x0[i][node_[slot(heaviest, a, corners)]];
    }
  }
  if (shared_)
    for (const auto all = shared_->ranks().gather_one(std::exchange(model_, Model{})); const Model &other : all)
      if (other.mass > model_.mass || (other.mass == model_.mass && other.element < model_.element))
        model_ = other;
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
      nodes.x[i][grave_ + a] = nodes.x0[i][grave_ + a] = model_.x[a][i];
}

template <class Element>
void OnePointGroup<Element>::find_failed(const input::Erosion &when, std::vector<std::size_t> &failed) const
{
  for (std::size_t e = 0; e < n_; ++e)
    if (alive(e) && (points_.damage[e] >= 1 || (when.strain > 0 && points_.plastic_strain[e] >= when.strain) ||
                     (by_step_ && bound_[e] * when.step > 2)))
      failed.push_back(e);
}

template <class Element>
void OnePointGroup<Element>::measure(const input::Conversion &when, std::vector<double> &of) const
{
  of.assign(n_, 0.);
  const double rest = material_->density();
  for (std::size_t e = 0; e < n_; ++e)
  {
    if (!alive(e))
      continue;
    if (when.strain > 0)
      of[e] = std::max(of[e], points_.plastic_strain[e] / when.strain);
    if (when.damage > 0)
      of[e] = std::max(of[e], points_.damage[e] / when.damage);
    if (when.volume > 0)
      of[e] = std::max(of[e], std::abs(std::log(points_.density[e] / rest)) / when.volume);
    if (by_step_)
      of[e] = std::max(of[e], .5 * bound_[e] * when.step);
  }
}

template <class Element>
auto OnePointGroup<Element>::remains(std::size_t e) const -> Remains
{
  Remains r;
  for (int a = 0; a < corners; ++a)
    r.mass[a] = Element::hoop ? corner_mass_[slot(e, a, corners)] : (inertia_.empty() ? mass_ : inertia_)[e] / corners;
  r.internal_energy  = mass_[e] * points_.energy[e];
  r.hourglass_energy = hourglass_energy_[e];
  r.plastic_work     = mass_[e] * points_.plastic_work[e];
  return r;
}

template <class Element>
auto OnePointGroup<Element>::kill(std::size_t e) -> Remains
{
  const Remains gone = remains(e);

  // The last pack is filled up with copies of the last element.
  for (std::size_t k = e; k < (e + 1 == n_ ? padded_n_ : e + 1); ++k)
  {
    alive_[k] = 0;
    quiet_.moved(k / (width * block_packs));
    material_->initialise(points_, k, k + 1);
    for (AlignedVector<double> *field :
         {&viscous_pressure_, &half_power_, &half_hourglass_, &half_viscous_, &hourglass_energy_, &viscous_heat_})
      (*field)[k] = 0;
    for (int c = 0; c < corners * dim; ++c)
      corner_force_[slot(k, c, corners * dim)] = 0;
    for (int c = 0; c < modes * dim; ++c)
      Q_[slot(k, c, modes * dim)] = 0;
    mass_[k] = model_.mass;
    if (!inertia_.empty())
      inertia_[k] = model_.inertia;
    for (int a = 0; Element::hoop && a < corners; ++a)
      corner_mass_[slot(k, a, corners)] = model_.corner_mass[a];
    bury(k);
  }
  return gone;
}

template <class Element>
void OnePointGroup<Element>::sum_forces()
{
  find_rows();
  for (auto &component : nodal_force_)
    std::fill(component.begin(), component.end(), 0.);
  scatter(0, padded_n_ / width, corner_force_.data());
}

template <class Element>
void OnePointGroup<Element>::rebury()
{
  for (std::size_t e = 0; e < alive_.size(); ++e)
    bury(e);
  find_rows();
}

template <class Element>
void OnePointGroup<Element>::bury(std::size_t e)
{
  for (int a = 0; a < corners; ++a)
  {
    const std::size_t k = slot(e, a, corners);
    node_[k]            = alive_[e] > 0 ? own_[k] : static_cast<std::uint32_t>(grave_ + a);
  }
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
