// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/together.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace ogive::sph
{
namespace
{
/// Calls f for each number of the balance that particles have.
template <class F>
void for_each_amount(Balance &b, F &&f)
{
  for (double *amount : {&b.mass, &b.kinetic, &b.elastic, &b.plastic_work, &b.viscosity_heat, &b.hourglass_sph,
                         &b.external_work, &b.wall_loss, &b.friction_heat, &b.thermal})
    f(*amount);
  for (Vec3 *amount : {&b.momentum, &b.angular_momentum, &b.external_impulse})
    for (int a = 0; a < 3; ++a)
      f((*amount)[a]);
}

template <class F>
void for_each_list(Sample &s, F &&f)
{
  for (auto *vectors : {&s.x, &s.x0, &s.v, &s.half_cell, &s.centre, &s.centre0})
    for (auto &list : *vectors)
      f(list);
  for (auto &list : s.sigma)
    f(list);
  for (auto *list : {&s.mass, &s.radius, &s.density, &s.energy, &s.plastic_strain, &s.damage, &s.temperature, &s.volume})
    f(*list);
  f(s.id);
}
} // namespace

void sum_over(const Ranks &ranks, Balance &b)
{
  if (ranks.alone())
    return;
  std::vector<double> all;
  for_each_amount(b, [&](double &amount) { all.push_back(amount); });
  ranks.sum(std::span<double>(all));
  std::size_t k = 0;
  for_each_amount(b, [&](double &amount) { amount = all[k++]; });
}

void gather(const Ranks &ranks, Sample &s)
{
  if (ranks.alone())
    return;
  const auto               ids = ranks.gather(s.id);
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  for_each_list(s, [&](auto &list) {
    const auto all = ranks.gather(list);
    if (all.empty()) // no particle has it
      return;
    list.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      list[k] = all[order[k]];
  });
}
} // namespace ogive::sph
