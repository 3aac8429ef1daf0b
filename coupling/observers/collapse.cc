// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/collapse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace ogive::coupling
{
InnerWall::InnerWall(const input::Observer &o, const input::Scene &scene) : BodyObserver(o, scene)
{
  const input::Body &b = scene.bodies[body()];
  if (b.shape.kind != input::ShapeKind::shell && b.shape.kind != input::ShapeKind::ring)
    throw InputError({scene.file, 0, "Observers/" + o.name + "/body"},
                     "the body \"" + o.body + "\" has no inner wall", "a body of shape shell or ring");
  base_ = b.shape.base;
  axis_ = scene.dimension == input::Dimension::plane_strain ? Vec3(Vec3::UnitZ()) : b.shape.axis.normalized();
  spherical_ = b.shape.kind == input::ShapeKind::shell;
  inner_     = b.shape.inner_radius;
  depth_     = b.spacing;
}

Vec3 InnerWall::radius_vector(const std::array<std::vector<double>, 3> &x, std::size_t i) const
{
  const Vec3 arm = at(x, i) - base_;
  return spherical_ ? arm : Vec3(arm - arm.dot(axis_) * axis_);
}

double InnerWall::root(double power) const
{
  return spherical_ ? std::cbrt(power) : std::sqrt(std::max(0., power));
}

std::vector<InnerWall::Point> InnerWall::innermost(const Sample &s) const
{
  const double       n = spherical_ ? 3 : 2;
  std::vector<Point> points;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const Vec3   from = radius_vector(s.x0, i);
    const double r0   = from.norm();
    // half a depth for nodes: those on the wall, not the next layer
    if (r0 < inner_ + (s.is_mesh ? .5 : 1.) * depth_)
      points.push_back({from, s.mass[i],
                        std::pow(radius_vector(s.x, i).norm(), n) - std::pow(r0, n) + std::pow(inner_, n)});
  }
  return points;
}

double InnerWall::mean_radius(const Sample &s) const
{
  double mass = 0, moment = 0;
  for (const Point &p : innermost(s))
  {
    mass += p.mass;
    moment += p.mass * root(p.power);
  }
  return moment / mass;
}

double InnerWall::roundness(const Sample &s) const
{
  std::map<std::array<int, 3>, std::array<double, 2>> sums;
  for (const Point &p : innermost(s))
  {
    // The nearest of the 26 directions: each sum of k unit vectors over sqrt(k).
    Vec3               e = p.from.cwiseAbs();
    std::array<int, 3> order{0, 1, 2}, direction{};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return e[a] > e[b]; });
    double best = 0, sum = 0;
    int    count = 0;
    for (int k = 1; k <= 3; ++k)
      if (sum += e[order[k - 1]]; sum / std::sqrt(k) > best * (1 + 1e-9))
      {
        best  = sum / std::sqrt(k);
        count = k;
      }
    for (int k = 0; k < count; ++k)
      direction[order[k]] = p.from[order[k]] > 0 ? 1 : -1;
    auto &[mass, moment] = sums[direction];
    mass += p.mass;
    moment += p.mass * root(p.power);
  }
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const auto &[direction, m] : sums)
  {
    least    = std::min(least, m[1] / m[0]);
    greatest = std::max(greatest, m[1] / m[0]);
  }
  return greatest / least;
}

double StoppingRadius::measure(const Sample &s, double)
{
  const double r = mean_radius(s);
  return std::isnan(value()) ? r : std::min(value(), r);
}

double StoppingTime::measure(const Sample &s, double time)
{
  const double r = mean_radius(s);
  if (!(r < least_))
    return value();
  least_ = r;
  return time;
}

void StoppingTime::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  least_ = numbers.at(1);
}

double Roundness::measure(const Sample &s, double)
{
  const double r = mean_radius(s);
  if (!(r < least_))
    return value();
  least_ = r;
  return roundness(s);
}

void Roundness::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  least_ = numbers.at(1);
}
} // namespace ogive::coupling
