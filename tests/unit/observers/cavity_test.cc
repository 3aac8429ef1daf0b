// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/cavity.h"

#include <gtest/gtest.h>

namespace ogive::coupling
{
namespace
{
const BlakeCavity cavity{.1, 1e6, 3000, 25e9, 25e9};

// Table of LANL's ExactPack (solver "blake") at 160 us, six figures.
TEST(Cavity, IsThatOfTheTable)
{
  const double r[5] = {.1, .2, .4, .6, .8};
  const double u[5] = {1.00175e-6, 2.49318e-7, 5.14602e-8, 4.03625e-8, 7.97658e-8};
  const double s[5] = {-.99997e6, -1.28093e5, -1.91862e4, 1.96453e4, -1.09538e4};
  const double h[5] = {5.0146e5, 6.1185e4, 4325.5, 1.21543e4, 4657.7};
  for (int k = 0; k < 5; ++k)
  {
    // the table's displacement of the wall is 2e-5 low: by hand 1.00177e-6 m
    EXPECT_NEAR(cavity.displacement(r[k], 160e-6) / u[k], 1, 3e-5) << r[k];
    EXPECT_NEAR(cavity.radial_stress(r[k], 160e-6) / s[k], 1, 4e-5) << r[k];
    EXPECT_NEAR(cavity.hoop_stress(r[k], 160e-6) / h[k], 1, 4e-5) << r[k];
  }
  EXPECT_EQ(cavity.displacement(.901, 160e-6), 0); // the wave has not come: 5 km/s
}

// The field obeys Hooke's law and Newton's, by differences.
TEST(Cavity, MovesByItsOwnStress)
{
  const double r = .35, t = 90e-6, dr = 1e-4, dt = 1e-8;
  const double slope  = (cavity.displacement(r + dr, t) - cavity.displacement(r - dr, t)) / (2 * dr);
  const double radial = (cavity.lambda + 2 * cavity.shear) * slope + 2 * cavity.lambda * cavity.displacement(r, t) / r;
  EXPECT_NEAR(cavity.radial_stress(r, t) / radial, 1, 1e-5);
  const double acceleration =
    (cavity.displacement(r, t + dt) - 2 * cavity.displacement(r, t) + cavity.displacement(r, t - dt)) / (dt * dt);
  const double force = (cavity.radial_stress(r + dr, t) - cavity.radial_stress(r - dr, t)) / (2 * dr) +
                       2 * (cavity.radial_stress(r, t) - cavity.hoop_stress(r, t)) / r;
  EXPECT_NEAR(force / (cavity.density * acceleration), 1, 1e-3);
}

// A linear rise of .1 us is nearly a step at its middle; a long one is the sum of
// a thousand small steps.
TEST(Cavity, HistoriesAreSuperposed)
{
  const double r = .3, t = 120e-6;
  EXPECT_NEAR(cavity.displacement(r, t, {}) / cavity.displacement(r, t), 1, 1e-15);
  EXPECT_NEAR(cavity.displacement(r, t, {{0, 1e-7}, {0, 1}}) / cavity.displacement(r, t - .5e-7), 1, 1e-5);
  double    sum = 0;
  const int n   = 1000;
  for (int k = 0; k < n; ++k)
    sum += .7 / n * cavity.displacement(r, t - 50e-6 * (k + .5) / n);
  sum += .3 * cavity.displacement(r, t);
  EXPECT_NEAR(cavity.displacement(r, t, {{0, 50e-6}, {.3, 1}}) / sum, 1, 1e-5);
}
} // namespace
} // namespace ogive::coupling
