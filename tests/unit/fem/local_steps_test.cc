// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements that step by their own bounds (fem/local_steps.h).
#include "core/base/error.h"
#include "core/io/memory_archive.h"
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
Parameters locally(const std::string &ratio)
{
  Parameters p;
  p.options.local_steps = ratio;
  return p;
}

/// 0 .. length in elements of h, those in the middle half of `fine` as long; one
/// layer of the edges between.
template <int dim>
void squeeze(BodyMesh<dim> &mesh, int axis, double fine)
{
  const auto [low, high] = std::minmax_element(mesh.x[axis].begin(), mesh.x[axis].end());
  const double from = *low, length = *high - *low;
  for (double &x : mesh.x[axis])
  {
    const double s = (x - from) / length;
    // a strain of 1 outside of .4 to .6, of `fine` within
    const double within = std::clamp(s - .4, 0., .2);
    x                   = from + length * (s - within + fine * within);
  }
}

/// A bar of n elements, the middle fifth of them an eleventh as long, in its first
/// free mode.
std::unique_ptr<Solver<1>> bar_of(const std::string &ratio, int n, double speed, double linear = .06)
{
  auto mesh = block<1>({0, 0, 0}, {1, 0, 0}, 1. / n);
  squeeze(mesh, 0, 1 / 11.);
  const double length = mesh.x[0].back();
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    mesh.v[0][a] = speed * std::cos(std::numbers::pi * mesh.x[0][a] / length);
  auto p                   = locally(ratio);
  p.options.bulk_linear    = linear;
  p.options.bulk_quadratic = linear > 0 ? 1.5 : 0;
  return solver_of<1>(std::move(mesh), p);
}

/// Time at which the velocity of the left end passes zero for the n-th time.
double crossing(Solver<1> &bar, int n)
{
  Driver<1> driver{bar};
  double    before = bar.surface().v[0][0], at = 0;
  while (n > 0)
  {
    EXPECT_TRUE(driver.once().ok);
    const double now = bar.surface().v[0][0];
    if (before * now < 0)
    {
      --n;
      // velocities belong to the middle of their steps
      at = driver.time - .5 * driver.last - driver.last * now / (now - before);
    }
    before = now;
  }
  return at;
}

/// A distorted block in violent motion with a layer of thin elements.
template <int dim>
BodyMesh<dim> uneven_block(bool axisymmetric = false)
{
  const double h = .8e-3;
  auto mesh = block<dim>({axisymmetric ? 0 : 1e-3, 2e-3, -1e-3}, {(axisymmetric ? 0 : 1e-3) + 4 * h, 2e-3 + 10 * h, -1e-3 + 2 * h},
                         h, axisymmetric);
  squeeze(mesh, dim == 1 ? 0 : 1, 1 / 12.);
  shake(mesh, .01 * h, 30.);
  return mesh;
}

template <int dim>
double open_books(const Solver<dim> &s)
{
  return closed(s.balance()) - s.parts_error();
}

template <int dim>
void expect_books(Solver<dim> &solver, int steps, bool axisymmetric)
{
  ASSERT_GE(solver.local_plan().elements.size(), 3u); // classes 1, 2, 4 at least
  Driver<dim>   driver{solver};
  const Balance b0    = solver.balance();
  const double  start = open_books(solver);
  for (int k = 0; k < steps; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    ASSERT_NEAR(open_books(solver), start, 1e-12 * start) << "step " << k;
  }
  const Balance b = solver.balance();
  EXPECT_LT(b.kinetic, .95 * b0.kinetic); // it did work
  EXPECT_NE(solver.parts_error(), 0);     // and the books would not close without
  EXPECT_LT(std::abs(solver.parts_error()), .02 * b0.kinetic);
  const double scale = b0.mass * 30;
  for (int i = axisymmetric ? 1 : 0; i < dim; ++i)
    EXPECT_NEAR((b.momentum[i] - b.external_impulse[i] - b0.momentum[i]) / scale, 0, 1e-13);
}
} // namespace

// Each impulse has its counterpart at the same time; what nodes get beyond the
// elements' work is in parts_error().
TEST(LocalSteps, BooksCloseOnALine)
{
  expect_books(*bar_of("8", 60, 30.), 200, false);
}
TEST(LocalSteps, BooksCloseInASection) { expect_books(*solver_of<2>(uneven_block<2>(), locally("8")), 200, false); }
TEST(LocalSteps, BooksCloseInARing) { expect_books(*solver_of<2>(uneven_block<2>(true), locally("8")), 200, true); }
TEST(LocalSteps, BooksCloseInSpace) { expect_books(*solver_of<3>(uneven_block<3>(), locally("8")), 100, false); }

// Two meshes that are tied: slaves have the class of their masters.
TEST(LocalSteps, BooksCloseAcrossATie)
{
  const double               h = .8e-3;
  std::vector<BodyMesh<2>> meshes;
  meshes.push_back(block<2>({0, 0, 0}, {4 * h, 4 * h, 0}, h, false, 0));
  meshes.push_back(block<2>({0, 4 * h, 0}, {4 * h, 6 * h, 0}, h / 6, false, 1));
  shake(meshes[0], 0, 30.);
  shake(meshes[1], 0, 30.);
  auto p = locally("8");
  p.ties.push_back({"tie", 1, 0, .1});
  const auto solver = solver_with<2>(std::move(meshes), p);
  expect_books(*solver, 150, false);
}

// Whoever acts from outside acts with the steps of each node. A wall, a driven
// face, a pressure and an absorbing face.
TEST(LocalSteps, BooksCloseWithAllThatActsAtTheEdges)
{
  auto p = locally("8");
  p.walls.push_back({"wall", {1.05e-3, 0, 0}, Vec3::UnitX(), Vec3::Zero(), .2});
  auto driven     = boundary("y-", input::BoundaryKind::velocity);
  driven.velocity = {0, 12, 0};
  driven.fix[0] = driven.fix[2] = false;
  auto pressed     = boundary("x+", input::BoundaryKind::pressure);
  pressed.pressure = 40e6;
  p.boundaries     = {driven, pressed, boundary("y+", input::BoundaryKind::absorbing)};
  auto mesh        = uneven_block<2>();
  for (double &v : mesh.v[0])
    v -= 30; // into the wall
  const auto   solver = solver_with<2>(std::move(mesh), p);
  Driver<2>    driver{*solver};
  const double start = open_books(*solver);
  const auto   b0    = solver->balance();
  bool         touched = false;
  for (int k = 0; k < 150; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    ASSERT_NEAR(open_books(*solver), start, 1e-12 * b0.kinetic) << "step " << k;
    touched |= solver->wall_force(0) > 0;
  }
  const auto b = solver->balance();
  EXPECT_TRUE(touched);
  EXPECT_GT(b.absorbed, 0);
  EXPECT_NE(b.external_work, 0);
  EXPECT_LE((b.momentum - b.external_impulse - b0.momentum).norm(), 1e-13 * b0.mass * 60);
}

// The first mode of a free bar. An element beside a finer class sees its nodes at
// the ends of its own step, where the impulses have shaken them most: it acts as
// if it were a few per cent shorter. The eigenvalues of LocalStepsScheme's bars
// give .045 of a coarse element for both sides of a fine zone, ratio 8, where the
// strain is the mean one; here the zone is where it is greatest: twice that.
TEST(LocalSteps, PeriodOfAGradedBarIsThatOfATenthOfAnElementLess)
{
  double last = 1;
  for (const int n : {30, 60, 120})
  {
    const auto one = bar_of("none", n, 1.), local = bar_of("8", n, 1.);
    ASSERT_EQ(local->local_plan().elements.size(), 4u);
    const double alike = crossing(*one, 4), parts = crossing(*local, 4); // 1.75 periods
    const double off   = std::abs(parts / alike - 1);
    EXPECT_LE(off, .1 / n);
    EXPECT_LT(off, .8 * last); // of first order in the elements
    last = off;
    const double energy = closed(one->balance());
    EXPECT_NEAR(local->balance().bulk_viscosity_heat / energy, one->balance().bulk_viscosity_heat / energy, .1 / n);
    EXPECT_LE(std::abs(local->parts_error()), .5 / n * energy);
  }
}

// A pulse crosses the fine zone: the time that the far end needs to move.
TEST(LocalSteps, AFrontCrossesTheFineZoneAtTheSameSpeed)
{
  double arrival[2];
  for (const bool local : {false, true})
  {
    auto mesh = block<1>({0, 0, 0}, {1, 0, 0}, .005);
    squeeze(mesh, 0, 1 / 11.);
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
      mesh.v[0][a] = mesh.x[0][a] < .1 ? 10. : 0.;
    const auto solver = solver_of<1>(std::move(mesh), locally(local ? "8" : "none"));
    Driver<1>  driver{*solver};
    double     before = 0;
    while (true)
    {
      ASSERT_TRUE(driver.once().ok);
      const double now = solver->surface().v[0][solver->size()];
      if (now > 5)
      {
        arrival[local] = driver.time - .5 * driver.last - driver.last * (now - 5) / (now - before);
        break;
      }
      before = now;
    }
  }
  EXPECT_NEAR(arrival[1] / arrival[0], 1, .002); // a whole step is .45 % of it
}

// Cost: steps of elements over the run as the classes promise.
TEST(LocalSteps, ElementUpdatesFallAsPlanned)
{
  const auto one = bar_of("none", 200, 1.), local = bar_of("8", 200, 1.);
  const auto plan = local->local_plan();
  Driver<1>  a{*one}, b{*local};
  ASSERT_TRUE(a.until(2e-4).ok);
  ASSERT_TRUE(b.until(2e-4).ok);
  const double ratio = static_cast<double>(local->updates()) / static_cast<double>(one->updates());
  EXPECT_NEAR(ratio, plan.updates, .02 * plan.updates);
  EXPECT_LT(ratio, .45); // 40 of 200 elements at the eighth: 40 + 160/8, some between
}

// Squeezed: the classes follow the elements.
TEST(LocalSteps, ClassesFollowElementsThatAreSqueezed)
{
  // A soft bar flies at a wall: 450 m/s, with 600 m/s of sound.
  auto mesh = block<1>({0, 0, 0}, {1, 0, 0}, .01, false, 0, elastic(2e9, .35, 8930));
  for (double &v : mesh.v[0])
    v = -450;
  auto p = locally("8");
  p.boundaries.push_back(boundary("x-", input::BoundaryKind::fixed));
  const auto solver = solver_with<1>(std::move(mesh), p);
  EXPECT_EQ(solver->local_plan().elements.size(), 1u);
  Driver<1>    driver{*solver};
  const double start = open_books(*solver);
  const auto   b0    = solver->balance();
  std::size_t  most  = 1;
  for (int k = 0; k < 400; ++k)
  {
    const auto status = driver.once();
    ASSERT_TRUE(status.ok) << k << status.culprit.why << status.culprit.id;
    most = std::max(most, solver->local_plan().elements.size());
    ASSERT_NEAR(open_books(*solver), start, 1e-12 * b0.kinetic);
  }
  const auto b = solver->balance();
  EXPECT_GE(most, 2u);
  EXPECT_LE((b.momentum - b.external_impulse - b0.momentum).norm(), 1e-12 * b0.momentum.norm());
}

TEST(LocalSteps, GoesOnAfterACheckpointAndARejectedStepToTheBit)
{
  const auto make = [] { return solver_of<2>(uneven_block<2>(), locally("8")); };
  const auto whole = make(), resumed = make();
  Driver<2>  a{*whole}, b{*resumed};
  for (int k = 0; k < 37; ++k)
    ASSERT_TRUE(a.once().ok);
  io::MemoryArchive archive;
  whole->save(archive, "fem");
  resumed->load(archive, "fem");
  b.time = a.time;
  b.last = a.last;
  whole->snapshot();
  for (int k = 0; k < 30; ++k) // beyond a look at the classes
    ASSERT_TRUE(a.once().ok);
  whole->restore();
  a.time = b.time;
  a.last = b.last;
  for (int k = 0; k < 60; ++k)
  {
    ASSERT_TRUE(a.once().ok);
    ASSERT_TRUE(b.once().ok);
  }
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(whole->sample(0).x, resumed->sample(0).x);
  EXPECT_EQ(whole->sample(0).v, resumed->sample(0).v);
  EXPECT_EQ(whole->sample(0).sigma, resumed->sample(0).sigma);
  EXPECT_EQ(whole->parts_error(), resumed->parts_error());
}

// 1e5 steps of a bar without viscosity: the energy stays as it was.
TEST(LocalSteps, AHundredThousandStepsAreStable)
{
  const auto   bar = bar_of("8", 30, 1e-3, 0);
  Driver<1>    driver{*bar};
  const double before = bar->balance().kinetic;
  double       most   = 0;
  ASSERT_GE(bar->local_plan().elements.size(), 3u);
  for (int k = 0; k < 100000; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    if (k % 100 == 0)
    {
      const auto b = bar->balance();
      most         = std::max(most, b.kinetic + b.internal());
    }
  }
  EXPECT_LT(most, 1.02 * before);
  EXPECT_LT(std::abs(bar->parts_error()), .02 * before);
}

// Elements of one size gain nothing: one class, and the plain steps.
TEST(LocalSteps, AutoLeavesAnEvenMeshAlone)
{
  const auto alike = solver_of<2>(wild_block<2>(make(copper()), false, 40, 0), locally("none"));
  const auto free  = solver_of<2>(wild_block<2>(make(copper()), false, 40, 0), locally("auto"));
  EXPECT_EQ(free->local_plan().elements.size(), 1u);
  Driver<2> a{*alike}, b{*free};
  for (int k = 0; k < 15; ++k)
  {
    ASSERT_TRUE(a.once().ok);
    ASSERT_TRUE(b.once().ok);
  }
  const auto x = alike->sample(0).x, y = free->sample(0).x;
  for (int i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < x[i].size(); ++k)
      EXPECT_NEAR(x[i][k], y[i][k], 1e-15);
}

TEST(LocalSteps, EndsWhenToldTo)
{
  const auto   solver = solver_of<2>(uneven_block<2>(), locally("8"));
  Driver<2>    driver{*solver};
  const double start = open_books(*solver);
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(driver.once().ok);
  const double whole = solver->stable_dt().dt;
  solver->end_local_steps();
  EXPECT_FALSE(solver->steps_locally());
  EXPECT_LT(solver->stable_dt().dt, .4 * whole);
  for (int k = 0; k < 60; ++k)
    ASSERT_TRUE(driver.once().ok);
  EXPECT_EQ(solver->local_plan().elements.size(), 1u);
  EXPECT_NEAR(open_books(*solver), start, 1e-12 * start);
}

TEST(LocalSteps, RefusesWhatCannotBe)
{
  const auto mesh = [](const std::string &element) { return wild_block<2>(make(copper()), false, 40, 0, element); };
  EXPECT_THROW(solver_of<2>(mesh("b-bar"), locally("4")), InputError);
  EXPECT_FALSE(solver_of<2>(mesh("b-bar"), locally("auto"))->local_plan().on);
  auto p                = locally("4");
  p.options.step_bound = "power-iteration";
  EXPECT_THROW(solver_of<2>(mesh("one-point"), p), InputError);
  auto eroding       = mesh("one-point");
  eroding.erosion.on = true;
  EXPECT_THROW(solver_of<2>(eroding, locally("4")), InputError);
}
