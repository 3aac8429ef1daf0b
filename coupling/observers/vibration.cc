// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/vibration.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
double Oscillation::measure(const Sample &s, double time)
{
  const std::size_t i = nearest_node(s);
  enter(time, along(s.x, i) - along(s.x0, i));
  return periods() > 0 ? result() : std::numeric_limits<double>::quiet_NaN();
}

void Oscillation::enter(double time, double displacement)
{
  const double side = displacement > 0 ? 1 : displacement < 0 ? -1 : 0;
  if (side * side_ < 0)
  {
    ++passages_;
    if (passages_ % 2 == 0)
    {
      last_end_  = time_ + (time - time_) * displacement_ / (displacement_ - displacement);
      last_peak_ = peak_;
      if (passages_ == 2)
        first_peak_ = peak_;
      peak_ = 0;
    }
  }
  if (side != 0)
    side_ = side;
  peak_         = std::max(peak_, std::abs(displacement));
  time_         = time;
  displacement_ = displacement;
}

std::vector<double> Oscillation::memory() const
{
  std::vector<double> numbers = BodyObserver::memory();
  numbers.insert(numbers.end(), {static_cast<double>(passages_), side_, time_, displacement_, peak_,
                                 first_peak_, last_peak_, last_end_});
  return numbers;
}

void Oscillation::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  passages_     = static_cast<int>(numbers.at(1));
  side_         = numbers.at(2);
  time_         = numbers.at(3);
  displacement_ = numbers.at(4);
  peak_         = numbers.at(5);
  first_peak_   = numbers.at(6);
  last_peak_    = numbers.at(7);
  last_end_     = numbers.at(8);
}
} // namespace ogive::coupling
