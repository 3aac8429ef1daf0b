// SPDX-License-Identifier: LGPL-2.1-or-later
// Local steps against one step for all, where they pay: docs/local_steps.md.
#include "tests/verification/fem/support.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
/// Copper of validation.md, A1, that hardens linearly.
materials::Parameters yielding_copper()
{
  return copper_linear_hardening();
}

struct End
{
  double        height = 0, foot = 0; ///< m
  double        plastic = 0; ///< plastic work over the initial kinetic energy
  double        error = 0, drift = 0; ///< booked error; what is left of the books; over the initial kinetic energy
  std::uint64_t updates = 0;
  std::size_t   most    = 0; ///< classes
};

template <int dim>
End strike(Solver<dim> solver, int axis, double end)
{
  Driver<dim>  driver{solver};
  const auto   b0    = solver.balance();
  const double start = closed(b0);
  End          out;
  while (driver.time < end)
  {
    EXPECT_TRUE(driver.once(end).ok);
    if (const auto plan = solver.local_plan(); plan.on)
      out.most = std::max(out.most, plan.elements.size());
    out.error = std::max(out.error, std::abs(solver.parts_error()) / b0.kinetic);
  }
  const auto b      = solver.balance();
  const auto sample = solver.sample(0);
  const auto height = std::minmax_element(sample.x[axis].begin(), sample.x[axis].end());
  out.height  = *height.second - *height.first;
  out.foot    = *std::max_element(sample.x[0].begin(), sample.x[0].end());
  out.plastic = b.plastic_work / b0.kinetic;
  out.drift   = std::abs(closed(b) - solver.parts_error() - start) / b0.kinetic;
  out.updates = solver.updates();
  return out;
}

input::Scene wall_scene(input::Dimension dimension, const Vec3 &normal, const std::string &local)
{
  input::Scene scene;
  scene.dimension = dimension;
  scene.walls.push_back({"wall", Vec3::Zero(), normal, Vec3::Zero(), 0});
  scene.fem.local_steps = local;
  return scene;
}
} // namespace

// The foot of a Taylor bar, as rings, is squeezed to a seventh: the classes follow.
TEST(LocalSteps, TaylorBarAsItIsWithOneStepForAll)
{
  const auto run = [](const std::string &local) {
    const auto scene = wall_scene(input::Dimension::axisymmetric, Vec3::UnitY(), local);
    return strike(solver_for<2>(taylor_bar(input::Dimension::axisymmetric, .4e-3), scene, yielding_copper()), 1, 80e-6);
  };
  const End alike = run("none"), local = run("auto");
  EXPECT_NEAR(local.height / alike.height, 1, .001);
  EXPECT_NEAR(local.foot / alike.foot, 1, .002);
  EXPECT_NEAR(local.plastic / alike.plastic, 1, .002);
  EXPECT_LE(local.error, .005); // the limit of the scenes
  EXPECT_LE(local.drift, 1e-12);
  EXPECT_GE(local.most, 3u);
  EXPECT_LT(local.updates, .5 * static_cast<double>(alike.updates));
}

// meshes/sliver.msh, the scene uneven-cube: one thin element among 512.
TEST(LocalSteps, OneSliverHoldsItselfBackAlone)
{
  const auto run = [](const std::string &local) {
    auto        scene = wall_scene(input::Dimension::three_d, Vec3::UnitZ(), local);
    input::Body body  = box(Vec3::Zero(), Vec3::Zero(), 1.25e-3, {0, 0, -150});
    body.shape.kind   = input::ShapeKind::mesh;
    body.shape.mesh_file = std::string(OGIVE_SOURCE_DIR) + "/meshes/sliver.msh";
    return strike(solver_for<3>(body, scene, yielding_copper()), 2, 20e-6);
  };
  const End alike = run("none"), local = run("auto");
  EXPECT_NEAR(local.height / alike.height, 1, .001);
  EXPECT_NEAR(local.plastic / alike.plastic, 1, .005);
  EXPECT_LE(local.error, .005);
  EXPECT_LE(local.drift, 1e-12);
  EXPECT_GE(local.most, 3u);
  EXPECT_LT(local.updates, .5 * static_cast<double>(alike.updates));
}
