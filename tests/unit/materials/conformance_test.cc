// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs over every combination of the registered laws: what any of them must obey.
#include "core/materials/laws.h"
#include "one_point.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace ogive::materials
{
using test::OnePoint;

namespace
{
using Combination = std::tuple<std::string, std::string, std::string>;

std::string label(const testing::TestParamInfo<Combination> &info)
{
  std::string s = std::get<0>(info.param) + "_" + std::get<1>(info.param) + "_" + std::get<2>(info.param);
  std::replace(s.begin(), s.end(), '-', '_');
  return s;
}

class Conformance : public testing::TestWithParam<Combination>
{
protected:
  Parameters parameters() const
  {
    const auto &[eos, strength, damage] = GetParam();
    return test::parameters(eos, strength, damage);
  }
  static void warm(OnePoint &point)
  {
    if (point.material->parameters().eos.law == "ideal-gas")
      point.points.energy[0] = 2e6;
  }
};
} // namespace

TEST_P(Conformance, RandomPathsDissipateAndStayInsideTheYieldSurface)
{
  const Parameters  p   = parameters();
  const AnyStrength law = Laws<AnyStrength>::build(p.strength.law, p, "Strength/law");
  const double      g   = test::shear_modulus(p);
  std::mt19937      random(11);
  std::normal_distribution<double> normal;
  for (int path = 0; path < 6; ++path)
    {
      OnePoint point(p);
      warm(point);
      const double size = std::pow(10., -4.5 + .4 * path), dt = 2e-7;
      for (int i = 0; i < 150; ++i)
        {
          const Points before = point.points;
          const double swell  = .3 * size * std::sin(.05 * i); // goes to and fro, stays near rho0
          const Sym3   e =
            (Sym3{normal(random), normal(random), normal(random), normal(random), normal(random),
                  normal(random)} * size).deviator().plus_isotropic(swell);
          ASSERT_EQ(point.step(e, dt, size * normal(random), size * normal(random), size * normal(random)),
                    Status::ok);
          const Points &now = point.points;
          const double  x   = now.plastic_strain[0] - before.plastic_strain[0];
          ASSERT_GE(x, 0);
          ASSERT_GE(now.plastic_work[0], before.plastic_work[0]);
          ASSERT_GE(now.temperature[0], before.temperature[0]);
          ASSERT_GE(now.damage[0], before.damage[0]);
          ASSERT_LE(now.damage[0], 1);
          ASSERT_TRUE(now.sound_speed[0] > 0);
          const double intact = 1 - now.damage[0];
          const double noise  = 1e-12 * g * size + 1e-14 * std::abs(point.pressure()); // rounding
          if (point.material->shear_modulus() == 0 || intact == 0)
            {
              ASSERT_LE(point.mises(), noise);
            }
          if (intact == 0)
            {
              ASSERT_GE(point.pressure(), -noise);
            }
          std::visit(
            [&](const auto &strength) {
              if constexpr (std::decay_t<decltype(strength)>::yields)
                {
                  const double y = strength.stress(now.plastic_strain[0], x / dt, now.temperature[0]);
                  ASSERT_LE(point.mises(), intact * y * (1 + 1e-9) + noise) << "path " << path;
                  if (x > 0 && intact > 0)
                    {
                      ASSERT_NEAR(point.mises(), intact * y, 1e-9 * y + noise) << "path " << path;
                    }
                }
            },
            law);
        }
    }
}

// The same path seen from a turned frame gives the turned stress.
TEST_P(Conformance, AnswerDoesNotDependOnTheFrame)
{
  const Parameters p = parameters();
  const Mat3       r = Eigen::AngleAxisd(1.1, Vec3(.2, .9, -.4).normalized()).toRotationMatrix();
  OnePoint         here(p), there(p);
  warm(here);
  warm(there);
  std::mt19937                     random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 60; ++i)
    {
      Mat3 l;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          l(a, b) = 4e-4 * normal(random);
      const auto drive = [](OnePoint &point, const Mat3 &m) {
        const Mat3 w = .5 * (m - m.transpose());
        return point.step(Sym3::from_matrix(.5 * (m + m.transpose())), 1e-7, w(0, 1), w(1, 2), w(2, 0));
      };
      ASSERT_EQ(drive(here, l), Status::ok);
      ASSERT_EQ(drive(there, r * l * r.transpose()), Status::ok);
    }
  const Mat3 expected = r * here.stress().matrix() * r.transpose();
  EXPECT_LT((there.stress().matrix() - expected).norm(), 1e-9 * (expected.norm() + 1e6));
}

// A rigid turn moves no state but the direction of the stress.
TEST_P(Conformance, RigidTurnIsFree)
{
  OnePoint point(parameters());
  warm(point);
  for (int i = 0; i < 40; ++i)
    ASSERT_EQ(point.step({-2e-4, 1e-4, 0, 3e-4, -1e-4, 2e-4}, 1e-7), Status::ok);
  point.step({}, 1e9); // lets an overstress due to rate relax,
  point.step({2e-5, -1e-5, 0, -3e-5, 1e-5, -2e-5}, 1e-7); // moves off the yield surface,
  point.step({}, 1e-7); // and lets the pressure meet the energy of the last half step
  const Points before = point.points;
  const double mises = point.mises(), pressure = point.pressure();
  for (int i = 0; i < 50; ++i)
    ASSERT_EQ(point.step({}, 1e-7, .2, -.13, .07), Status::ok);
  EXPECT_NEAR(point.mises(), mises, 1e-11 * (mises + 1e6));
  EXPECT_NEAR(point.pressure(), pressure, 1e-11 * std::abs(pressure));
  EXPECT_EQ(point.points.plastic_strain[0], before.plastic_strain[0]);
  EXPECT_EQ(point.points.plastic_work[0], before.plastic_work[0]);
  EXPECT_EQ(point.points.energy[0], before.energy[0]);
  EXPECT_EQ(point.points.damage[0], before.damage[0]);
}

INSTANTIATE_TEST_SUITE_P(AllLaws, Conformance,
                         testing::Combine(testing::ValuesIn(eos_laws()),
                                          testing::ValuesIn(strength_laws()),
                                          testing::ValuesIn(damage_laws())),
                         label);
} // namespace ogive::materials
