// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/shape.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
struct Extent
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double length() const { return high - low; }
};
} // namespace

double Length::measure(const Sample &s, double)
{
  Extent e;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const double x = along(s.x, i);
    e.low          = std::min(e.low, x - s.radius[i]);
    e.high         = std::max(e.high, x + s.radius[i]);
  }
  return e.length();
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
  double radius = 0;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    if (const double height = along(s.x, i); height <= e.low + .1 * e.length())
    {
      const Vec3 arm = at(s.x, i) - base_;
      radius         = std::max(radius, (arm - arm.dot(direction()) * direction()).norm() + s.radius[i]);
    }
  return radius;
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
