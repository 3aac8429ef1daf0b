// SPDX-License-Identifier: LGPL-2.1-or-later
// The shipped scenes, each held to the bar that its README states.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace ogive::test;

namespace
{
void elastic_bar_holds(const nlohmann::json &s)
{
  // exact: contact 2 L/c_L, restitution 1
  EXPECT_LT(error(s, "contact_time"), .02);
  EXPECT_LT(error(s, "rebound_velocity"), .02);
  EXPECT_LT(check(s, "energy_drift"), .01);
}

void piston_holds(const nlohmann::json &s)
{
  // exact: validation A3, ExactPack ep_piston
  EXPECT_LT(error(s, "plastic_shock_speed"), .01);
  EXPECT_LT(error(s, "plateau_stress"), .01);
  EXPECT_LT(error(s, "precursor_speed"), .02);
  EXPECT_LT(check(s, "energy_drift"), .01);
}
} // namespace

TEST(ElasticBar, Elements) { elastic_bar_holds(run_scene("elastic-bar/scene.prm")); }

TEST(ElasticBar, Particles)
{
  const auto s = run_scene("elastic-bar/scene.prm", {"Bodies/bar/method=sph"});
  elastic_bar_holds(s);
  EXPECT_LT(check(s, "energy_drift"), 1e-10);
}

TEST(ElasticBar, Split)
{
  elastic_bar_holds(run_scene("elastic-bar/split.prm"));
}

TEST(PistonCopper, ParticlesAt20) { piston_holds(run_scene("piston-copper/scene.prm")); }
TEST(PistonCopper, ParticlesAt40) { piston_holds(run_scene("piston-copper/piston-40.prm")); }
TEST(PistonCopper, ElementsAt20) { piston_holds(run_scene("piston-copper/scene.prm", {"Bodies/copper/method=fem"})); }
TEST(PistonCopper, ElementsAt40) { piston_holds(run_scene("piston-copper/piston-40.prm", {"Bodies/copper/method=fem"})); }

TEST(TaylorCopper, Axisymmetric)
{
  const auto s = run_scene("taylor-copper-227/axisymmetric.prm");
  EXPECT_LT(error(s, "final_length"), .01);
  EXPECT_LT(error(s, "foot_radius"), .01);
  EXPECT_LT(check(s, "energy_drift"), .01);
}

TEST(TaylorCopper, AxisymmetricParticles)
{
  // 8 rings across; converges to both bars of .5 % (README). With the plain
  // viscosity the length is 6 % off, with a wall that holds squeezed rings at half a
  // spacing the foot is 12 % off.
  const auto s = run_scene("taylor-copper-227/axisymmetric.prm", {"Bodies/bar/method=sph"});
  EXPECT_LT(error(s, "final_length"), .006);
  EXPECT_LT(error(s, "foot_radius"), .05);
  EXPECT_LT(check(s, "energy_drift"), 1e-11);
  EXPECT_LT(check(s, "momentum_drift"), 1e-13);
}

TEST(TaylorCopper, QuarterOfElements)
{
  const auto s = run_scene("taylor-copper-227/scene.prm");
  EXPECT_LT(error(s, "final_length"), .01);
  EXPECT_LT(error(s, "foot_radius"), .01);
  EXPECT_LT(check(s, "energy_drift"), .01);
  EXPECT_LT(check(s, "hourglass_fraction"), .012);
}

TEST(TaylorCopper, QuarterOfParticles)
{
  const auto s = run_scene("taylor-copper-227/scene.prm", {"Bodies/bar/method=sph"});
  EXPECT_LT(error(s, "final_length"), .04);
  EXPECT_LT(error(s, "foot_radius"), .04);
  EXPECT_LT(check(s, "energy_drift"), 1e-10);
}

TEST(SpinningBlock, SplitKeepsItsMomenta)
{
  const auto s = run_scene("spinning-block/split.prm", {"end time=2 ms"});
  EXPECT_LT(check(s, "momentum_drift"), 1e-12);
  EXPECT_LT(check(s, "energy_drift"), 1e-10);
  // the correction's pair impulses are not central
  EXPECT_LT(check(s, "angular_momentum_drift"), 1e-7);
}

namespace
{
/// The plate with a coarse zone: which side of the ballistic limit
/// (184.5 m/s, test) a shot lies on does not hang on the resolution.
nlohmann::json coarse_plate(const std::string &speed)
{
  return run_scene("plate-weldox-blunt/scene.prm",
             {"Bodies/projectile/velocity=0, 0, -" + speed, "Bodies/plate-zone/spacing=1.5 mm",
              "Bodies/projectile/spacing=2.5 mm", "Bodies/plate-rest/spacing=3 mm"});
}
} // namespace

TEST(PlateWeldoxBlunt, PerforatesAt303)
{
  const auto s = coarse_plate("303.5 m/s");
  EXPECT_EQ(quantity(s, "perforated"), 1);
  EXPECT_GT(quantity(s, "residual_velocity"), 100);
  EXPECT_LT(quantity(s, "residual_velocity"), 199.7 * 1.05);
  EXPECT_LT(check(s, "energy_drift"), .01);
  EXPECT_LT(check(s, "momentum_drift"), 1e-12);
}

TEST(PlateWeldoxBlunt, HoldsAt150)
{
  const auto s = coarse_plate("150 m/s");
  EXPECT_EQ(quantity(s, "perforated"), 0);
  EXPECT_LT(quantity(s, "residual_velocity"), 20);
  EXPECT_LT(check(s, "energy_drift"), .01);
}
