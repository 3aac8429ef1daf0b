// SPDX-License-Identifier: LGPL-2.1-or-later
// Bulk viscosities of elements, their acceleration correction, and masses scaled on request.
#include "core/io/memory_archive.h"
#include "fem/viscosity/viscosities.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
struct Way
{
  std::string viscosity, correction, split;
};

/// Every registered viscosity, plain, corrected and split.
std::vector<Way> ways()
{
  std::vector<Way> all;
  const auto       add = [&](const char *name) {
    all.push_back({name, "none", "none"});
    all.push_back({name, "pairwise", "none"});
    all.push_back({name, "pairwise", "compression"});
  };
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (add(std::variant_alternative_t<k, AnyBulkViscosity>::name), ...);
  }(std::make_index_sequence<std::variant_size_v<AnyBulkViscosity>>());
  return all;
}

Parameters parameters(const Way &way)
{
  Parameters p;
  p.options.bulk_viscosity = way.viscosity;
  p.options.correction     = way.correction;
  p.options.shock_split    = way.split;
  return p;
}

std::string describe(const Way &w) { return w.viscosity + ", " + w.correction + ", " + w.split; }
} // namespace

// The damping must bound the slope of the pressure, or steps become too long; the
// slope is taken by differences. Nothing presses against an expansion.
TEST(BulkViscosity, DampingIsTheSlopeAndNothingResistsExpansion)
{
  for (const Way &way : ways())
  {
    const AnyBulkViscosity law = bulk_viscosity(parameters(way).options);
    EXPECT_EQ(evaluate(law, 8930., 4000., 1e-3, 0.).pressure, 0);
    for (double rate = 1; rate < 1e8; rate *= 7)
    {
      const double h     = 1e-4 * rate;
      const auto   value = evaluate(law, 8930., 4000., 1e-3, rate);
      const double slope =
        (evaluate(law, 8930., 4000., 1e-3, rate + h).pressure - evaluate(law, 8930., 4000., 1e-3, rate - h).pressure) /
        (2 * h);
      ASSERT_GE(value.pressure, 0);
      ASSERT_NEAR(value.damping, slope, 1e-6 * slope) << describe(way);
      ASSERT_NEAR(damping_of(law, 8930., 4000., 1e-3, value.pressure), value.damping, 1e-9 * value.damping);
    }
  }
}

// rho c2 c du in weak and rho c1 du^2 in strong shocks, whichever formula. Between
// them Kuropatenko's lies below the sum: with k = c1/2 and k du = 3/4 c2 c it is
// (3/4 + 5/4)/(6/4 + 1) = .8 of it, at du = .75 x .06 x 4000/.75 = 240 m/s.
TEST(BulkViscosity, BothFormulasMeetInWeakAndStrongShocks)
{
  const NeumannRichtmyer sum;
  const Kuropatenko      root;
  const auto ratio = [&](double rate) {
    return root(8930., 4000., 1e-3, rate).pressure / sum(8930., 4000., 1e-3, rate).pressure;
  };
  EXPECT_NEAR(ratio(1), 1, 1e-4);
  EXPECT_NEAR(ratio(1e10), 1, 1e-4);
  EXPECT_NEAR(ratio(2.4e5), .8, 1e-12);
}

namespace
{
template <int dim>
void expect_balance(const Way &way, bool axisymmetric = false)
{
  auto          solver = solver_of<dim>(wild_block<dim>(make(copper()), axisymmetric), parameters(way));
  Driver<dim>   driver{*solver};
  const Balance b0       = solver->balance();
  double        previous = closed(b0);
  for (int k = 0; k < 100; ++k)
  {
    ASSERT_TRUE(driver.once().ok) << describe(way);
    const double now = closed(solver->balance());
    ASSERT_NEAR(now / previous, 1, 1e-12) << describe(way) << ", step " << k;
    previous = now;
  }
  const Balance b = solver->balance();
  for (int i = axisymmetric ? 1 : 0; i < dim; ++i)
    EXPECT_NEAR((b.momentum[i] - b0.momentum[i]) / (b0.mass * 40), 0, 1e-13) << describe(way);
  if (way.viscosity == "none")
    EXPECT_EQ(b.bulk_viscosity_heat, 0);
  else
    EXPECT_GT(b.bulk_viscosity_heat, 0) << describe(way); // measured: no law says so of the corrected one
}
} // namespace

TEST(BulkViscosity, EveryWayKeepsMomentumAndEnergyAndHeats)
{
  for (const Way &way : ways())
  {
    expect_balance<1>(way);
    expect_balance<2>(way);
    expect_balance<2>(way, true);
    expect_balance<3>(way);
  }
}

// The same block at rest and at 1 km/s heats alike; 1e-10 is what rounding of
// velocities a hundred times larger leaves.
TEST(BulkViscosity, EveryWayIsGalileanInvariant)
{
  for (const Way &way : ways())
  {
    double heat[2];
    for (const int boosted : {0, 1})
    {
      auto mesh = wild_block<3>(make(copper()));
      for (double &v : mesh.v[1])
        v += 1000. * boosted;
      auto      solver = solver_of<3>(std::move(mesh), parameters(way));
      Driver<3> driver{*solver};
      driver.fixed_dt = 2e-8;
      for (int k = 0; k < 100; ++k)
        ASSERT_TRUE(driver.once().ok);
      heat[boosted] = solver->balance().internal();
    }
    EXPECT_NEAR(heat[1] / heat[0], 1, 1e-10) << describe(way);
  }
}

namespace
{
/// Share of its energy that a free bar of 100 elements keeps after 20 periods of
/// its fundamental, v = V cos(pi x/l).
double kept(const Way &way, double amplitude)
{
  Parameters p             = parameters(way);
  p.options.bulk_quadratic = 0;
  p.options.step_factor    = .5;
  input::Scene scene;
  scene.dimension   = input::Dimension::uniaxial;
  const auto metal  = make(copper());
  auto       mesh   = make_mesh<1>(box({0, 0, 0}, {.1, .1, .1}, 1e-3), scene, 0, metal);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    mesh.v[0][a] = amplitude * std::cos(std::numbers::pi * mesh.x[0][a] / .1);
  auto         solver = solver_of<1>(std::move(mesh), p);
  Driver<1>    driver{*solver};
  const double before = closed(solver->balance());
  EXPECT_TRUE(driver.until(20 * 2 * .1 / metal->sound_speed()).ok);
  return 1 - solver->balance().bulk_viscosity_heat / before;
}
} // namespace

// Plain linear viscosity presses where the bar is compressed, half of the time:
// energy falls with exp(-c2 c h k^2 t/2), k = pi/l, t = 20 x 2 l/c, so by
// exp(-20 pi^2 c2 h/l) = .8883. The correction leaves (1 - cos k h)/3 = 1.6e-4 of
// smooth waves; the kinks at D = 0 have shorter ones.
TEST(BulkViscosity, AWaveLosesWhatTheFormulaSaysAndCorrectedNearlyNothing)
{
  const double exact = std::exp(-20 * std::numbers::pi * std::numbers::pi * .06 / 100);
  EXPECT_NEAR(kept({"neumann-richtmyer", "none", "none"}, 1e-3), exact, 2e-3);
  EXPECT_NEAR(kept({"kuropatenko", "none", "none"}, 1e-3), exact, 2e-3);
  EXPECT_GT(kept({"neumann-richtmyer", "pairwise", "none"}, 1e-3), .998);
  EXPECT_EQ(kept({"none", "none", "none"}, 1e-3), 1);
}

// Damping dominates the step here. With a mean of the neighbours taken out, no
// motion is damped more than before: the bound of plain viscosity holds.
TEST(BulkViscosity, TheStepBoundHoldsForTheCorrectedViscosity)
{
  for (const Way &way : {Way{"neumann-richtmyer", "pairwise", "none"}, Way{"kuropatenko", "pairwise", "compression"}})
  {
    Parameters p          = parameters(way);
    p.options.bulk_linear = 2;
    p.options.step_factor = 1;
    auto         solver   = solver_of<3>(wild_block<3>(make(copper()), false, 1.), p);
    Driver<3>    driver{*solver};
    const double all = closed(solver->balance());
    for (int k = 0; k < 1500; ++k)
      ASSERT_TRUE(driver.once().ok);
    EXPECT_NEAR(closed(solver->balance()) / all, 1, 1e-9);
    EXPECT_LT(solver->balance().kinetic, 1.0000001 * all);
  }
}

// Saw-teeth of one element are what the correction leaves: 1 - (1/3)^dim of the
// viscous acceleration, so a bar loses them almost as fast as without.
TEST(BulkViscosity, TheCorrectionKeepsItsHoldOnSawTeeth)
{
  double left[2];
  for (const int corrected : {0, 1})
  {
    input::Scene scene;
    scene.dimension = input::Dimension::uniaxial;
    auto mesh       = make_mesh<1>(box({0, 0, 0}, {.1, .1, .1}, 1e-3), scene, 0, make(copper()));
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
      mesh.v[0][a] = a % 2 ? 1e-3 : -1e-3;
    Parameters p = parameters({"neumann-richtmyer", corrected ? "pairwise" : "none", "none"});
    auto         solver = solver_of<1>(std::move(mesh), p);
    Driver<1>    driver{*solver};
    const double before = closed(solver->balance());
    for (int k = 0; k < 60; ++k)
      ASSERT_TRUE(driver.once().ok);
    left[corrected] = 1 - solver->balance().bulk_viscosity_heat / before;
  }
  EXPECT_LT(left[0], .1);
  EXPECT_LT(left[1], .2);
}

// The accelerations of t_n and half the work of the corrected forces are state: a
// copy that loads them goes on with the same bits, and so does a run set back.
TEST(BulkViscosity, ACorrectedRunRestartsToTheBit)
{
  const Parameters p     = parameters({"neumann-richtmyer", "pairwise", "compression"});
  const auto       metal = make(copper_linear_hardening());
  auto             first = solver_of<3>(wild_block<3>(metal), p), second = solver_of<3>(wild_block<3>(metal), p);
  Driver<3>        a{*first};
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(a.once().ok);
  io::MemoryArchive archive;
  first->save(archive, "fem");
  first->snapshot();
  const double time = a.time, last = a.last;
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(a.once().ok);
  const Sample end = first->sample(0);
  second->load(archive, "fem");
  first->restore();
  for (auto *solver : {first.get(), second.get()})
  {
    Driver<3> again{*solver, time, last};
    for (int k = 0; k < 20; ++k)
      ASSERT_TRUE(again.once().ok);
    EXPECT_EQ(solver->sample(0).x, end.x);
    EXPECT_EQ(solver->sample(0).energy, end.energy);
  }
}
