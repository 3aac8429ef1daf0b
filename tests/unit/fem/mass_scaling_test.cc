// SPDX-License-Identifier: LGPL-2.1-or-later
// Masses scaled on request: FEM/mass scaling step.
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <random>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
Parameters scaled(double step)
{
  Parameters p;
  p.options.step_factor       = 1;
  p.options.mass_scaling_step = step;
  return p;
}
} // namespace

// A line of elements 1 mm long but for one of .5 mm, without viscosity: its bound
// is h/c and goes with the root of the mass, so to reach 1 mm/c it must weigh four
// times as much: 3 x .5 mm of bar are added to 9.5 mm.
TEST(MassScaling, AddsWhatTheClosedFormSays)
{
  const auto   metal = make(copper());
  input::Scene scene;
  scene.dimension = input::Dimension::uniaxial;
  auto mesh       = make_mesh<1>(box({0, 0, 0}, {.01, .01, .01}, 1e-3), scene, 0, metal);
  for (double &x : mesh.x[0])
    if (x > 4.5e-3)
      x -= .5e-3;
  const double step = 1e-3 / metal->sound_speed();
  Parameters   p    = scaled(step);
  p.options.bulk_linear = 0;
  auto       solver = solver_of<1>(mesh, p);
  const auto added  = solver->added_masses();
  ASSERT_EQ(added.size(), 1u);
  EXPECT_NEAR(added[0].mass, 3 * .5e-3 * 8930, 1e-9);
  EXPECT_NEAR(added[0].fraction, 3 * .5 / 9.5, 1e-12);
  EXPECT_NEAR(solver->stable_dt().dt / step, 1, 1e-12);
  EXPECT_NEAR(solver->balance().mass, (9.5e-3 + 1.5e-3) * 8930, 1e-9);
  // inertia only: the density of the equation of state stays
  EXPECT_NEAR(solver->sample(0).density[4], 8930, 1e-9);
}

namespace
{
template <int dim>
void expect_step_met(bool axisymmetric, const std::string &element, int degree = 1)
{
  const auto block = [&] { return wild_block<dim>(make(copper()), axisymmetric, 40, .2, element, degree); };
  const double bound = solver_of<dim>(block(), scaled(0))->stable_dt().dt;
  EXPECT_TRUE(solver_of<dim>(block(), scaled(0))->added_masses().empty());
  EXPECT_TRUE(solver_of<dim>(block(), scaled(.99 * bound))->added_masses().empty());
  const double step   = 1.3 * bound;
  auto         solver = solver_of<dim>(block(), scaled(step));
  ASSERT_EQ(solver->added_masses().size(), 1u) << element;
  EXPECT_NEAR(solver->stable_dt().dt / step, 1, 1e-12) << element;
  EXPECT_LT(solver->added_masses()[0].fraction, 1.3 * 1.3 - 1); // not all elements need all of it
  // and energy closes with the heavier nodes
  Driver<dim>  driver{*solver};
  const double all = closed(solver->balance());
  for (int k = 0; k < 100; ++k)
    ASSERT_TRUE(driver.once().ok);
  EXPECT_NEAR(closed(solver->balance()) / all, 1, 1e-11) << element;
}
} // namespace

TEST(MassScaling, TheStepIsMetAndTheDefaultAddsNothing)
{
  expect_step_met<1>(false, "one-point");
  expect_step_met<2>(false, "one-point");
  expect_step_met<2>(true, "one-point");
  expect_step_met<3>(false, "one-point");
  expect_step_met<2>(true, "b-bar");
  expect_step_met<3>(false, "b-bar");
  expect_step_met<2>(false, "spectral", 3);
}
