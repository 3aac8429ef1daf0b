// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/machine_limits.h"

#include "core/base/aligned.h"
#include "core/base/simd.h"

#include <algorithm>
#include <ctime>
#include <malloc.h>

namespace ogive
{
namespace
{
double seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// The best of some sweeps, as is usual: the others were disturbed.
double bandwidth()
{
  constexpr std::size_t n = std::size_t(1) << 23; // 64 MiB an array
  AlignedVector<double> a(n, 0.), b(n, 1.), c(n, 2.);
  double                best = 0;
  for (int sweep = 0; sweep < 8; ++sweep)
  {
    const double start = seconds(), s = 1e-3 * sweep;
    for (std::size_t i = 0; i < n; ++i)
      a[i] = b[i] + s * c[i];
    const double elapsed = seconds() - start;
    b[sweep]             = a[n - 1 - sweep]; // the sweep has a use
    if (elapsed > 0)
      best = std::max(best, 3. * n * sizeof(double) / elapsed);
  }
  return best;
}

double multiply_adds()
{
  constexpr int         chains = 16; // more than latency times throughput of any core in use
  constexpr std::size_t rounds = 4000000;
  VDouble               x[chains];
  for (int k = 0; k < chains; ++k)
    x[k] = VDouble(1. + 1e-3 * k);
  volatile double factor_source = 1 - 1e-9; // not known when compiling
  const VDouble   factor(factor_source), term(1e-9 * factor_source);
  double          best = 0;
  for (int sweep = 0; sweep < 4; ++sweep)
  {
    const double start = seconds();
    for (std::size_t round = 0; round < rounds; ++round)
      for (int k = 0; k < chains; ++k)
        x[k] = x[k] * factor + term;
    const double elapsed = seconds() - start;
    if (elapsed > 0)
      best = std::max(best, 2. * chains * simd_width * rounds / elapsed);
  }
  VDouble sum(0.);
  for (const VDouble &v : x)
    sum += v;
  volatile double used = stdx::reduce(sum);
  (void)used;
  return best;
}
} // namespace

std::size_t bytes_in_use()
{
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

MachineLimits measure_limits()
{
  return {bandwidth(), multiply_adds()};
}
} // namespace ogive
