// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"
#include "core/io/archive.h"
#include "core/time/time_step.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ogive
{
/// How the step may change.
struct StepControl
{
  double growth              = 1.05; ///< a step is at most this times the one before
  double smallest_step_ratio = 1e-3; ///< of the first step; below it the run fails
  /// Names of the scene's bodies, so that a failure names the body.
  std::vector<std::string> bodies = {};
};

/// Counts the steps and chooses their length.
///
/// Each turn: plan(), the solvers step, then advance(); or, when the step was
/// rejected and the state restored, shrink() and plan() again. The end time is
/// met to the bit, with the last two steps of about equal length; no other time
/// bends a step, so output never changes the answer.
class Clock
{
public:
  /// `end_time` in s, positive and finite; starts at time 0.
  explicit Clock(double end_time, StepControl control = {});

  std::int64_t step() const { return step_; }
  double       time() const { return time_; }         ///< s
  double       end_time() const { return end_time_; } ///< s
  /// Length of the last accepted step, s; 0 before the first.
  double dt() const { return previous_; }
  bool   done() const { return time_ >= end_time_; }

  /// Chooses the next step under the solvers' bound. Throws RunError naming the
  /// culprit when the bound is not a positive number, or when the step has
  /// fallen below the smallest one allowed.
  TimeStep plan(const StepLimit &limit);

  /// The planned step was good.
  void advance();

  /// The planned step was rejected: the next plan is at most half of it. From
  /// there `growth` lets it recover. Throws RunError naming the culprit when
  /// half of it is below the smallest step allowed.
  void shrink(const Culprit &culprit);

  /// Steps rejected since the start.
  std::int64_t rejected() const { return rejected_; }

  /// Between steps only: a plan that is not yet accepted is not kept.
  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  [[noreturn]] void fail(double dt, const Culprit &culprit) const;

  StepControl  control_;
  double       end_time_;
  std::int64_t step_     = 0;
  std::int64_t rejected_ = 0;
  double       time_     = 0;
  double       previous_ = 0; ///< last accepted step
  double       first_    = 0; ///< first step planned, the measure of the smallest
  double       planned_  = 0; ///< 0: nothing planned
  double       cap_;          ///< after a rejection, infinite otherwise
  bool         last_ = false; ///< the planned step ends the run
};

/// Fires at the first step at or after each multiple of an interval, the zeroth
/// included; an interval of 0 never fires. Multiples are counted as integers,
/// so no rounding of a sum of steps drops or doubles one.
class Schedule
{
public:
  explicit Schedule(double interval = 0); ///< s, >= 0

  /// Whether an event falls due now; asking again in the same step says no.
  bool due(const Clock &clock);

  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  double       interval_;
  std::int64_t next_ = 0; ///< the next multiple to fire
};
} // namespace ogive
