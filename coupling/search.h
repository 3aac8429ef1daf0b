// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/surfaces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ogive::coupling
{
/// An axis-parallel box, m.
template <int dim>
struct Box
{
  Point<dim> lower = Point<dim>::Constant(std::numeric_limits<double>::infinity());
  Point<dim> upper = Point<dim>::Constant(-std::numeric_limits<double>::infinity());

  void include(const Point<dim> &p)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  void inflate(double by)
  {
    lower.array() -= by;
    upper.array() += by;
  }
  bool meets(const Box &other) const
  {
    return (lower.array() <= other.upper.array()).all() && (other.lower.array() <= upper.array()).all();
  }
};

/// For each query box the targets whose boxes meet it, by ascending index.
/// Stored row by row; found with the R-tree of Boost.Geometry.
template <int dim>
class NeighbourList
{
public:
  /// Both kinds of boxes may be empty in number; a box with a NaN meets nothing.
  void build(std::span<const Box<dim>> queries, std::span<const Box<dim>> targets);

  std::span<const std::uint32_t> of(std::size_t query) const
  {
    return {target_.data() + first_[query], first_[query + 1] - first_[query]};
  }
  /// Drops the pairs of which `drop(query, target)` is true.
  template <class Drop>
  void remove_if(const Drop &drop)
  {
    std::size_t to = 0, from = 0;
    for (std::size_t q = 0; q + 1 < first_.size(); ++q)
    {
      for (; from < first_[q + 1]; ++from)
        if (!drop(q, target_[from]))
          target_[to++] = target_[from];
      first_[q + 1] = to;
    }
    target_.resize(to);
  }

  std::size_t n_queries() const { return first_.size() - 1; }
  std::size_t n_pairs() const { return target_.size(); }

private:
  std::vector<std::size_t>   first_{0};
  std::vector<std::uint32_t> target_;
};

/// Bounds how far the members of two groups of points can have come together
/// since the watch was set. What moves all of them alike brings none together.
template <int dim>
class DisplacementWatch
{
public:
  /// `first`: how many of the points are the first group.
  void set(std::vector<Point<dim>> points, std::size_t first)
  {
    reference_ = std::move(points);
    first_     = first;
  }
  /// m; infinite if it was never set, for another number of points, and where a
  /// point has no place.
  double approach(std::span<const Point<dim>> points) const;

private:
  std::vector<Point<dim>> reference_;
  std::size_t             first_ = 0;
};
} // namespace ogive::coupling
