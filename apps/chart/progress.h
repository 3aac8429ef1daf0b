// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace ogive::chart
{
/// One line on standard error that is overwritten in place: how many rows are
/// through, and about how long the rest takes. Nothing unless that is a terminal.
class Progress
{
public:
  /// @param work all that is to be done, in any unit; by default a row is 1.
  Progress(std::string verb, std::size_t rows, double work = 0);
  ~Progress();
  Progress(const Progress &)            = delete;
  Progress &operator=(const Progress &) = delete;

  void ended(double work);
  void show(std::size_t running);

private:
  std::string                           verb_;
  std::size_t                           rows_, through_ = 0;
  double                                work_, done_ = 0;
  std::chrono::steady_clock::time_point start_;
  bool                                  terminal_, open_ = false;
};

/// "40 s", "3 min", "2 h 05 min".
std::string rough_duration(double seconds);
} // namespace ogive::chart
