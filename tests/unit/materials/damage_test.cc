// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/laws.h"
#include "one_point.h"

#include <gtest/gtest.h>

namespace ogive::materials
{
using test::OnePoint;

// D = D_c eps_p/eps_f at constant triaxiality, rate and temperature, failed when
// eps_p reaches eps_f, whatever D_c.
TEST(Damage, JohnsonCookClosedForm)
{
  for (const double critical : {.3, 1.})
    {
      Parameters p      = test::parameters("linear", "elastic", "johnson-cook");
      p.damage.critical = critical;
      const auto   law  = JohnsonCookDamage::from(p);
      const double t = 600, rate = 700, triaxiality = 1. / 3, x = 1e-3;
      const double eps_f = (.4 + 1.1 * std::exp(-.7 / 3)) * (1 + .014 * std::log(700. / 3)) *
                           (1 + .9 * (600. - 294) / (1356 - 294));
      EXPECT_NEAR(law.fracture_strain(triaxiality, rate, t), eps_f, 1e-14);
      const int n      = static_cast<int>(std::floor(eps_f / x));
      double    damage = 0;
      for (int i = 1; i <= n; ++i)
        {
          damage = law.after({damage, i * x, x, triaxiality * 2e8, 2e8, t, x / rate});
          ASSERT_NEAR(damage, critical * i * x / eps_f, 1e-10);
        }
      EXPECT_EQ(law.after({damage, eps_f, x, triaxiality * 2e8, 2e8, t, x / rate}), 1);
    }
}

// Pure shear has no mean stress: eps_f = D1 + D2 without rate and heat terms. The
// stored stress is (1 - D) times that of the undamaged material.
TEST(Damage, ShearSoftensAndFails)
{
  Parameters p    = test::parameters("linear", "perfect-plastic", "johnson-cook");
  p.damage.d4     = 0;
  p.damage.d5     = 0;
  const double ef = 1.5, y = 90e6;
  OnePoint     point(p);
  bool         failed = false;
  for (int i = 0; i < 4000; ++i)
    {
      const double before = point.points.plastic_strain[0];
      ASSERT_EQ(point.step({0, 0, 0, 0, 0, 5e-4}, 1e-7), Status::ok);
      const double eps = point.points.plastic_strain[0], d = point.points.damage[0];
      if (d < 1)
        {
          ASSERT_NEAR(d, .4 * eps / ef, 1e-9);
          if (eps > 0)
            {
              ASSERT_NEAR(point.mises(), (1 - d) * y, 1e-9 * y);
            }
        }
      else if (!failed)
        {
          failed = true;
          EXPECT_GE(eps, ef - 1e-9);
          EXPECT_LT(before, ef);
        }
    }
  ASSERT_TRUE(failed);
  EXPECT_EQ(point.mises(), 0);
  const double k = test::bulk_modulus(p);
  // A failed point carries pressure and no tension; its c has no shear part.
  point.step({-2e-3, 0, 0, 0, 0, 0}, 1e-7);
  EXPECT_NEAR(point.pressure(), k * std::expm1(2e-3), 1e-9 * k);
  EXPECT_LT(point.mises(), 1e-14 * k); // rounding of the pressure only
  EXPECT_NEAR(point.points.sound_speed[0], std::sqrt(k / 8930), 1e-9 * 4000);
  point.step({6e-3, 0, 0, 0, 0, 0}, 1e-7);
  EXPECT_NEAR(point.pressure(), 0, 1);
  const double strain = point.points.plastic_strain[0];
  point.step({0, 0, 0, 1e-2, 0, 0}, 1e-7);
  EXPECT_EQ(point.points.plastic_strain[0], strain);
}

// Tension of a damaged point is (1 - D) of the undamaged pressure law, read anew
// each step: no factor builds up.
TEST(Damage, TensionSoftensOnce)
{
  const Parameters p = test::parameters("linear", "elastic", "johnson-cook");
  OnePoint         point(p);
  point.points.damage[0] = .25;
  for (int i = 0; i < 30; ++i)
    point.step({1e-4, 1e-4, 1e-4, 0, 0, 0}, 1e-8);
  const double k = test::bulk_modulus(p);
  EXPECT_NEAR(point.pressure(), .75 * k * std::expm1(-30 * 3e-4), 1e-9 * k);
}

TEST(Damage, DeviatorOfADamagedPointIsScaledOnce)
{
  const Parameters p = test::parameters("linear", "elastic", "johnson-cook");
  OnePoint         point(p);
  point.points.damage[0] = .25;
  for (int i = 0; i < 30; ++i)
    point.step({0, 0, 0, 1e-4, 0, 0}, 1e-8);
  EXPECT_NEAR(point.stress().xy, .75 * 2 * test::shear_modulus(p) * 30e-4, 1e-3);
}

TEST(Damage, SpallAtTheMeanStress)
{
  const Parameters p = test::parameters("linear", "elastic", "tension");
  OnePoint         point(p);
  const double     k = test::bulk_modulus(p), d = 2e-4;
  const int        last = static_cast<int>(std::floor(-std::log(1 - 1.2e9 / k) / d));
  for (int i = 0; i < last; ++i)
    point.step({d, 0, 0, 0, 0, 0}, 1e-8);
  EXPECT_EQ(point.points.damage[0], 0);
  EXPECT_LT(point.pressure(), -1.17e9);
  point.step({d, 0, 0, 0, 0, 0}, 1e-8);
  EXPECT_EQ(point.points.damage[0], 1);
  EXPECT_EQ(point.pressure(), 0);
  EXPECT_EQ(point.mises(), 0);
}

TEST(Damage, FailsAtThePlasticStrain)
{
  const Parameters p = test::parameters("linear", "perfect-plastic", "plastic-strain");
  OnePoint         point(p);
  const double     x = 1e-3;
  double           last = 0;
  while (point.points.damage[0] == 0)
    {
      last = point.points.plastic_strain[0];
      ASSERT_LT(last, .36);
      point.step({0, 0, 0, x, 0, 0}, 1e-7);
    }
  EXPECT_LT(last, .35);
  EXPECT_GE(point.points.plastic_strain[0], .35);
  EXPECT_EQ(point.mises(), 0);
}
} // namespace ogive::materials
