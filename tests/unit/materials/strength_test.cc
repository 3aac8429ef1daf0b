// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/laws.h"
#include "one_point.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::materials
{
using test::OnePoint;

namespace
{
/// The formula of Johnson and Cook, written out for comparison.
double formula(const Parameters &p, double eps, double rate, double temperature)
{
  const StrengthParameters &s = p.strength;
  const double t = (temperature - p.thermal.reference_temperature) /
                   (p.thermal.melt_temperature - p.thermal.reference_temperature);
  return (s.yield_stress + s.hardening * std::pow(eps, s.exponent)) *
         (1 + s.rate_coefficient * std::max(0., std::log(rate / s.reference_rate))) *
         (1 - std::pow(std::max(0., t), s.thermal_exponent));
}
} // namespace

// OFHC copper at eps .2, 5000/s, 500 K: (90 + 292 .2^.31)(1 + .025 ln 5000)
// (1 - (206/1062)^1.09) MPa, worked out with a calculator to seven digits.
TEST(Strength, JohnsonCookAtOnePoint)
{
  Parameters p              = test::parameters("linear", "johnson-cook");
  p.strength.reference_rate = 1;
  const JohnsonCook law     = JohnsonCook::from(p);
  const double      hard    = 90 + 292 * .6071826; // .2^.31
  const double      rate    = 1 + .025 * 8.5171932;
  const double      heat    = 1 - .1673553; // (206/1062)^1.09
  EXPECT_NEAR(law.stress(.2, 5000, 500), hard * rate * heat * 1e6, 1e-6 * hard * rate * heat * 1e6);
  EXPECT_DOUBLE_EQ(law.stress(0, 1e-9, 200), 90e6); // below both references
  EXPECT_DOUBLE_EQ(law.stress(.3, 1e3, 1356), 0);   // molten
}

// At constant shear rate the stress must satisfy the formula at the end of each
// step, with the rate of the step and the temperature that the work gave.
TEST(Strength, JohnsonCookHoldsAlongAHeatingPath)
{
  const Parameters p = test::parameters("linear", "johnson-cook");
  OnePoint         point(p);
  const double     dt = 7e-8, rate = 4e4;
  double           temperature = 294, eps = 0;
  int              yielded = 0;
  for (int i = 0; i < 600; ++i)
    {
      const double before = point.points.plastic_strain[0];
      ASSERT_EQ(point.step({0, 0, 0, rate * dt / 2, 0, 0}, dt), Status::ok);
      eps            = point.points.plastic_strain[0];
      const double x = eps - before;
      if (x == 0)
        continue;
      ++yielded;
      temperature += .9 * point.mises() * x / (8930 * 383);
      ASSERT_NEAR(point.points.temperature[0], temperature, 1e-10 * temperature);
      const double y = formula(p, eps, x / dt, temperature);
      ASSERT_NEAR(point.mises(), y, 1e-10 * y) << "step " << i;
    }
  EXPECT_GT(yielded, 590);
  EXPECT_GT(temperature, 330);
}

// Hardening, rate and melt over many decades: the solver always ends on the
// yield surface, and never misses that there is no yield.
TEST(Strength, JohnsonCookSolverOverRandomTrials)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> u(0, 1);
  for (int k = 0; k < 20000; ++k)
    {
      Parameters p                = test::parameters("linear", "johnson-cook");
      p.strength.exponent         = .05 + 1.2 * u(random);
      p.strength.thermal_exponent = .4 + 1.2 * u(random);
      p.strength.rate_coefficient = u(random) < .2 ? 0 : .08 * u(random);
      p.strength.hardening        = u(random) < .2 ? 0 : 9e8 * u(random);
      const JohnsonCook law = JohnsonCook::from(p);
      Trial<double>     t;
      t.stress         = 90e6 * std::pow(10., 3 * u(random) - .5);
      t.old_stress     = t.stress * 1.2 * u(random);
      t.three_g        = 130e9;
      t.plastic_strain = u(random) < .3 ? 0 : std::pow(10., -6 + 7 * u(random));
      t.temperature    = 250 + 1300 * u(random);
      t.dt             = std::pow(10., -10 + 8 * u(random));
      t.heating        = u(random) < .2 ? 0 : .9 / (8930 * 383);
      const Flow   f   = law.flow(t);
      const double q   = t.stress - t.three_g * f.increment;
      const double y0  = law.stress(t.plastic_strain, 0, t.temperature);
      ASSERT_LE(law.elastic_up_to(t.plastic_strain, t.temperature), y0 * (1 + 1e-14));
      if (t.stress <= y0)
        {
          ASSERT_EQ(f.increment, 0) << k;
          continue;
        }
      ASSERT_GT(f.increment, 0) << k;
      const double y = law.stress(t.plastic_strain + f.increment, f.increment / t.dt,
                                  t.temperature + t.heating * q * f.increment);
      ASSERT_NEAR(q, y, 1e-10 * t.stress) << k;
      ASSERT_NEAR(f.work, q * f.increment, 1e-12 * t.stress * f.increment);
    }
}

// The library's functions are within an ulp; the bounds are those that the
// functions promise, over many decades and on both sides of every power of two.
TEST(Strength, LogarithmAndExponentialOfRegistersMatchTheLibrary)
{
  for (double x = 1e-300; x < 1e300; x *= 1.037)
    ASSERT_NEAR(lane_log(VDouble(x))[0], std::log(x), 2.5e-16 * (1 + std::abs(std::log(x)))) << x;
  for (double x = -699; x < 700; x += .0317)
    ASSERT_NEAR(lane_exp(VDouble(x))[0], std::exp(x), 5e-16 * std::exp(x)) << x;
  EXPECT_EQ(lane_log(VDouble(1.))[0], 0);
  EXPECT_EQ(lane_exp(VDouble(0.))[0], 1);
  for (const double n : {.12, .31, .55, 1.09, 1.34})
    for (double x = 3e-5; x < 4; x *= 1.0049)
      ASSERT_NEAR(lane_power(VDouble(x), n)[0], std::pow(x, n), 4e-15 * std::pow(x, n));
}

// Small steps go by series from an anchor, large ones anew; the lanes run at
// different paces, so that each has anchors of its own.
TEST(Strength, NearbyPowerAndLogMatchTheLibrary)
{
  const VMask all = VDouble(0.) == VDouble(0.);
  for (const double n : {.12, .31, .55, 1.09, 1.34})
    {
      const PowerSeries    series(n);
      NearbyPower<VDouble> power(series);
      NearbyLog<VDouble>   log;
      for (VDouble x = 3e-5; x[0] < 4; x *= VDouble([](auto lane) { return 1.0049 - .0011 * lane; }))
        {
          const VDouble p = power(x, all), l = log(x, all);
          for (int k = 0; k < simd_width; ++k)
            {
              ASSERT_NEAR(p[k], std::pow(x[k], n), 2e-14 * std::pow(x[k], n));
              ASSERT_NEAR(l[k], std::log(x[k]), 1e-14 * (1 + std::abs(std::log(x[k]))));
            }
        }
    }
}

// A register of points of different fates (elastic, barely yielding, far out,
// molten) returns each as if it were alone, whatever its neighbours do.
TEST(Strength, JohnsonCookReturnsARegisterAsItReturnsEachPoint)
{
  const JohnsonCook law = JohnsonCook::from(test::parameters("linear", "johnson-cook"));
  std::mt19937                           random(11);
  std::uniform_real_distribution<double> u(0, 1);
  const auto draw = [&] {
    const double stress = 90e6 * std::pow(10., 3 * u(random) - .5);
    return Trial<double>{stress, stress * 1.2 * u(random), 130e9,
                         u(random) < .3 ? 0 : std::pow(10., -6 + 7 * u(random)), 250 + 1300 * u(random), 1e-7,
                         .9 / (8930 * 383)};
  };
  for (int k = 0; k < 3000; ++k)
    {
      Trial<double>  one[simd_width];
      Trial<VDouble> all{VDouble(0.), VDouble(0.), 130e9, VDouble(0.), VDouble(0.), 1e-7, VDouble(0.)};
      for (int l = 0; l < simd_width; ++l)
        {
          one[l]                = draw();
          all.stress[l]         = one[l].stress;
          all.old_stress[l]     = one[l].old_stress;
          all.plastic_strain[l] = one[l].plastic_strain;
          all.temperature[l]    = one[l].temperature;
          all.heating[l]        = one[l].heating;
        }
      const Flow<VDouble> together = law.flow(all);
      for (int l = 0; l < simd_width; ++l)
        {
          const Flow<double> alone = law.flow(one[l]);
          ASSERT_NEAR(together.increment[l], alone.increment, 2e-12 * one[l].stress / 130e9);
          Trial<VDouble> same{VDouble(one[l].stress), VDouble(one[l].old_stress), 130e9,
                              VDouble(one[l].plastic_strain), VDouble(one[l].temperature), 1e-7,
                              VDouble(one[l].heating)};
          ASSERT_EQ(together.increment[l], law.flow(same).increment[0]); // to the bit
        }
    }
}
} // namespace ogive::materials
