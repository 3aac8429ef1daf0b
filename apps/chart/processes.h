// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace ogive::chart
{
/// One program to run.
struct Job
{
  std::vector<std::string> command; ///< the program's path and its arguments, no shell
  double                   limit = 0; ///< s of wall time; 0: none
};

struct Ended
{
  int         exit = -1, signal = 0; ///< exit status, -1 if a signal ended it
  bool        too_long = false;
  double      wall_s   = 0;
  std::string out, err;
};

/// The last line that is not empty.
std::string last_line(const std::string &);

/// Runs all, `at_once` side by side, in their order. Their standard input is
/// empty. They end when this process does, however it does.
///
/// @param ended called here, one at a time, in the order in which they end;
///   an exception ends the others and goes on.
/// @param waiting called some ten times a second with the number that run.
/// Throws RunError if a program cannot be started.
void run_all(const std::vector<Job> &, int at_once, const std::function<void(std::size_t, const Ended &)> &ended,
             const std::function<void(std::size_t)> &waiting = {});

/// The path of the program that runs.
std::string own_program();
} // namespace ogive::chart
