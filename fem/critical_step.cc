// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/critical_step.h"

#include <algorithm>
#include <cmath>

namespace ogive::fem
{
template <int dim>
CriticalStep<dim>::CriticalStep(std::size_t n_nodes)
{
  std::uint64_t state = 42; // a linear congruential generator: the same motion on every machine
  for (int i = 0; i < dim; ++i)
  {
    motion_[i].resize(n_nodes);
    for (double &u : motion_[i])
    {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      u     = static_cast<double>(state >> 11) * 0x1p-52 - 1;
    }
    stiff_[i].resize(n_nodes);
    damp_[i].resize(n_nodes);
  }
}

/// Held components rest, slaves follow; v.M.v becomes 1.
template <int dim>
void CriticalStep<dim>::scale(const Nodes<dim> &nodes, const Bonds &bonds)
{
  double own = 0;
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      if (bonds.held.prescribed(a, i) || bonds.constraints.is_slave(a) || !(nodes.mass[a] > 0))
        motion_[i][a] = 0;
      if (nodes.counts(a))
        own += nodes.mass[a] * motion_[i][a] * motion_[i][a];
    }
  const double all = sum(bonds, own), factor = all > 0 ? 1 / std::sqrt(all) : 0;
  for (auto &component : motion_)
    for (double &u : component)
      u *= factor;
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
      bonds.constraints.for_each_master(
        a, [&](std::uint32_t master, double weight) { motion_[i][a] += weight * motion_[i][master]; });
}

template <int dim>
void CriticalStep<dim>::apply(const Groups &groups, const Nodes<dim> &nodes, const Bonds &bonds)
{
  for (int i = 0; i < dim; ++i)
  {
    std::fill(stiff_[i].begin(), stiff_[i].end(), 0.);
    std::fill(damp_[i].begin(), damp_[i].end(), 0.);
  }
  for (const auto *group : groups)
  {
    group->tangent(nodes, motion_, element_stiff_, element_damp_);
    group->for_each_node([&](std::uint32_t node, std::size_t at) {
      for (int i = 0; i < dim; ++i)
      {
        stiff_[i][node] -= element_stiff_[at + static_cast<std::size_t>(i) * simd_width];
        damp_[i][node] -= element_damp_[at + static_cast<std::size_t>(i) * simd_width];
      }
    });
  }
  for (auto *field : {&stiff_, &damp_})
    for (auto &component : *field)
      for (std::size_t a = 0; a < nodes.size(); ++a)
        if (bonds.constraints.is_slave(a))
        {
          bonds.constraints.for_each_master(
            a, [&](std::uint32_t master, double weight) { component[master] += weight * component[a]; });
          component[a] = 0;
        }
  if (!bonds.shared)
    return;
  std::array<double *, 2 * dim> sums;
  for (int i = 0; i < dim; ++i)
  {
    sums[i]       = stiff_[i].data();
    sums[dim + i] = damp_[i].data();
  }
  bonds.shared->sum(sums);
}

template <int dim>
std::uint32_t CriticalStep<dim>::fastest(const Nodes<dim> &nodes, const Bonds &bonds) const
{
  double        largest = -1;
  std::uint32_t node    = 0;
  for (std::size_t a = 0; a < nodes.size(); ++a)
  {
    double size = 0;
    for (int i = 0; i < dim; ++i)
      size += motion_[i][a] * motion_[i][a];
    if (size > largest && nodes.counts(a))
    {
      largest = size;
      node    = static_cast<std::uint32_t>(a);
    }
  }
  if (bonds.shared)
  {
    const Ranks &ranks = bonds.shared->ranks();
    ranks.broadcast(std::span(&node, 1), ranks.least(-largest).rank);
  }
  return node;
}

template <int dim>
typename CriticalStep<dim>::Answer CriticalStep<dim>::estimate(const Groups &groups, const Nodes<dim> &nodes,
                                                               const Bonds &bonds, double tolerance, int most)
{
  constexpr int enough = 10; // quiet iterations
  Answer        answer;
  int           quiet = 0;
  scale(nodes, bonds);
  while (answer.iterations < most && quiet < enough)
  {
    apply(groups, nodes, bonds);
    double k = 0, c = 0;
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < nodes.size(); ++a)
      {
        if (!nodes.counts(a))
          continue;
        k += motion_[i][a] * stiff_[i][a];
        c += motion_[i][a] * damp_[i][a];
      }
    if (bonds.shared)
    {
      double both[] = {k, c};
      bonds.shared->ranks().sum(std::span<double>(both));
      k = both[0];
      c = both[1];
    }
    const double dt = 2 / (.5 * c + std::sqrt(.25 * c * c + std::max(k, 0.)));
    quiet           = std::abs(dt - answer.dt) < tolerance * dt ? quiet + 1 : 0;
    answer.dt       = dt;
    ++answer.iterations;
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < nodes.size(); ++a)
        motion_[i][a] =
          nodes.mass[a] > 0 ? (.5 * dt * damp_[i][a] + .25 * dt * dt * stiff_[i][a]) / nodes.mass[a] : 0;
    scale(nodes, bonds);
  }
  answer.node = fastest(nodes, bonds);
  return answer;
}

template class CriticalStep<1>;
template class CriticalStep<2>;
template class CriticalStep<3>;
} // namespace ogive::fem
