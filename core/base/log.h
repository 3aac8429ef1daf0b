// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace ogive
{
/// Four significant figures, such as "1.234e-08".
std::string engineering(double value);

/// "element 1234 of body "plate" at (0.001, 0, 0.012) m: negative volume".
/// `bodies`: names of the scene's bodies; without them the index is given.
std::string describe(const Culprit &culprit, std::span<const std::string> bodies = {});

/// Where a run stands.
struct Progress
{
  double       time = 0, end_time = 0; ///< s
  double       start_time = 0;         ///< s, simulated time at which this process began
  double       wall       = 0;         ///< s of real time since then
  std::int64_t step       = 0;
  std::string  limiter;
  double       energy_drift = 0; ///< relative
};

/// Messages of a run. Progress is one line that is overwritten in place, shown
/// only on a terminal and at most five times a second; warnings are shown at
/// once, each text once, and kept for the summary.
class Log
{
public:
  /// Standard error, with progress if that is a terminal.
  Log();
  Log(std::ostream &out, bool terminal);

  void progress(const Progress &);
  void warn(const std::string &text);
  /// Shown, not kept.
  void note(const std::string &text);
  /// Ends the progress line, so that what comes next stands on its own.
  void finish();

  const std::vector<std::string> &warnings() const { return warnings_; }
  bool                            terminal() const { return terminal_; }

private:
  std::ostream            *out_;
  bool                     terminal_;
  bool                     line_open_ = false;
  double                   shown_     = -1; ///< wall time of the last line, s
  std::vector<std::string> warnings_;
};
} // namespace ogive
