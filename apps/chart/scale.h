// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace ogive::chart
{
struct Tick
{
  double      value = 0;
  std::string label; ///< empty for a minor tick
};

/// An axis of a picture: it begins and ends at round numbers.
struct Scale
{
  bool              log  = false;
  double            low  = 0, high = 1;
  std::vector<Tick> ticks;

  /// 0 at `low`, 1 at `high`.
  double at(double value) const;
};

/// Ticks at steps of 1, 2 or 5 times a power of ten, some five to ten of them.
Scale linear_scale(double least, double greatest);

/// Labels at powers of ten; where there are few, at 2 and 5 times them too.
/// @param least must be positive
Scale log_scale(double least, double greatest);
} // namespace ogive::chart
