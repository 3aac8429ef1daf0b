// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/crater.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace ogive::coupling
{
namespace
{
/// The value that all but a hundredth of the mass stays below.
double upper_end(std::vector<std::pair<double, double>> of) // value, mass
{
  std::sort(of.begin(), of.end());
  double whole = 0, beyond = 0;
  for (const auto &[value, mass] : of)
    whole += mass;
  for (std::size_t k = of.size(); k-- > 0;)
    if ((beyond += of[k].second) > .01 * whole)
      return of[k].first;
  return of.front().first;
}
} // namespace

double CraterDiameter::measure(const Sample &s, double)
{
  const Vec3 first = direction().unitOrthogonal(), second = direction().cross(first);
  double     low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    low  = std::min(low, along(s.x0, i) - half_cell(s, i, direction()));
    high = std::max(high, along(s.x0, i) + half_cell(s, i, direction()));
  }
  constexpr std::size_t       sectors = 32;
  std::array<double, sectors> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const double height = along(s.x, i);
    if (height < low || height > high || at(s.v, i).norm() > parameter())
      continue;
    const Vec3   arm = at(s.x, i) - point();
    const double a = arm.dot(first), b = arm.dot(second), r = std::hypot(a, b);
    const double turn   = std::atan2(b, a) / (2 * std::numbers::pi) + .5;
    const auto   sector = std::min(static_cast<std::size_t>(turn * sectors), sectors - 1);
    const Vec3   out    = r > 0 ? Vec3((a * first + b * second) / r) : first;
    least[sector]       = std::min(least[sector], std::max(0., r - half_cell(s, i, out)));
  }
  double sum = 0, seen = 0;
  for (const double r : least)
    if (std::isfinite(r))
    {
      sum += r;
      seen += 1;
    }
  return seen > 0 ? 2 * sum / seen : 0.;
}

double CloudShape::measure(const Sample &s, double)
{
  std::vector<std::pair<double, double>> length, radius;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const Vec3   arm   = at(s.x, i) - point();
    const double ahead = arm.dot(direction());
    if (ahead <= 0 || at(s.v, i).norm() < parameter())
      continue;
    length.emplace_back(ahead, s.mass[i]);
    radius.emplace_back((arm - ahead * direction()).norm(), s.mass[i]);
  }
  if (length.empty())
    return std::numeric_limits<double>::quiet_NaN();
  const double width = 2 * upper_end(std::move(radius));
  return width > 0 ? upper_end(std::move(length)) / width : std::numeric_limits<double>::quiet_NaN();
}
} // namespace ogive::coupling
