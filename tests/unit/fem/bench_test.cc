// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/bench.h"
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
