// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/bending.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::coupling
{
double Settled::measure(const Sample &s, double time)
{
  const double value = now(s);
  if (!values_.empty() && value > values_.front())
  {
    times_.clear();
    values_.clear();
  }
  times_.push_back(time);
  values_.push_back(value);
  const double half = .5 * (times_.front() + time);
  double       sum  = 0;
  int          rows = 0;
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (times_[k] >= half)
    {
      sum += values_[k];
      ++rows;
    }
  return sum / rows;
}

std::vector<double> Settled::memory() const
{
  std::vector<double> numbers = BodyObserver::memory();
  for (std::size_t k = 0; k < times_.size(); ++k)
    numbers.insert(numbers.end(), {times_[k], values_[k]});
  return numbers;
}

void Settled::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  times_.clear();
  values_.clear();
  for (std::size_t k = 1; k + 1 < numbers.size(); k += 2)
  {
    times_.push_back(numbers[k]);
    values_.push_back(numbers[k + 1]);
  }
}

double TipDeflection::now(const Sample &s) const
{
  const std::size_t i = nearest_node(s);
  return along(s.x, i) - along(s.x0, i);
}

double GreatestDeflection::measure(const Sample &s, double)
{
  const std::size_t i = nearest_node(s);
  const double      d = along(s.x, i) - along(s.x0, i);
  return std::isnan(value()) ? d : std::max(value(), d);
}

TipRotation::TipRotation(const input::Observer &o, const input::Scene &scene)
    : Settled(o, scene),
      axis_(input::space_dimension(scene.dimension) == 3 ? direction() : Vec3(Vec3::UnitZ()))
{
}

/// Turn about the axis, in (-pi, pi], of what began closer to the point than the
/// reach; NaN for nothing.
static double turn(const Sample &s, const Vec3 &point, double reach, const Vec3 &axis)
{
  const auto at = [](const auto &field, std::size_t i) { return Vec3(field[0][i], field[1][i], field[2][i]); };
  std::vector<std::size_t> near;
  double                   mass    = 0;
  Vec3                     centre0 = Vec3::Zero(), centre = Vec3::Zero();
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    if ((at(s.x0, i) - point).norm() < reach)
    {
      near.push_back(i);
      mass += s.mass[i];
      centre0 += s.mass[i] * at(s.x0, i);
      centre += s.mass[i] * at(s.x, i);
    }
  centre0 /= mass;
  centre /= mass;
  double across = 0, with = 0;
  for (const std::size_t i : near)
  {
    const Vec3 before = at(s.x0, i) - centre0, after = at(s.x, i) - centre;
    across += s.mass[i] * axis.dot(before.cross(after));
    with += s.mass[i] * (before.dot(after) - before.dot(axis) * after.dot(axis));
  }
  return near.empty() ? std::numeric_limits<double>::quiet_NaN() : std::atan2(across, with);
}

double TipRotation::now(const Sample &s) const
{
  return std::abs(turn(s, point(), parameter(), axis_));
}

Twist::Twist(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene),
      axis_(input::space_dimension(scene.dimension) == 3 ? direction() : Vec3(Vec3::UnitZ()))
{
}

/// Rows follow each other by less than half a turn.
double Twist::measure(const Sample &s, double)
{
  const double now = turn(s, point(), parameter(), axis_), last = value();
  return last == last ? now + 2 * std::numbers::pi * std::round((last - now) / (2 * std::numbers::pi)) : now;
}
} // namespace ogive::coupling
