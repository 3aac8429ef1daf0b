// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/profile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::coupling
{
namespace
{
constexpr std::size_t sectors = 32;

struct Outermost
{
  double radius = 0, height = 0;
  void   offer(double r, double z)
  {
    if (r > radius)
      *this = {r, z};
  }
};
} // namespace

WidthAt::WidthAt(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene), base_(scene.bodies[body()].shape.base)
{
}

double WidthAt::measure(const Sample &s, double)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const double half = half_cell(s, i, direction());
    low  = std::min(low, along(s.x, i) - half);
    high = std::max(high, along(s.x, i) + half);
  }
  const double                   slab  = (high - low) / 16;
  const Vec3                     first = direction().unitOrthogonal(), second = direction().cross(first);
  std::array<Outermost, sectors> below{}, above{};
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    if (const double z = along(s.x, i) - low - parameter(); std::abs(z) <= slab)
    {
      const Vec3   arm = at(s.x, i) - base_;
      const double a = arm.dot(first), b = arm.dot(second);
      const double turn   = std::atan2(b, a) / (2 * std::numbers::pi) + .5;
      const auto   sector = std::min(static_cast<std::size_t>(turn * sectors), sectors - 1);
      (z < 0 ? below : above)[sector].offer(std::hypot(a, b) + half_cell(s, i, (a * first + b * second).stableNormalized()), z);
    }
  double sum  = 0;
  int    seen = 0;
  for (std::size_t k = 0; k < sectors; ++k)
    if (const Outermost &p = below[k], &q = above[k]; p.radius > 0 && q.radius > 0)
    {
      sum += p.radius + (q.radius - p.radius) * -p.height / (q.height - p.height);
      ++seen;
    }
  return seen > 0 ? 2 * sum / seen : std::numeric_limits<double>::quiet_NaN();
}
} // namespace ogive::coupling
