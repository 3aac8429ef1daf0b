// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

/// One-point elements that change their group, with their history (fem/local_steps.h).
namespace ogive::fem
{
template <class Element>
bool OnePointGroup<Element>::steps_locally() const
{
  return !area_weighted && !corrected_ && alive_.empty();
}

template <class Element>
double OnePointGroup<Element>::half_power() const
{
  double sum = 0;
  for (std::size_t e = 0; e < n_; ++e)
    sum += share(e) * half_power_[e];
  return sum;
}

/// All that an element has of its own, however many values that is.
template <class Element>
template <class F>
void OnePointGroup<Element>::for_each_element_array(F &&f)
{
  points_.for_each_array([&](const char *, AlignedVector<double> &a) { f(a); });
  for (auto *a : {&mass_, &inertia_, &corner_mass_, &corner_force_, &Q_, &viscous_pressure_, &half_hourglass_,
                  &half_viscous_, &half_power_, &hourglass_energy_, &viscous_heat_, &damping_share_, &share_, &bound_})
    f(*a);
  for (auto &component : damping_stress_)
    f(component);
}

template <class Element>
void OnePointGroup<Element>::take_over(ElementGroup<dim>                                          &other,
                                       std::span<const std::pair<std::uint32_t, std::uint32_t>> moves)
{
  auto &from = dynamic_cast<OnePointGroup &>(other);
  std::vector<AlignedVector<double> *> theirs;
  from.for_each_element_array([&](AlignedVector<double> &a) { theirs.push_back(&a); });
  std::size_t k = 0;
  for_each_element_array([&](AlignedVector<double> &mine) {
    const AlignedVector<double> &a = *theirs[k++];
    const std::size_t            each = a.size() / from.padded_n_;
    if (each > 0 && mine.empty())
      mine.resize(each * padded_n_, 0.);
    for (const auto &[e, own] : moves)
      for (std::size_t i = 0; i < each; ++i)
        mine[slot(own, i, each)] = a[slot(e, i, each)];
  });
}

/// The last pack is filled up with copies of the last element.
template <class Element>
void OnePointGroup<Element>::settle()
{
  for_each_element_array([&](AlignedVector<double> &a) {
    const std::size_t each = a.size() / padded_n_;
    for (std::size_t e = n_; e < padded_n_; ++e)
      for (std::size_t i = 0; i < each; ++i)
        a[slot(e, i, each)] = a[slot(n_ - 1, i, each)];
  });
  const auto most = std::max_element(bound_.begin(), bound_.begin() + static_cast<std::ptrdiff_t>(n_));
  limit_          = {*most, static_cast<double>(most - bound_.begin())};
  sum_forces();
}

#define OGIVE_INSTANTIATE(E)                                                                                 \
  template bool   OnePointGroup<E>::steps_locally() const;                                                   \
  template double OnePointGroup<E>::half_power() const;                                                      \
  template void   OnePointGroup<E>::take_over(ElementGroup<E::dim> &,                                        \
                                            std::span<const std::pair<std::uint32_t, std::uint32_t>>);       \
  template void   OnePointGroup<E>::settle();
OGIVE_INSTANTIATE(Line2)
OGIVE_INSTANTIATE(Quad4)
OGIVE_INSTANTIATE(Quad4Axisymmetric)
OGIVE_INSTANTIATE(Quad4AreaWeighted)
OGIVE_INSTANTIATE(Hex8)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
