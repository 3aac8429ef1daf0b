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
  std::size_t n_queries() const { return first_.size() - 1; }
  std::size_t n_pairs() const { return target_.size(); }

private:
  std::vector<std::size_t>   first_{0};
  std::vector<std::uint32_t> target_;
};

/// Says whether any of a set of points has gone farther than a margin from
/// where it was when the watch was set.
template <int dim>
class DisplacementWatch
{
public:
  void set(std::vector<Point<dim>> points) { reference_ = std::move(points); }
  bool exceeded(std::span<const Point<dim>> points, double margin) const;

private:
  std::vector<Point<dim>> reference_;
};
} // namespace ogive::coupling
