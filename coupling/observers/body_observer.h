// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "coupling/observers/observer.h"

#include <limits>

namespace ogive::coupling
{
/// How far node i stands for its body along a unit vector, m: half of its cell.
inline double half_cell(const Sample &s, std::size_t i, const Vec3 &along)
{
  if (s.half_cell[0].empty())
    return s.radius[i];
  return Vec3(s.half_cell[0][i], s.half_cell[1][i], s.half_cell[2][i]).cwiseProduct(along).norm();
}

/// An observer of one body along one direction, whose value is made afresh at
/// every row.
class BodyObserver : public Observer
{
public:
  BodyObserver(const input::Observer &o, const input::Scene &scene)
    : direction_(o.direction.normalized())
    , point_(o.point)
    , parameter_(o.parameter)
  {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (scene.bodies[b].name == o.body)
        body_ = static_cast<int>(b);
    if (body_ < 0)
      throw InputError("observer \"" + o.name + "\" names the body \"" + o.body + "\", which is not in the scene");
  }

  void row(const RowFrame &frame) final { value_ = measure(frame.sample(body_), frame.time); }

  double value() const final { return value_; }

protected:
  virtual double measure(const Sample &, double time) = 0;

  double along(const std::array<std::vector<double>, 3> &a, std::size_t i) const
  {
    return a[0][i] * direction_.x() + a[1][i] * direction_.y() + a[2][i] * direction_.z();
  }
  static Vec3 at(const std::array<std::vector<double>, 3> &a, std::size_t i) { return {a[0][i], a[1][i], a[2][i]}; }

  /// What was nearest to the point at the start.
  std::size_t nearest_node(const Sample &s) const
  {
    std::size_t nearest  = 0;
    double      distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < s.mass.size(); ++i)
      if (const double d = (at(s.x0, i) - point_).squaredNorm(); d < distance)
      {
        distance = d;
        nearest  = i;
      }
    return nearest;
  }

  int                 body() const { return body_; }
  const Vec3         &direction() const { return direction_; }
  const Vec3         &point() const { return point_; }
  double              parameter() const { return parameter_; }
  std::vector<double> memory() const override { return {value_}; }
  void                recall(const std::vector<double> &numbers) override { value_ = numbers.at(0); }

private:
  int    body_ = -1;
  Vec3   direction_, point_;
  double parameter_;
  double value_ = std::numeric_limits<double>::quiet_NaN();
};
} // namespace ogive::coupling
