// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <ctime>

namespace ogive::coupling
{
/// Adds the processor time of its life to a counter.
class Stopwatch
{
public:
  explicit Stopwatch(double &seconds)
    : seconds_(seconds)
    , start_(std::clock())
  {}
  ~Stopwatch() { seconds_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
  double      &seconds_;
  std::clock_t start_;
};
} // namespace ogive::coupling
