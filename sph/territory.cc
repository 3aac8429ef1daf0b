// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/territory.h"

#include "core/parallel/partition.h"

#include <algorithm>
#include <limits>

namespace ogive::sph
{
template <int dim>
Territory<dim> Territory<dim>::cut(const Ranks &ranks, const std::array<std::span<const double>, dim> &x,
                                   std::span<const double> weight)
{
  Territory t;
  if (ranks.alone() || ranks.sum(static_cast<std::int64_t>(weight.size())) == 0)
    return t;
  Partition<dim> partition(ranks);
  partition.cut(x, weight);
  t.boxes.resize(ranks.size());
  for (int r = 0; r < ranks.size(); ++r)
    partition.box(r, t.boxes[r].lower, t.boxes[r].upper);
  t.find_overlaps();
  return t;
}

template <int dim>
void Territory<dim>::find_overlaps()
{
  disjoint = true;
  for (std::size_t r = 0; r < boxes.size(); ++r)
    for (std::size_t q = 0; q < r; ++q)
    {
      bool overlap = true;
      for (int a = 0; a < dim; ++a)
        overlap = overlap && std::max(boxes[q].lower[a], boxes[r].lower[a]) < std::min(boxes[q].upper[a], boxes[r].upper[a]);
      disjoint = disjoint && !overlap;
    }
}

template <int dim>
int Territory<dim>::at(const std::array<double, dim> &x, int guess) const
{
  const auto beyond = [&](const Box &b) { // how far x lies outside
    double most = 0;
    for (int a = 0; a < dim; ++a)
      most = std::max({most, x[a] - b.upper[a], x[a] > b.lower[a] ? 0. : std::max(std::numeric_limits<double>::min(), b.lower[a] - x[a])});
    return most;
  };
  if (boxes.empty())
    return 0;
  if (disjoint && !(beyond(boxes[guess]) > 0))
    return guess;
  // Empty boxes may leave gaps, where the nearest takes x.
  int    nearest = 0;
  double least   = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < boxes.size(); ++r)
    if (const double d = beyond(boxes[r]); d < least)
    {
      least   = d;
      nearest = static_cast<int>(r);
    }
  return nearest;
}

template struct Territory<1>;
template struct Territory<2>;
template struct Territory<3>;
} // namespace ogive::sph
