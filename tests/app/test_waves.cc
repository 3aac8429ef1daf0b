// SPDX-License-Identifier: LGPL-2.1-or-later
// The viscosity laboratory: shocks, waves and flows with exact answers, held by
// plain viscosity and by the default, which is corrected and split.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace ogive::test;

namespace
{
nlohmann::json run(const std::string &name, const std::vector<std::string> &settings)
{
  const nlohmann::json s = run_scene(name, settings);
  // numerics.md: the books close to rounding, in whatever scene
  EXPECT_LT(std::abs(s.at("checks").at("energy_drift").get<double>()), 1e-10);
  return s;
}

nlohmann::json plain(const std::string &name, std::vector<std::string> settings = {})
{
  settings.push_back("SPH/correction=none");
  return run(name, settings);
}

nlohmann::json corrected(const std::string &name, const std::vector<std::string> &settings = {})
{
  return run(name, settings);
}

const char *const slab_speeds[] = {"5", "25", "250"}; // m/s, half of what they close at
std::string       at(const char *speed) { return std::string("Bodies/slabs/field speed=") + speed + " m/s"; }
} // namespace

// the bar of numerics.md section 3 for 400 particles, 10, 50 and 500 m/s
TEST(SymmetricImpact, PlainViscosityDoesNotOvershoot)
{
  for (const char *speed : slab_speeds)
    EXPECT_LT(quantity(plain("symmetric-impact/scene.prm", {at(speed)}), "overshoot"), .01) << speed;
}

// the bars of validation E1: no more overshoot than plain viscosity is allowed,
// and a profile closer by a quarter
TEST(SymmetricImpact, TheDefaultCapturesIt)
{
  for (const char *speed : slab_speeds)
  {
    const auto s = corrected("symmetric-impact/scene.prm", {at(speed)});
    EXPECT_LT(quantity(s, "overshoot"), .01) << speed;
    EXPECT_LT(quantity(s, "l1_error"), .75 * quantity(plain("symmetric-impact/scene.prm", {at(speed)}), "l1_error"));
  }
}

// the same bars; a prism of 60 mm is still at its start
TEST(SymmetricImpact, TheDefaultCapturesItInTwoAndThreeDimensions)
{
  const std::vector<std::string> longer{"Bodies/slabs/lower=-60, 0, 0 mm", "Bodies/slabs/upper=60, 3, 3 mm",
                                        "end time=8 us"};
  const auto holds = [](const nlohmann::json &s, const nlohmann::json &p) {
    EXPECT_LT(quantity(s, "overshoot"), quantity(p, "overshoot") + .02);
    EXPECT_LT(quantity(s, "l1_error"), .75 * quantity(p, "l1_error"));
  };
  holds(corrected("symmetric-impact/plane.prm"), plain("symmetric-impact/plane.prm"));
  holds(corrected("symmetric-impact/solid.prm", longer), plain("symmetric-impact/solid.prm", longer));
}

// A shock as wide as some spacings: first order, of which .75 leaves room.
TEST(SymmetricImpact, ComesCloserWithResolution)
{
  const auto coarse = plain("symmetric-impact/scene.prm", {"Bodies/slabs/spacing=1 mm"});
  const auto fine   = plain("symmetric-impact/scene.prm", {"Bodies/slabs/spacing=0.25 mm"});
  for (const char *error : {"l1_error", "l1_velocity_error"})
    EXPECT_LT(quantity(fine, error), .75 * .75 * quantity(coarse, error)) << error;
}

TEST(SymmetricImpact, IsTheSameInTwoAndThreeDimensions)
{
  EXPECT_LT(quantity(plain("symmetric-impact/plane.prm"), "overshoot"), .02);
  EXPECT_LT(quantity(plain("symmetric-impact/solid.prm"), "overshoot"), .05);
}

TEST(Sod, PlainViscosityComesCloseToTheExactTube)
{
  const auto coarse = plain("sod/scene.prm", {"Bodies/gas/spacing=5 mm"}), fine = plain("sod/scene.prm");
  EXPECT_LT(error(fine, "shock_speed"), .005);
  EXPECT_LT(error(fine, "velocity"), .005);
  EXPECT_LT(error(fine, "pressure"), .01);
  for (const char *error : {"l1_error", "l1_density_error", "l1_velocity_error"})
    EXPECT_LT(quantity(fine, error), .75 * quantity(coarse, error)) << error;
}

TEST(Noh, TheShockRunsAtAThird)
{
  const auto planar = plain("noh/scene.prm");
  EXPECT_LT(error(planar, "shock_speed"), .01);
  EXPECT_LT(quantity(planar, "density_deficit"), .4); // wall heating, the same at each resolution
  EXPECT_LT(error(plain("noh/plane.prm"), "shock_speed"), .1);
}

// the bars of plain viscosity, with a quarter of its wall heating
TEST(Noh, TheDefaultHeatsTheMiddleLess)
{
  const auto planar = corrected("noh/scene.prm");
  EXPECT_LT(error(planar, "shock_speed"), .01);
  EXPECT_LT(std::abs(quantity(planar, "density_deficit")), .1);
  EXPECT_LT(error(corrected("noh/plane.prm"), "shock_speed"), .1);
}

TEST(Sod, TheDefaultComesAsClose)
{
  const auto s = corrected("sod/scene.prm");
  EXPECT_LT(error(s, "shock_speed"), .005);
  EXPECT_LT(error(s, "velocity"), .005);
}

// Linear viscosity that acts on approach damps as nu = alpha c h/4 (validation
// E2): amplitude exp(-nu k^2 t/2), so exp(-pi^2 alpha h/(2 lambda)) a wavelength.
TEST(SmoothWave, PlainViscosityDampsAsItMust)
{
  const double rate = std::numbers::pi * std::numbers::pi * 1.3 / (2 * 32);
  EXPECT_NEAR(quantity(plain("smooth-wave/scene.prm"), "amplitude_loss"), 1 - std::exp(-rate), .02 * rate);
  EXPECT_NEAR(quantity(plain("smooth-wave/scene.prm", {"SPH/alpha=0.5"}), "amplitude_loss"),
              1 - std::exp(-rate / 2), .02 * rate);
}

TEST(SmoothWave, TheCorrectionKeepsIt)
{
  EXPECT_LT(quantity(corrected("smooth-wave/scene.prm"), "amplitude_loss"), .01);
}

// the same law over ten periods of 2 L/c: the energy goes with exp(-pi^2 h/(2 L)) each
TEST(FreeBar, PlainViscosityDampsAsItMust)
{
  const double rate = 10 * std::numbers::pi * std::numbers::pi * 1.3 / (2 * 100);
  const auto   s    = plain("free-bar/scene.prm", {"end time=0.345689 ms"});
  EXPECT_NEAR(quantity(s, "fundamental_energy"), std::exp(-rate), .02 * rate);
  EXPECT_NEAR(quantity(s, "energy_kept"), quantity(s, "fundamental_energy"), .01);
}

// the bar of numerics.md section 3: more than 90 % after 1000 periods, no noise
TEST(FreeBar, TheCorrectionKeepsItForAThousandPeriods)
{
  const auto s = corrected("free-bar/scene.prm");
  EXPECT_GT(quantity(s, "fundamental_energy"), .9);
  EXPECT_LT(quantity(s, "oscillation_noise"), 1e-6);
}

// The gradient is exact for a linear velocity: without viscosity nothing happens.
TEST(ShearFlow, WithoutViscosityItGoesOn)
{
  const auto s = plain("shear-flow/scene.prm", {"SPH/alpha=0", "SPH/beta=0"});
  EXPECT_NEAR(quantity(s, "kinetic_energy_kept"), 1, 1e-10);
}

TEST(ShearFlow, TheCorrectionHeatsATenthOfPlainViscosity)
{
  const auto with = corrected("shear-flow/scene.prm"), without = plain("shear-flow/scene.prm");
  EXPECT_LT(quantity(with, "viscosity_heat_share"), .1 * quantity(without, "viscosity_heat_share"));
  const auto yields = corrected("shear-flow/plastic.prm"), heats = plain("shear-flow/plastic.prm");
  EXPECT_LT(quantity(yields, "viscosity_to_plastic_work"), .1 * quantity(heats, "viscosity_to_plastic_work"));
}

TEST(SawTooth, IsDampedWithAndWithoutCorrection)
{
  for (const char *name : {"saw-tooth/scene.prm", "saw-tooth/plane.prm"})
  {
    EXPECT_LT(quantity(plain(name), "kinetic_energy_kept"), .002) << name;
    EXPECT_LT(quantity(corrected(name), "kinetic_energy_kept"), .002) << name;
  }
  EXPECT_LT(quantity(plain("saw-tooth/scene.prm"), "oscillation_noise"), 1e-5);
  EXPECT_LT(quantity(corrected("saw-tooth/scene.prm"), "oscillation_noise"), 1e-5);
}

// What an observer cannot do is wrong input, and `check` says so already.
TEST(Waves, AnObserverWithoutItsSolutionIsRefused)
{
  const Outcome shear = ogive::test::ogive(
      {"check", scene("symmetric-impact/scene.prm"), "--set", "Bodies/slabs/velocity field=standing-wave"});
  EXPECT_EQ(shear.status, 2);
  EXPECT_NE(shear.err.find("symmetric-impact/scene.prm:"), std::string::npos) << shear.err;
  EXPECT_NE(shear.err.find("no exact solution is known"), std::string::npos) << shear.err;
  const Outcome solid = ogive::test::ogive(
      {"check", scene("symmetric-impact/scene.prm"), "--set", "Bodies/slabs/material=aluminium-elastic"});
  EXPECT_EQ(solid.status, 2);
}

TEST(Waves, APressureThatNoHeatMakesIsRefused)
{
  const Outcome steel =
      ogive::test::ogive({"check", scene("saw-tooth/scene.prm"), "--set", "Bodies/bar/pressure=1 MPa"});
  EXPECT_EQ(steel.status, 2);
  EXPECT_NE(steel.err.find("whatever the heat"), std::string::npos) << steel.err;
}
