// SPDX-License-Identifier: LGPL-2.1-or-later
// Whole steps: what closes to rounding, in every configuration.
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 2.1e-3;

/// A jittered block that deforms and yields; velocities of some 100 m/s.
template <int dim>
BodyParticles<dim> block(double jitter = .15, const std::vector<input::SymmetryPlane> &planes = {})
{
  const Vec3 upper = spacing * (dim == 1 ? Vec3(40, 0, 0) : dim == 2 ? Vec3(14, 9, 0) : Vec3(8, 7, 6));
  auto       p     = box<dim>(Vec3::Zero(), upper, spacing, material(8930, 130e9, 48e9, 3e8), jitter, 5, planes);
  for (std::size_t i = 0; i < p.x.size(); ++i)
    for (int a = 0; a < dim; ++a)
      p.v[i][a] = 130 * std::cos(310 * p.x[i][(a + 1) % dim] + a) - 4000 * (a + 1) * p.x[i][a];
  return p;
}

struct Choice
{
  const char *form, *kernel, *correction;
};

template <int dim>
void closes(const Choice &c, const std::vector<input::SymmetryPlane> &planes = {})
{
  SCOPED_TRACE(std::string(c.form) + " " + c.kernel + " " + c.correction + " " + std::to_string(dim));
  Parameters p;
  p.options.form       = c.form;
  p.options.kernel     = c.kernel;
  p.options.correction = c.correction;
  p.symmetry           = planes;
  Solver<dim>   solver(p, {block<dim>(planes.empty() ? .15 : 0., planes)});
  Runner<dim>   run{solver};
  const Balance start  = solver.balance();
  const double  energy = start.kinetic + start.internal();
  const double  speed  = std::sqrt(2 * start.kinetic * start.mass);
  for (int k = 0; k < 60; ++k)
  {
    const Balance before = solver.balance();
    ASSERT_TRUE(run.step().ok);
    const Balance now = solver.balance();
    // Energy: 1e-12 a step; momentum: rounding of the sum.
    EXPECT_NEAR(now.kinetic + now.internal(), before.kinetic + before.internal(), 1e-12 * energy);
    EXPECT_GE(now.hourglass_sph, before.hourglass_sph - 1e-15 * energy);
    if (planes.empty())
    {
      EXPECT_LT((now.momentum - before.momentum).norm(), 1e-13 * speed);
    }
  }
  const Balance end = solver.balance();
  EXPECT_EQ(end.mass, start.mass);
  // It must have been a real ride.
  EXPECT_GT(end.plastic_work, 1e-3 * energy);
  EXPECT_GT(end.viscosity_heat, 1e-5 * energy);
  EXPECT_LT(end.kinetic, .98 * start.kinetic);
}

TEST(Conservation, EnergyAndMomentumClose)
{
  for (const Choice &c : {Choice{"corrected", "cubic", "pairwise"}, Choice{"corrected", "wendland-c2", "none"},
                          Choice{"standard", "cubic", "none"}, Choice{"standard", "wendland-c2", "pairwise"}})
  {
    closes<1>(c);
    closes<2>(c);
    closes<3>(c);
  }
}

TEST(Conservation, EnergyClosesWithSymmetryPlanes)
{
  for (const Choice &c : {Choice{"corrected", "cubic", "pairwise"}, Choice{"standard", "cubic", "none"}})
  {
    closes<2>(c, {{0}});
    closes<3>(c, {{0}, {2}});
  }
}

/// Internal energy and shape must not see the frame of the observer.
TEST(Conservation, GalileanBoostChangesNothing)
{
  const auto run = [](double boost) {
    auto p = block<2>();
    for (auto &v : p.v)
    {
      v[0] += .8 * boost;
      v[1] -= .6 * boost;
    }
    Solver<2> solver({}, {p});
    Runner<2> runner{solver};
    for (int k = 0; k < 80; ++k)
      EXPECT_TRUE(runner.step(8e-8).ok);
    return solver.balance().internal();
  };
  const double still = run(0), moving = run(1000);
  EXPECT_GT(still, 0);
  EXPECT_NEAR(moving, still, 1e-10 * still);
}

/// A mirrored quarter moves as the whole does.
TEST(Conservation, QuarterEqualsWhole)
{
  const auto particles = [](const std::vector<input::SymmetryPlane> &planes) {
    const double l = 12 * spacing, w = 8 * spacing;
    auto         p = box<2>(Vec3(-l, -w, 0), Vec3(l, w, 0), spacing, copper(), 0, 1, planes);
    for (std::size_t i = 0; i < p.x.size(); ++i)
      p.v[i] = {-3000 * p.x[i][0], 2000 * p.x[i][1] * (1 + 1e4 * p.x[i][0] * p.x[i][0])};
    return p;
  };
  for (const char *configuration : {"current", "reference"})
  {
    SCOPED_TRACE(configuration);
    Parameters quarter, all;
    quarter.options.configuration = all.options.configuration = configuration;
    quarter.symmetry                                          = {{0}, {1}};
    Solver<2> part(quarter, {particles(quarter.symmetry)}), whole(all, {particles({})});
    Runner<2> run_part{part}, run_whole{whole};
    for (int k = 0; k < 100; ++k)
    {
      ASSERT_TRUE(run_part.step(1e-7).ok);
      ASSERT_TRUE(run_whole.step(1e-7).ok);
    }
    const Balance p = part.balance(), w = whole.balance();
    EXPECT_NEAR(4 * p.kinetic, w.kinetic, 1e-10 * w.kinetic);
    EXPECT_NEAR(4 * p.elastic, w.elastic, 1e-9 * w.elastic);
    EXPECT_NEAR(4 * p.viscosity_heat, w.viscosity_heat, 1e-9 * w.viscosity_heat);
    EXPECT_NEAR(4 * p.hourglass_sph, w.hourglass_sph, 1e-9 * w.elastic);
  }
}

/// A fragment without neighbours flies on without acceleration.
TEST(Conservation, LoneParticleIsFree)
{
  BodyParticles<3> p;
  p.material = copper();
  p.spacing  = spacing;
  p.x        = {{0, 0, 0}, {10 * spacing, 0, 0}};
  p.v        = {{17, -23, 5}, {-11, 3, 300}};
  p.mass     = {2e-6, 3e-6};
  Solver<3> solver({}, {p});
  Runner<3> run{solver};
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(run.step(1e-7).ok);
  const Sample s = solver.sample(0);
  for (std::size_t i = 0; i < 2; ++i)
    for (int a = 0; a < 3; ++a)
      EXPECT_EQ(s.v[a][i], p.v[s.id[i]][a]);
}

/// The saw-tooth that gradients cannot see loses 90 % of its amplitude in 50 steps.
TEST(Hourglass, SawToothDecays)
{
  auto p = box<2>(Vec3::Zero(), Vec3(20 * spacing, 20 * spacing, 0), spacing, copper());
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    const int column = static_cast<int>(p.x[i][0] / spacing);
    p.v[i]           = {column % 2 ? 1. : -1., 0};
  }
  Parameters none;
  none.options.alpha = none.options.beta = 0;
  Solver<2> solver(none, {p});
  Runner<2> run{solver};
  const double before = solver.balance().kinetic;
  for (int k = 0; k < 50; ++k)
    ASSERT_TRUE(run.step().ok);
  const Balance end = solver.balance();
  EXPECT_LT(std::sqrt(end.kinetic / before), .1);
  EXPECT_GT(end.hourglass_sph, .9 * before);
  EXPECT_EQ(end.viscosity_heat, 0);
}

TEST(Failure, NamesTheParticle)
{
  auto p     = block<3>();
  p.v[37][1] = 1e9;
  Parameters inviscid; // viscosity would throw the neighbours too
  inviscid.options.alpha = inviscid.options.beta = inviscid.options.hourglass = 0;
  Solver<3>        solver(inviscid, {p});
  Runner<3>        run{solver};
  const StepStatus status = run.step(1e-6);
  EXPECT_FALSE(status.ok);
  EXPECT_EQ(status.culprit.id, 37);
  EXPECT_EQ(status.culprit.body, 0);
  EXPECT_STREQ(status.culprit.entity, "particle");
  EXPECT_GT(std::string(status.culprit.why).size(), 0u);
}

TEST(Failure, NanIsCaught)
{
  auto      p = block<2>();
  Solver<2> solver({}, {p});
  Runner<2> run{solver};
  ASSERT_TRUE(run.step(1e-8).ok);
  solver.surface().force[0][3] = std::nan("");
  EXPECT_FALSE(run.step(1e-8).ok);
}

/// Particles on a line in a plane have no gradient across it.
TEST(Fallbacks, AreCounted)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(6, 6, 0), spacing, copper());
  EXPECT_EQ(Solver<2>(Parameters(), {p}).balance().gradient_fallbacks, 0);
  for (int k = 0; k < 3; ++k)
  {
    p.x.push_back({(20 + k) * spacing, 0.});
    p.v.push_back({0., 0.});
    p.mass.push_back(p.mass[0]);
  }
  EXPECT_EQ(Solver<2>(Parameters(), {p}).balance().gradient_fallbacks, 3);
}
} // namespace
