// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ogive::coupling
{
namespace
{
/// Of the circle about the axis of a foot.
constexpr std::size_t sectors = 32;

struct Extent
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double length() const { return high - low; }
};
} // namespace

double extent_along(const Sample &s, const Vec3 &direction)
{
  Extent e;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const double x    = s.x[0][i] * direction.x() + s.x[1][i] * direction.y() + s.x[2][i] * direction.z();
    const double half = half_cell(s, i, direction);
    e.low             = std::min(e.low, x - half);
    e.high            = std::max(e.high, x + half);
  }
  return e.length();
}

double Length::measure(const Sample &s, double)
{
  return extent_along(s, direction());
}

FootRadius::FootRadius(const input::Observer &o, const input::Scene &scene)
  : BodyObserver(o, scene)
  , base_(scene.bodies[body()].shape.base)
{}

double FootRadius::measure(const Sample &s, double)
{
  Extent e;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    e.low  = std::min(e.low, along(s.x, i));
    e.high = std::max(e.high, along(s.x, i));
  }
  // Mean over the sectors that hold points: the rim of a coarse lattice or mesh
  // is not round, and its farthest point alone overstates it.
  const Vec3                 first = direction().unitOrthogonal(), second = direction().cross(first);
  // Points on the axes belong to the quadrant that the others are in: rounding must not
  // give those of a quarter sectors of their own.
  constexpr std::size_t in_quadrant = sectors / 4;
  constexpr double      on_edge     = 1e-9;
  Vec3                  turned      = Vec3::Ones();
  for (int k = 0; k < 2; ++k)
  {
    bool positive = false;
    for (std::size_t i = 0; i < s.mass.size(); ++i)
      positive = positive || (at(s.x, i) - base_).dot(k == 0 ? first : second) > on_edge * e.length();
    turned[k] = positive ? 1 : -1;
  }
  std::array<double, sectors> reach{};
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    if (const double height = along(s.x, i); height <= e.low + .1 * e.length())
    {
      const Vec3   arm = at(s.x, i) - base_;
      const double a = arm.dot(first), b = arm.dot(second), clear = -on_edge * e.length();
      const auto   quadrant = static_cast<std::size_t>(turned[0] * a < clear) + 2 * static_cast<std::size_t>(turned[1] * b < clear);
      const double within   = std::atan2(std::abs(b), std::abs(a)) / (.5 * std::numbers::pi) * in_quadrant;
      const auto   sector   = quadrant * in_quadrant + std::min(static_cast<std::size_t>(within + on_edge), in_quadrant - 1);
      reach[sector]       = std::max(reach[sector], std::hypot(a, b) + half_cell(s, i, (a * first + b * second).stableNormalized()));
    }
  const auto   seen = std::count_if(reach.begin(), reach.end(), [](double r) { return r > 0; });
  return std::accumulate(reach.begin(), reach.end(), 0.) / static_cast<double>(seen);
}

double PeakStress::measure(const Sample &s, double)
{
  double peak = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
  {
    const Sym3 sigma{s.sigma[0][i], s.sigma[1][i], s.sigma[2][i], s.sigma[3][i], s.sigma[4][i], s.sigma[5][i]};
    peak = std::max(peak, von_mises(sigma.deviator()));
  }
  return peak;
}

double GreatestDamage::measure(const Sample &s, double)
{
  return s.damage.empty() ? 0. : *std::max_element(s.damage.begin(), s.damage.end());
}
} // namespace ogive::coupling
