// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/laws.h"
#include "one_point.h"

#include <gtest/gtest.h>

namespace ogive::materials
{
using test::OnePoint;

namespace
{
MieGrueneisen shock_copper()
{
  return {8930, 3940, 1.489, 2};
}

/// Density after moving along the isentrope from (rho, e) by a relative d_rho,
/// de = p/rho^2 drho, in classical Runge-Kutta steps.
template <class Eos>
double isentrope_pressure(const Eos &eos, double rho, double e, double target)
{
  const int    n = 16;
  const double h = (target - rho) / n;
  const auto   f = [&](double r, double u) { return eos.at(r, u).pressure / (r * r); };
  for (int i = 0; i < n; ++i)
    {
      const double k1 = f(rho, e), k2 = f(rho + h / 2, e + h / 2 * k1),
                   k3 = f(rho + h / 2, e + h / 2 * k2), k4 = f(rho + h, e + h * k3);
      e += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      rho += h;
    }
  return eos.at(rho, e).pressure;
}
} // namespace

// c^2 = (dp/drho)_s, by a fourth-order central difference along the isentrope.
TEST(Eos, SoundSpeedIsTheSlopeOfTheIsentrope)
{
  for (const std::string &name : eos_laws())
    {
      const Parameters p   = test::parameters(name, "fluid");
      const AnyEos     any = Laws<AnyEos>::build(name, p, "EOS/law");
      for (const double ratio : {.8, .97, 1.02, 1.15, 1.4})
        for (const double energy : {2e5, 1.5e6})
          {
            const double rho = ratio * p.density, d = 1e-3 * rho;
            const double slope = std::visit(
              [&](const auto &eos) {
                const auto at = [&](double x) { return isentrope_pressure(eos, rho, energy, rho + x); };
                return (8 * (at(d) - at(-d)) - (at(2 * d) - at(-2 * d))) / (12 * d);
              },
              any);
            const double c2 =
              std::visit([&](const auto &eos) { return eos.at(rho, energy).sound_speed_squared; }, any);
            EXPECT_NEAR(c2, slope, 1e-8 * slope) << name << " at rho/rho0 " << ratio << ", e " << energy;
          }
    }
}

// Symmetric copper impact at 500 m/s: U_s = c0 + s u_p = 4312.25 m/s and
// p = rho0 U_s u_p = 9.6271 GPa (exact), here from p(rho, e) alone.
TEST(Eos, MieGrueneisenReproducesItsHugoniot)
{
  const MieGrueneisen eos = shock_copper();
  const double        u = 250, rho0 = eos.rho0;
  double              lo = 4000, hi = 5000;
  for (int i = 0; i < 200; ++i)
    {
      const double us = .5 * (lo + hi), p = rho0 * us * u, rho = rho0 * us / (us - u);
      const double e = .5 * p * (1 / rho0 - 1 / rho);
      (eos.at(rho, e).pressure > p ? lo : hi) = us;
    }
  EXPECT_NEAR(lo, 4312.25, 1e-8 * lo);
  EXPECT_NEAR(rho0 * lo * u, 9.6271e9, .5e5);
}

// Precursor of the elastic-plastic piston, copper and aluminium (exact values
// of the verification page): rho = rho0 exp(Y/2G), jump in total energy.
TEST(Eos, PrecursorOfTheElasticPlasticPiston)
{
  struct Case
  {
    double rho0, c0, s, g, y, rho, p, digit;
  };
  for (const Case &c : {Case{8930, 3940, 1.49, 45e9, 90e6, 8938.934, .13903e9, .5e4},
                        Case{2790, 5330, 1.34, 28.6e9, .26e9, 2802.7107, .3646613e9, .5e2}})
    {
      const MieGrueneisen eos{c.rho0, c.c0, c.s, 2};
      const double        rho = c.rho0 * std::exp(c.y / (2 * c.g));
      EXPECT_NEAR(rho, c.rho, 6e-8 * rho);
      double p = 0;
      for (int i = 0; i < 100; ++i)
        p = eos.at(rho, .5 * (p + 2. / 3 * c.y) * (1 / c.rho0 - 1 / rho)).pressure;
      EXPECT_NEAR(p, c.p, c.digit);
    }
}

TEST(Eos, TensionBranchIsTheIsentropeThroughTheUndeformedState)
{
  const MieGrueneisen eos = shock_copper();
  for (const double ratio : {.999, .9, .6})
    {
      const double rho = ratio * eos.rho0, eta = 1 - 1 / ratio;
      const double p = isentrope_pressure(eos, eos.rho0, 0., rho);
      EXPECT_NEAR(p, eos.rho0 * eos.c0 * eos.c0 * eta, 1e-5 * std::abs(p));
      const auto r = eos.at(rho, .5 * eos.c0 * eos.c0 * eta * eta);
      EXPECT_NEAR(r.sound_speed_squared, std::pow(eos.c0 / ratio, 2), 1e-12 * r.sound_speed_squared);
    }
  const double below = eos.at(eos.rho0 * (1 - 1e-9), 0.).sound_speed_squared,
               above = eos.at(eos.rho0 * (1 + 1e-9), 0.).sound_speed_squared;
  EXPECT_NEAR(below, above, 1e-7 * above);
}

TEST(Eos, OutsideTheHugoniotThereIsNoSoundSpeed)
{
  const MieGrueneisen eos = shock_copper();
  const double        limit = eos.rho0 / (1 - 1 / eos.s); // 1 - s eta = 0
  // Hugoniot states have one up to eta = 2/(2 + Gamma), the strong-shock limit.
  const double eta = .49, p = eos.rho0 * eos.c0 * eos.c0 * eta / std::pow(1 - eos.s * eta, 2);
  EXPECT_GT(eos.at(eos.rho0 / (1 - eta), .5 * p * eta / eos.rho0).sound_speed_squared, 0);
  EXPECT_LT(eos.at(1.01 * limit, 1e6).sound_speed_squared, 0);
}

TEST(Eos, TensionIsCutAndCompressionIsNot)
{
  const double rest = 1.5e7;
  const auto   cut  = carry_tension<double>({-3e9, 2e7}, 1e9, 1., rest);
  EXPECT_DOUBLE_EQ(cut.pressure, -1e9);
  EXPECT_DOUBLE_EQ(cut.sound_speed_squared, rest);
  const auto soft = carry_tension<double>({-3e9, 1e7}, 1e9, .25, rest);
  EXPECT_DOUBLE_EQ(soft.pressure, -.25e9);
  EXPECT_DOUBLE_EQ(soft.sound_speed_squared, 1e7);
  const auto pushed = carry_tension<double>({3e9, 2e7}, 1e9, 0., rest);
  EXPECT_DOUBLE_EQ(pushed.pressure, 3e9);
  EXPECT_DOUBLE_EQ(pushed.sound_speed_squared, 2e7);
}

TEST(Eos, TensionCutoffInAMaterial)
{
  Parameters p         = test::parameters("mie-grueneisen", "fluid");
  p.eos.tension_cutoff = .3e9;
  OnePoint point(p);
  for (int i = 0; i < 40; ++i)
    ASSERT_EQ(point.step({2e-4, 3e-4, 0, 0, 0, 0}, 3e-9), Status::ok);
  EXPECT_NEAR(point.pressure(), -.3e9, 1e-6 * .3e9);
  EXPECT_LE(point.points.sound_speed[0], 3940.);
}

// Isentropic compression of a gas through the material: p ~ rho^gamma.
TEST(Eos, IdealGasFollowsItsIsentrope)
{
  Parameters p = test::parameters("ideal-gas", "fluid");
  p.density    = 1.3;
  p.eos.gamma  = 1.4;
  double error[2];
  for (const int refine : {0, 1})
    {
      OnePoint point(p);
      point.points.energy[0] = 2e5;
      const double p0        = .4 * 1.3 * 2e5;
      point.step({}, 1e-6); // picks up the pressure
      EXPECT_NEAR(point.pressure(), p0, 1e-12 * p0);
      const int n = 200 << refine;
      for (int i = 0; i < n; ++i)
        ASSERT_EQ(point.step({-.3 / n, 0, -.1 / n, 0, 0, 0}, 1e-6), Status::ok);
      error[refine] = std::abs(point.pressure() / (p0 * std::exp(1.4 * .4)) - 1);
    }
  EXPECT_LT(error[0], 1e-5);
  EXPECT_NEAR(error[0] / error[1], 4, .2); // second order in the step
}
} // namespace ogive::materials
