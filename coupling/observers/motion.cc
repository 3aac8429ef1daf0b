// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/motion.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
MeanVelocity::MeanVelocity(const input::Observer &o, const input::Scene &scene)
  : direction_(o.direction.normalized())
{
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (o.body.empty() || o.body == scene.bodies[b].name)
      bodies_.push_back(static_cast<int>(b));
  if (bodies_.empty())
    throw InputError("observer \"" + o.name + "\" names the body \"" + o.body + "\", which is not in the scene");
}

void MeanVelocity::row(const RowFrame &frame)
{
  double mass     = 0;
  Vec3   momentum = Vec3::Zero();
  for (const int b : bodies_)
  {
    const Sample &s = frame.sample(b);
    for (std::size_t i = 0; i < s.mass.size(); ++i)
    {
      mass += s.mass[i];
      momentum += s.mass[i] * Vec3(s.v[0][i], s.v[1][i], s.v[2][i]);
    }
  }
  value_ = momentum.dot(direction_) / mass;
}

double Displacement::measure(const Sample &s, double)
{
  double mass = 0, moment = 0;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    mass += s.mass[i];
    moment += s.mass[i] * (along(s.x, i) - along(s.x0, i));
  }
  return moment / mass;
}

double Perforation::measure(const Sample &s, double)
{
  double mass = 0, momentum = 0, foremost = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    mass += s.mass[i];
    momentum += s.mass[i] * along(s.v, i);
    foremost = std::max(foremost, along(s.x, i) - point().dot(direction()));
  }
  return foremost > 0 && momentum / mass > parameter() ? 1. : 0.;
}

double GaugeVelocity::measure(const Sample &s, double)
{
  return along(s.v, nearest_node(s));
}

double GaugeDisplacement::measure(const Sample &s, double)
{
  const std::size_t i = nearest_node(s);
  return along(s.x, i) - along(s.x0, i);
}

void ContactTime::every_step(const StepFrame &frame)
{
  double force = frame.contact_force;
  for (const double f : frame.wall_force)
    force += std::abs(f);
  greatest_ = std::max(greatest_, force);
  if (force > .01 * greatest_ && force > 0)
  {
    if (first_ < 0)
      first_ = frame.time;
    last_ = frame.time;
  }
}

double ContactTime::value() const
{
  return first_ < 0 ? std::numeric_limits<double>::quiet_NaN() : last_ - first_;
}

void ContactTime::recall(const std::vector<double> &numbers)
{
  greatest_ = numbers.at(0);
  first_    = numbers.at(1);
  last_     = numbers.at(2);
}

void AngularMomentumDrift::row(const RowFrame &frame)
{
  if (!started_)
    start_ = frame.angular_momentum;
  started_ = true;
  value_   = start_.norm() > 0 ? (frame.angular_momentum - start_).norm() / start_.norm() :
                                 std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> AngularMomentumDrift::memory() const
{
  return {started_ ? 1. : 0., start_.x(), start_.y(), start_.z(), value_};
}

void AngularMomentumDrift::recall(const std::vector<double> &numbers)
{
  started_ = numbers.at(0) > 0;
  start_   = {numbers.at(1), numbers.at(2), numbers.at(3)};
  value_   = numbers.at(4);
}

void EnergyKept::row(const RowFrame &frame)
{
  const double now = frame.kinetic + frame.elastic;
  if (start_ < 0)
    start_ = now;
  value_ = now / start_;
}

void EnergyKept::recall(const std::vector<double> &numbers)
{
  start_ = numbers.at(0);
  value_ = numbers.at(1);
}
} // namespace ogive::coupling
