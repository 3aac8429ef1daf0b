// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>

namespace ogive
{
/// What one core of this machine can do at most, measured.
struct MachineLimits
{
  double bytes_per_s = 0; ///< a[i] = b[i] + s c[i] over arrays far beyond the caches: two reads, one write
  double flops       = 0; ///< 1/s: independent fused multiply-adds in double, two operations each
};

/// Bytes that this process has asked for and not given back.
std::size_t bytes_in_use();

/// Takes about half a second of processor time.
MachineLimits measure_limits();
} // namespace ogive
