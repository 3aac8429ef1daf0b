// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/time/clock.h"

#include "core/base/error.h"
#include "core/io/memory_archive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace ogive;

const StepLimit limit_of(double dt)
{
  return {.dt = dt, .culprit = {.entity = "element", .body = 1, .id = 42, .where = {.001, -.02, .3}, .why = "thin"}};
}

std::string message_of(const auto &action)
{
  try
    {
      action();
    }
  catch (const RunError &e)
    {
      return e.what();
    }
  return "no RunError";
}

// The end is met to the bit and no step is small: the last two share what is
// left, so none is below half the bound.
TEST(Clock, LandsOnTheEndWithoutATinyStep)
{
  for (const double dt : {1.37e-8, 3.3333e-8, 9.99e-7, 1.0000001e-6, 2.5e-6})
    {
      const double end = 1e-5;
      Clock        clock(end);
      double       smallest = end, largest = 0, sum = 0;
      while (!clock.done())
        {
          const TimeStep step = clock.plan(limit_of(dt));
          EXPECT_EQ(step.time, clock.time());
          EXPECT_DOUBLE_EQ(step.kick, (clock.dt() + step.drift) / 2);
          smallest = std::min(smallest, step.drift);
          largest  = std::max(largest, step.drift);
          sum += step.drift;
          clock.advance();
        }
      EXPECT_EQ(clock.time(), end);
      EXPECT_LE(largest, dt);
      EXPECT_GE(smallest, .499 * dt);
      EXPECT_NEAR(sum, end, 1e-12 * end);
      EXPECT_GE(static_cast<double>(clock.step()), end / dt);
      EXPECT_LE(static_cast<double>(clock.step()), end / dt + 2);
    }
}

// The sum of the kicks up to a step is the time of the middle of the step:
// the velocities of the leapfrog live there.
TEST(Clock, KicksCarryTheVelocityToTheMiddleOfTheStep)
{
  Clock  clock(3e-6);
  double kicks = 0;
  for (int n = 0; !clock.done(); ++n)
    {
      const TimeStep step = clock.plan(limit_of(1.7e-8 * (1 + .3 * std::sin(n))));
      kicks += step.kick;
      EXPECT_NEAR(kicks, step.time + step.drift / 2, 1e-12 * clock.end_time());
      clock.advance();
    }
}

TEST(Clock, GrowsByTheGivenFactorAndShrinksAtOnce)
{
  Clock clock(1, {.growth = 1.1});
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(2e-6)).drift, 2e-6);
  clock.advance();
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(1e-3)).drift, 2.2e-6);
  clock.advance();
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(1e-3)).drift, 2.42e-6);
  clock.advance();
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(3e-7)).drift, 3e-7);
}

TEST(Clock, HalvesARejectedStepAndRecoversSlowly)
{
  Clock clock(1, {.growth = 1.05});
  clock.plan(limit_of(4e-6));
  clock.advance();
  const double time = clock.time();
  clock.plan(limit_of(4e-6));
  clock.shrink({});
  EXPECT_EQ(clock.time(), time);
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(4e-6)).drift, 2e-6);
  clock.shrink({});
  const TimeStep third = clock.plan(limit_of(4e-6));
  EXPECT_DOUBLE_EQ(third.drift, 1e-6);
  EXPECT_DOUBLE_EQ(third.kick, (4e-6 + 1e-6) / 2);
  clock.advance();
  EXPECT_DOUBLE_EQ(clock.plan(limit_of(4e-6)).drift, 1.05e-6);
  EXPECT_EQ(clock.rejected(), 2);
  EXPECT_EQ(clock.step(), 2);
}

TEST(Clock, NamesTheCulpritWhenTheStepCollapses)
{
  Clock clock(1, {.smallest_step_ratio = .01, .bodies = {"bar", "plate"}});
  clock.plan(limit_of(3e-7));
  clock.advance();
  clock.plan(limit_of(3.1e-9));
  clock.advance();
  const std::string text = message_of([&] { clock.plan(limit_of(2.9e-9)); });
  for (const char *part : {"element 42", "body \"plate\"", "(0.001, -0.02, 0.3) m", "thin", "2.9e-09 s",
                           "3e-09 s", "3.031e-07 s"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(Clock, GivesUpAfterTooManyRejections)
{
  Clock clock(1, {.smallest_step_ratio = .1});
  int   rejections = 0;
  EXPECT_THROW(
    while (true) {
      clock.plan(limit_of(2e-7));
      ++rejections;
      clock.shrink({.entity = "particle", .id = 7});
    },
    RunError);
  // 1/2, 1/4, 1/8 pass, 1/16 is below a tenth.
  EXPECT_EQ(rejections, 4);
}

TEST(Clock, RefusesABoundThatIsNoPositiveNumber)
{
  for (const double dt : {0., -1e-9, std::numeric_limits<double>::quiet_NaN()})
    {
      Clock             clock(1, {.bodies = {"bar", "plate"}});
      const std::string text = message_of([&] { clock.plan(limit_of(dt)); });
      EXPECT_NE(text.find("element 42 of body \"plate\""), std::string::npos) << text;
    }
}

// Unbroken against saved and loaded after each single step.
TEST(Clock, ContinuesToTheBitFromAnArchive)
{
  const auto bound = [](std::int64_t n) { return limit_of(2e-8 * (1.2 + std::cos(.7 * static_cast<double>(n)))); };
  Clock      clock(1e-6), copy(1e-6);
  Schedule   events(1.1e-7), event_copy(1.1e-7);
  while (!clock.done())
    {
      io::MemoryArchive archive;
      clock.save(archive, "clock");
      events.save(archive, "events");
      copy.load(archive, "clock");
      event_copy.load(archive, "events");
      const TimeStep a = clock.plan(bound(clock.step())), b = copy.plan(bound(copy.step()));
      EXPECT_EQ(a.time, b.time);
      EXPECT_EQ(a.kick, b.kick);
      EXPECT_EQ(a.drift, b.drift);
      clock.advance();
      copy.advance();
      EXPECT_EQ(events.due(clock), event_copy.due(copy));
    }
  EXPECT_TRUE(copy.done());
}

// One event for each multiple k of the interval in [0, end], at the first
// step that reaches it. The steps are a sixth, a seventh ... of the interval,
// where sums of steps miss the multiples by rounding.
TEST(Schedule, FiresOncePerMultiple)
{
  const double interval = 1e-6;
  for (const int per_interval : {3, 6, 7, 10, 30})
    {
      Clock    clock(20.5 * interval, {.growth = 1.05});
      Schedule schedule(interval);
      int      fired = schedule.due(clock) ? 1 : 0;
      EXPECT_FALSE(schedule.due(clock));
      double before = 0;
      while (!clock.done())
        {
          clock.plan(limit_of(interval / per_interval));
          clock.advance();
          bool reaches = false;
          for (int k = 0; k <= 20; ++k)
            reaches = reaches || (before < k * interval && k * interval <= clock.time());
          const bool due = schedule.due(clock);
          EXPECT_EQ(due, reaches);
          fired += due ? 1 : 0;
          EXPECT_FALSE(schedule.due(clock));
          before = clock.time();
        }
      EXPECT_EQ(fired, 21) << per_interval;
    }
}

TEST(Schedule, PassesOverMultiplesInsideOneStep)
{
  Clock    clock(1e-5);
  Schedule often(1e-8), never(0), absurd(1e-300);
  int      fired = 0;
  while (!clock.done())
    {
      fired += often.due(clock) ? 1 : 0;
      EXPECT_TRUE(absurd.due(clock));
      EXPECT_FALSE(never.due(clock));
      clock.plan(limit_of(1e-6));
      clock.advance();
    }
  EXPECT_EQ(fired, clock.step());
}
} // namespace
