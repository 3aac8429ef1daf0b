// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "core/io/archive.h"
#include "coupling/observers/observer.h"

#include <string>
#include <vector>

namespace ogive::coupling
{
/// Ends a run early: the body has been in contact, has been free of every
/// contact for the window, and its velocity has changed over the window by less
/// than the tolerance times its initial speed.
class StopWatch
{
public:
  explicit StopWatch(const input::Scene &);

  void every_step(const StepFrame &);
  void row(const RowFrame &);
  bool stop() const { return stop_; }

  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  input::StopRule rule_;
  int             body_          = -1;
  double          initial_speed_ = 0;
  double          last_touch_    = -1; ///< s, -1: never touched
  std::vector<double> times_, velocities_; ///< rows of the last window; velocity: three numbers a row
  bool            stop_ = false;
};
} // namespace ogive::coupling
