// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

namespace ogive::input
{
/// A factor in time: linear between its entries, held beyond the first and the
/// last; 1 at all times without entries.
struct History
{
  std::vector<double> time;   ///< s, strictly ascending
  std::vector<double> factor; ///< beside `time`

  bool empty() const { return time.empty(); }

  double at(double t) const
  {
    if (time.empty())
      return 1;
    const auto after = std::upper_bound(time.begin(), time.end(), t);
    if (after == time.begin())
      return factor.front();
    if (after == time.end())
      return factor.back();
    const auto   k = static_cast<std::size_t>(after - time.begin());
    const double s = (t - time[k - 1]) / (time[k] - time[k - 1]);
    return (1 - s) * factor[k - 1] + s * factor[k];
  }

  bool always_zero() const
  {
    return !time.empty() && std::all_of(factor.begin(), factor.end(), [](double f) { return f == 0; });
  }
};
} // namespace ogive::input
