// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/search.h"

#define BOOST_ALLOW_DEPRECATED_HEADERS // a note about Boost's own headers, not ours
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ogive::coupling
{
namespace
{
namespace bg = boost::geometry;

template <int dim>
using TreePoint = bg::model::point<double, dim, bg::cs::cartesian>;
template <int dim>
using TreeBox = bg::model::box<TreePoint<dim>>;

template <int dim>
TreePoint<dim> tree_point(const Point<dim> &p)
{
  TreePoint<dim> q;
  bg::set<0>(q, p[0]);
  if constexpr (dim > 1)
    bg::set<1>(q, p[1]);
  if constexpr (dim > 2)
    bg::set<2>(q, p[2]);
  return q;
}

template <int dim>
TreeBox<dim> tree_box(const Box<dim> &box)
{
  return {tree_point<dim>(box.lower), tree_point<dim>(box.upper)};
}

template <int dim>
bool usable(const Box<dim> &box)
{
  return (box.lower.array() <= box.upper.array()).all();
}
} // namespace

template <int dim>
void NeighbourList<dim>::build(std::span<const Box<dim>> queries, std::span<const Box<dim>> targets)
{
  first_.assign(1, 0);
  target_.clear();

  // Bodies that are far apart, or touch over a small part, are most of the
  // work: only targets near some query enter the tree.
  Box<dim> around;
  for (const auto &query : queries)
    if (usable(query))
    {
      around.include(query.lower);
      around.include(query.upper);
    }
  using Value = std::pair<TreeBox<dim>, std::uint32_t>;
  std::vector<Value> values;
  for (std::size_t t = 0; t < targets.size(); ++t)
    if (usable(targets[t]) && targets[t].meets(around))
      values.emplace_back(tree_box(targets[t]), static_cast<std::uint32_t>(t));

  const bg::index::rtree<Value, bg::index::quadratic<16>> tree(values.begin(), values.end());
  std::vector<Value>                                      found;
  for (const auto &query : queries)
  {
    const auto start = static_cast<std::ptrdiff_t>(target_.size());
    if (!values.empty() && usable(query))
    {
      found.clear();
      tree.query(bg::index::intersects(tree_box(query)), std::back_inserter(found));
      for (const auto &value : found)
        target_.push_back(value.second);
      std::sort(target_.begin() + start, target_.end());
    }
    first_.push_back(target_.size());
  }
}

template <int dim>
double DisplacementWatch<dim>::approach(std::span<const Point<dim>> points) const
{
  constexpr double never = std::numeric_limits<double>::infinity();
  if (points.size() != reference_.size() || points.empty())
    return never;
  Box<dim> moved;
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.include(points[i] - reference_[i]);
  const Point<dim> common = .5 * (moved.lower + moved.upper);
  double           farthest[2] = {0, 0};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double square = (points[i] - reference_[i] - common).squaredNorm();
    double      &side   = farthest[i >= first_];
    if (!(square <= side))
      side = square; // a NaN too, and no number takes its place
    if (!(side < never))
      return never;
  }
  return std::sqrt(farthest[0]) + std::sqrt(farthest[1]);
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template class NeighbourList<dim>;                                                                         \
  template class DisplacementWatch<dim>;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
