// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/stop.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
Vec3 mean_velocity(const Sample &s)
{
  double mass     = 0;
  Vec3   momentum = Vec3::Zero();
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    mass += s.mass[i];
    momentum += s.mass[i] * Vec3(s.v[0][i], s.v[1][i], s.v[2][i]);
  }
  return momentum / mass;
}
} // namespace

StopWatch::StopWatch(const input::Scene &scene)
  : rule_(scene.stop)
{
  for (std::size_t b = 0; rule_.active && b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == rule_.body)
    {
      body_          = static_cast<int>(b);
      initial_speed_ = scene.bodies[b].velocity.norm();
    }
}

void StopWatch::every_step(const StepFrame &frame)
{
  if (frame.contact_force > 0)
    last_touch_ = frame.time;
}

void StopWatch::row(const RowFrame &frame)
{
  if (body_ < 0)
    return;
  const Vec3 v = mean_velocity(frame.sample(body_));
  times_.push_back(frame.time);
  velocities_.insert(velocities_.end(), {v.x(), v.y(), v.z()});
  while (times_.size() > 1 && times_[1] <= frame.time - rule_.window)
  {
    times_.erase(times_.begin());
    velocities_.erase(velocities_.begin(), velocities_.begin() + 3);
  }
  const bool window_full = times_.front() <= frame.time - rule_.window;
  const Vec3 then(velocities_[0], velocities_[1], velocities_[2]);
  stop_ = window_full && last_touch_ >= 0 && last_touch_ < times_.front() &&
          (v - then).norm() < rule_.tolerance * initial_speed_;
}

void StopWatch::save(ArchiveWriter &archive, const std::string &prefix) const
{
  archive.write(prefix + "/last_touch", last_touch_);
  archive.write(prefix + "/times", std::span<const double>(times_));
  archive.write(prefix + "/velocities", std::span<const double>(velocities_));
}

void StopWatch::load(const ArchiveReader &archive, const std::string &prefix)
{
  last_touch_ = archive.number(prefix + "/last_touch");
  times_      = archive.doubles(prefix + "/times");
  velocities_ = archive.doubles(prefix + "/velocities");
}
} // namespace ogive::coupling
