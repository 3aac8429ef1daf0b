// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>
#include <cstring>

/// Blocks of one-point elements as a whole: those that nothing has reached
/// (quiet_blocks.h), and those that come next.
namespace ogive::fem
{
bool QuietBlocks::same_bits(const double *first, const double *last, const double *other)
{
  return std::memcmp(first, other, static_cast<std::size_t>(last - first) * sizeof(double)) == 0;
}

/// Calls f(array, entries an element) for the history of the elements.
template <class Element>
template <class F>
void OnePointGroup<Element>::for_each_history(F &&f)
{
  points_.for_each_array([&](const char *, AlignedVector<double> &a) { f(a, std::size_t(1)); });
  f(Q_, std::size_t(modes * dim));
  f(corner_force_, keeps_forces() ? std::size_t(corners * dim) : 0);
  for (auto *a : {&viscous_pressure_, &half_hourglass_, &half_viscous_, &half_power_, &hourglass_energy_, &viscous_heat_})
    f(*a, std::size_t(1));
  f(bound_, std::size_t(by_step_));
  for (auto &component : damping_stress_)
    f(component, std::size_t(!component.empty()));
}

/// Asks for the state of a block before it is needed: more arrays run side by
/// side than the processor follows by itself.
template <class Element>
void OnePointGroup<Element>::fetch(std::size_t begin, std::size_t count)
{
  constexpr std::size_t line = 64 / sizeof(double);
  const auto            ask  = [&](const AlignedVector<double> &a, std::size_t per_element) {
    const double *first = a.data() + begin * width * per_element, *last = first + count * width * per_element;
    for (; first < last; first += line)
      __builtin_prefetch(first);
  };
  for_each_history(ask);
  ask(mass_, 1);
}

/// Whether all nodes of a block are where they were at the start, and at rest.
template <class Element>
bool OnePointGroup<Element>::quiet(const Nodes<dim> &nodes, std::size_t begin, std::size_t count)
{
  if (!quiet_.watches(begin / block_packs))
    return false;
  for (std::size_t pack = begin; pack < begin + count; ++pack)
  {
    Corners v, x, x0;
    gather(nodes.v, pack, v);
    gather(nodes.x, pack, x);
    gather(nodes.x0, pack, x0);
    auto moves = VDouble(0.) > 0.;
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i)
        moves = moves || v[a][i] != 0. || x[a][i] != x0[a][i];
    if (stdx::any_of(moves))
    {
      quiet_.moved(begin / block_packs);
      return false;
    }
  }
  return true;
}

/// Takes the step of a quiet block, or leaves it out.
template <class Element>
StepStatus OnePointGroup<Element>::take_quiet(const Nodes<dim> &nodes, const TimeStep &step, std::size_t begin,
                                              std::size_t count, Block &block)
{
  const std::size_t number = begin / block_packs;
  const auto        all    = [&](const auto &f) {
    for_each_history([&](const AlignedVector<double> &a, std::size_t each) {
      const double *first = a.data() + begin * width * each;
      f(first, first + count * width * each);
    });
  };
  if (!quiet_.sleeps(number))
  {
    const std::array<double, 2> others = {limit_[0], limit_[1]};
    limit_                             = {0., 0.};
    quiet_.keep(all);
    const StepStatus status = take_block(nodes, step, begin, count, block);
    if (!status.ok)
      return status;
    const double *forces = forces_of(begin, block.force);
    const bool    pushes = std::any_of(forces, forces + count * corners * dim * width, [](double f) { return f != 0; });
    if (pushes)
      quiet_.moved(number);
    else
      quiet_.compare(number, {limit_[0], limit_[1]}, all);
    const std::array<double, 2> own = {limit_[0], limit_[1]};
    std::copy(others.begin(), others.end(), limit_.begin());
    join_limit(own);
    return {};
  }
  join_limit(quiet_.limit(number));
  skipped_ += std::min((begin + count) * width, n_) - begin * width;
  return {};
}

template <class Element>
void OnePointGroup<Element>::join_limit(const std::array<double, 2> &other)
{
  if (other[0] > limit_[0])
    std::copy(other.begin(), other.end(), limit_.begin());
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
