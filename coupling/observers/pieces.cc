// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/pieces.h"

#include "coupling/search.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace ogive::coupling
{
namespace
{
using Axes = std::array<std::vector<double>, 3>;

Box<3> box_at(const Vec3 &x, double half)
{
  Box<3> box;
  box.include(x);
  box.inflate(half);
  return box;
}

/// Calls f(i, j, distance over spacing), i < j, for particles closer than
/// `reach` spacings.
template <class F>
void for_each_pair(const Sample &s, double reach, F &&f)
{
  std::vector<Box<3>> boxes;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    boxes.push_back(box_at({s.x[0][i], s.x[1][i], s.x[2][i]}, reach * s.radius[i]));
  NeighbourList<3> near;
  near.build(boxes, boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (const std::uint32_t j : near.of(i))
      if (j > i)
      {
        const Vec3   d(s.x[0][i] - s.x[0][j], s.x[1][i] - s.x[1][j], s.x[2][i] - s.x[2][j]);
        const double distance = d.norm() / (s.radius[i] + s.radius[j]);
        if (distance < reach)
          f(i, j, distance);
      }
}

bool has_particles(const Sample &s)
{
  return std::any_of(s.radius.begin(), s.radius.end(), [](double r) { return r > 0; });
}

/// Least distance of two nodes of one cell over that at the start.
double least_stretch(const Sample &s)
{
  const auto  at    = [](const Axes &a, std::size_t i) { return Vec3(a[0][i], a[1][i], a[2][i]); };
  const auto  n     = static_cast<std::size_t>(s.nodes_per_cell);
  double      least = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < s.cells.size(); cell += n)
    for (std::size_t i = cell; i < cell + n; ++i)
      for (std::size_t j = cell; j < i; ++j)
      {
        const std::uint32_t a = s.cells[i], b = s.cells[j];
        least = std::min(least, (at(s.x, a) - at(s.x, b)).norm() / (at(s.x0, a) - at(s.x0, b)).norm());
      }
  return least;
}

/// Sets that grow together.
class Sets
{
public:
  explicit Sets(std::size_t n) : parent_(n), count_(n)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t(0));
  }
  void join(std::size_t a, std::size_t b)
  {
    a = root(a);
    b = root(b);
    count_ -= a != b;
    parent_[a] = b;
  }
  std::size_t count() const { return count_; }

private:
  std::size_t root(std::size_t a)
  {
    while (parent_[a] != a)
      a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  std::vector<std::size_t> parent_;
  std::size_t              count_;
};
} // namespace

double Fragments::measure(const Sample &s, double)
{
  Sets sets(s.mass.size());
  if (s.is_mesh)
    for (std::size_t k = 0; k < s.cells.size(); ++k)
      sets.join(s.cells[k], s.cells[k - k % s.nodes_per_cell]);
  if (has_particles(s))
    for_each_pair(s, 1.75, [&](std::size_t i, std::size_t j, double) { sets.join(i, j); });
  return static_cast<double>(sets.count());
}

double SmallestDistance::measure(const Sample &s, double)
{
  double least = std::isnan(value()) ? std::numeric_limits<double>::infinity() : value();
  if (s.is_mesh)
    least = std::min(least, least_stretch(s));
  if (has_particles(s))
    for_each_pair(s, 2, [&](std::size_t, std::size_t, double distance) { least = std::min(least, distance); });
  return least;
}

SymmetryError::SymmetryError(const input::Observer &o, const input::Scene &scene)
    : n_bodies_(scene.bodies.size()), normal_(o.direction.normalized()), point_(o.point)
{
}

void SymmetryError::row(const RowFrame &frame)
{
  const auto        at = [](const Axes &a, std::size_t i) { return Vec3(a[0][i], a[1][i], a[2][i]); };
  std::vector<Vec3> from, now;
  Box<3>            all;
  for (std::size_t b = 0; b < n_bodies_; ++b)
  {
    const Sample &s = frame.sample(static_cast<int>(b));
    for (std::size_t i = 0; i < s.mass.size(); ++i)
    {
      from.push_back(at(s.x0, i));
      now.push_back(at(s.x, i));
      all.include(from.back());
    }
  }
  const double        tolerance = 1e-6 * (all.upper - all.lower).norm();
  std::vector<Box<3>> points, images;
  for (const Vec3 &x : from)
  {
    points.push_back(box_at(x, 0));
    images.push_back(box_at(mirrored(x), tolerance));
  }
  NeighbourList<3> partners;
  partners.build(images, points);
  value_ = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    if (partners.of(i).empty())
      value_ = std::numeric_limits<double>::quiet_NaN();
    for (const std::uint32_t j : partners.of(i))
      value_ = std::isnan(value_) ? value_ : std::max(value_, (mirrored(now[i]) - now[j]).norm());
  }
}
} // namespace ogive::coupling
