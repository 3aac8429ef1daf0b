// SPDX-License-Identifier: LGPL-2.1-or-later
// The shipped scenes of structures as they are, minutes long: what their READMEs
// promise at full resolution.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace ogive::test;

// exact: period in the linear limit, validation A6
TEST(OscillatingPlateFull, ParticlesSwingInTime)
{
  const auto s = run_scene("oscillating-plate/scene.prm");
  EXPECT_LT(error(s, "period"), .01);
}

// exact: an elastic plate loses nothing
TEST(OscillatingPlateFull, ParticlesKeepSwingingThirtyPeriods)
{
  const auto s = run_scene("oscillating-plate/decay.prm");
  EXPECT_LT(std::abs(quantity(s, "amplitude_loss")), .1);
}
