// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/time/clock.h"

#include "core/base/error.h"
#include "core/base/log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ogive
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
}

Clock::Clock(double end_time, StepControl control)
  : control_(std::move(control))
  , end_time_(end_time)
  , cap_(infinity)
{
  require(std::isfinite(end_time) && end_time > 0, "a clock needs a positive, finite end time");
  require(control_.growth > 1, "the step's growth must be above 1");
  require(control_.smallest_step_ratio > 0 && control_.smallest_step_ratio < 1,
          "the smallest step's ratio must lie between 0 and 1");
}

void Clock::fail(double dt, const Culprit &culprit) const
{
  throw RunError("the time step fell to " + engineering(dt) + " s at time " + engineering(time_) +
                 " s (step " + std::to_string(step_) + "); smallest allowed " +
                 engineering(control_.smallest_step_ratio * first_) + " s; limited by " +
                 describe(culprit, control_.bodies));
}

TimeStep Clock::plan(const StepLimit &limit)
{
  require(!done(), "the clock has reached its end");
  if (!(limit.dt > 0))
    throw RunError("the stable time step is " + engineering(limit.dt) + " s at time " +
                   engineering(time_) + " s (step " + std::to_string(step_) + "); limited by " +
                   describe(limit.culprit, control_.bodies));

  const double grown = previous_ > 0 ? control_.growth * previous_ : infinity;
  double       dt    = std::min({limit.dt, grown, cap_});
  if (first_ > 0 && dt < control_.smallest_step_ratio * first_)
    fail(dt, limit.culprit);

  const double remaining = end_time_ - time_;
  // A step that no longer moves the clock would never end the run.
  if (!(time_ + dt > time_))
    fail(dt, limit.culprit);
  last_ = remaining <= dt;
  if (last_)
    dt = remaining;
  else if (remaining < 2 * dt)
    dt = remaining / 2;
  if (first_ == 0)
    first_ = dt;

  planned_ = dt;
  return {.time = time_, .kick = (previous_ + dt) / 2, .drift = dt};
}

void Clock::advance()
{
  require(planned_ > 0, "no step is planned");
  time_     = last_ ? end_time_ : time_ + planned_;
  previous_ = std::exchange(planned_, 0.);
  cap_      = infinity;
  ++step_;
}

void Clock::shrink(const Culprit &culprit)
{
  require(planned_ > 0, "no step is planned");
  cap_ = planned_ / 2;
  ++rejected_;
  if (cap_ < control_.smallest_step_ratio * first_)
    fail(cap_, culprit);
  planned_ = 0;
}

void Clock::save(ArchiveWriter &archive, const std::string &prefix) const
{
  require(planned_ == 0 && cap_ == infinity, "a clock is saved between steps");
  archive.write(prefix + "/step", step_);
  archive.write(prefix + "/rejected", rejected_);
  archive.write(prefix + "/time", time_);
  archive.write(prefix + "/previous", previous_);
  archive.write(prefix + "/first", first_);
}

void Clock::load(const ArchiveReader &archive, const std::string &prefix)
{
  step_     = archive.integer(prefix + "/step");
  rejected_ = archive.integer(prefix + "/rejected");
  time_     = archive.number(prefix + "/time");
  previous_ = archive.number(prefix + "/previous");
  first_    = archive.number(prefix + "/first");
  planned_  = 0;
  cap_      = infinity;
  last_     = false;
}

Schedule::Schedule(double interval)
  : interval_(interval)
{
  require(std::isfinite(interval) && interval >= 0, "a schedule needs an interval >= 0");
}

bool Schedule::due(const Clock &clock)
{
  const double t = clock.time();
  if (interval_ == 0 || t < static_cast<double>(next_) * interval_)
    return false;
  // Multiples that the last step jumped over are passed at once; the loop mends
  // the rounding of the quotient, and beyond 2^53 every step fires.
  const double passed = std::floor(t / interval_);
  if (passed < 0x1p53)
    {
      next_ = std::max(next_, static_cast<std::int64_t>(passed)) + 1;
      while (static_cast<double>(next_ - 1) * interval_ > t)
        --next_;
      while (static_cast<double>(next_) * interval_ <= t)
        ++next_;
    }
  return true;
}

void Schedule::save(ArchiveWriter &archive, const std::string &prefix) const
{
  archive.write(prefix + "/next", next_);
}

void Schedule::load(const ArchiveReader &archive, const std::string &prefix)
{
  next_ = archive.integer(prefix + "/next");
}
} // namespace ogive
