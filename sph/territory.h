// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <array>
#include <span>
#include <vector>

namespace ogive::sph
{
/// Which rank owns what lies where: a box for each rank, as recursive coordinate
/// bisection cut them; together they fill space. A value, so that snapshots and
/// checkpoints hold it: which particles move to another rank at the next
/// rebuild must not depend on whether a run was interrupted.
template <int dim>
struct Territory
{
  struct Box
  {
    std::array<double, dim> lower{}, upper{}; ///< x with lower < x <= upper
  };
  std::vector<Box> boxes;           ///< by rank; none: all belongs to the first
  bool             disjoint = true; ///< with fewer points than ranks they need not be: the first one counts

  /// Cut so that the weights (> 0) of all ranks' points are even; nobody's if
  /// there is no point at all. Called by all ranks.
  static Territory cut(const Ranks &, const std::array<std::span<const double>, dim> &x, std::span<const double> weight);

  /// To be called when boxes were set.
  void find_overlaps();

  /// Owner of x, the same whatever the guess, who is asked first.
  int at(const std::array<double, dim> &x, int guess) const;
};
} // namespace ogive::sph
