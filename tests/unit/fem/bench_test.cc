// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/bench.h"
#include "core/base/machine_limits.h"
#include "fem/work_count.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

// The figure is elements times steps over the time taken; no time is asserted.
TEST(Bench, CountsElementsAndSteps)
{
  using namespace ogive::fem;
  const BenchResult r = bench(6, 5, test::make(test::copper_linear_hardening()));
  EXPECT_EQ(r.elements, 216u);
  EXPECT_EQ(r.steps, 5u);
  EXPECT_NEAR(r.element_steps_per_second * r.seconds, 216 * 5, 1e-6);
}

// Without a law that flows, the count is that of the same kernel less the
// return; the bytes are arrays of doubles, more of them a cell where the surface
// of the block weighs more.
TEST(Bench, CountsTheWorkOfAnElement)
{
  using namespace ogive::fem;
  ogive::materials::Parameters p = test::copper_linear_hardening();
  const ElementWork            small = count_work(4, p), large = count_work(48, p);
  EXPECT_NEAR(small.bytes - large.bytes, 8 * 40 * (125. / 64 - 117649. / 110592), 1e-9);
  EXPECT_NEAR(small.flops - large.flops, 27 * (125. / 64 - 117649. / 110592), 1e-9);
  EXPECT_GT(large.flops, 500);
}

// A core moves and multiplies something; how much is its own business.
TEST(Bench, MeasuresLimits)
{
  const ogive::MachineLimits limits = ogive::measure_limits();
  EXPECT_GT(limits.bytes_per_s, 1e8);
  EXPECT_GT(limits.flops, limits.bytes_per_s / 100);
}
