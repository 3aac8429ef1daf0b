// SPDX-License-Identifier: LGPL-2.1-or-later
// The step bound against the stability it promises.
#include "sph/step_bound.h"
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.9e-3;

/// Linear limits quoted in numerics.md section 4 (cubic, h = 1.3 spacings), in h/c.
TEST(StepBound, LinearLimitsOfTheLattice)
{
  input::SphOptions o;
  o.correction = "none";
  // w = shares.frequency c sum V|gradW|; in 1-D the sum is 2 (|W'(dx)| + |W'(2dx)|) dx.
  const auto   s = lattice_shares<1>(o);
  const double h = 1.3, q1 = 1 / h, q2 = 2 / h;
  const double sum = 2 * (2. / 3 / (h * h)) * ((3 * q1 - 2.25 * q1 * q1) + .75 * (2 - q2) * (2 - q2));
  // The corrected form divides by the moment 2 sum |W'| x dx, 1.02 on this lattice.
  const double moment =
    2 * (2. / 3 / (h * h)) * ((3 * q1 - 2.25 * q1 * q1) + 2 * .75 * (2 - q2) * (2 - q2));
  EXPECT_NEAR(largest_step(s.frequency * sum / moment, 0) / h, 1.95, .01);
}

TEST(StepBound, RootSolvesTheCondition)
{
  for (double w : {0., 3e6})
    for (double d : {0., 2e5, 7e6})
      if (w + d > 0)
      {
        const double dt = largest_step(w, d);
        EXPECT_NEAR(dt * dt * w * w / 4 + dt * d / 2, 1, 1e-12);
      }
}

/// A free chain at tiny amplitude, no dissipation: noise stays at .9 and 1.0 of the bound and
/// explodes at 1.1. 10^4 steps.
template <int dim>
double growth(double share, const Vec3 &upper, int steps, const char *configuration = "current", double stiffness = 0)
{
  auto p = box<dim>(Vec3::Zero(), spacing * upper, spacing, copper());
  std::mt19937                           random(9);
  std::uniform_real_distribution<double> u(-1e-6, 1e-6);
  for (auto &v : p.v)
    for (auto &component : v)
      component = u(random);
  Parameters q;
  q.options.alpha = q.options.beta = 0;
  q.options.hourglass   = 0;
  q.options.correction  = "none";
  q.options.step_factor = 1;
  q.options.configuration       = configuration;
  q.options.hourglass_stiffness = stiffness;
  Solver<dim>  solver(q, {p});
  const double dt     = share * solver.stable_dt().dt;
  const double before = solver.balance().kinetic;
  Runner<dim>  run{solver};
  double       most = 0;
  for (int k = 0; k < steps; ++k)
  {
    if (!run.step(dt).ok)
      return 1e300;
    most = std::max(most, solver.balance().kinetic / before);
    if (most > 1e12)
      break;
  }
  return most;
}

TEST(StepBound, HoldsAtOneAndFailsAtElevenTenths)
{
  const Vec3 chain(60, 0, 0);
  EXPECT_LT(growth<1>(.9, chain, 10000), 20);
  EXPECT_LT(growth<1>(1., chain, 10000), 20);
  EXPECT_GT(growth<1>(1.1, chain, 10000), 1e6);
  // Free blocks: corners and edges are what is stiffest.
  EXPECT_LT(growth<2>(1., Vec3(14, 12, 0), 2000), 20);
  EXPECT_LT(growth<3>(1., Vec3(7, 6, 5), 2000), 20);
}

/// The same in the reference configuration, with as much hourglass stiffness as
/// may be asked for.
TEST(StepBound, HoldsOnTheReferenceLattice)
{
  const Vec3 chain(60, 0, 0);
  EXPECT_LT(growth<1>(1., chain, 10000, "reference"), 20);
  EXPECT_GT(growth<1>(1.1, chain, 10000, "reference"), 1e6);
  for (const double stiffness : {.2, .5})
  {
    EXPECT_LT(growth<1>(1., chain, 10000, "reference", stiffness), 20);
    EXPECT_LT(growth<2>(1., Vec3(14, 12, 0), 2000, "reference", stiffness), 20);
    EXPECT_LT(growth<3>(1., Vec3(7, 6, 5), 2000, "reference", stiffness), 20);
  }
}

/// Pressed to half its size the lattice waits for half its steps. Its rim held,
/// the rest hardly stirs at .9 of the bound and explodes at twice the step.
TEST(StepBound, FollowsTheStretchOfTheReferenceLattice)
{
  const auto moved = [](double share) {
    const auto p = box<2>(Vec3::Zero(), spacing * Vec3(14, 14, 0), spacing, material(1000, 9e6, 3e6));
    Parameters q;
    q.options.configuration = "reference";
    q.options.correction    = "none";
    q.options.alpha = q.options.beta = q.options.hourglass = 0;
    q.options.step_factor                                  = 1;
    Solver<2>                 solver(q, {p});
    Runner<2>                 run{solver};
    std::vector<std::int64_t> all, rim;
    for (std::int64_t i = 0; i < std::ssize(p.x); ++i)
    {
      all.push_back(i);
      const double from_middle = std::max(std::abs(p.x[i][0] / spacing - 7), std::abs(p.x[i][1] / spacing - 7));
      if (from_middle > 4)
        rim.push_back(i);
    }
    const double rest = solver.stable_dt().dt, dt = .2 * rest;
    solver.set_slaves(all);
    std::array<std::vector<double>, 2> v{std::vector<double>(all.size()), std::vector<double>(all.size())};
    for (int k = 0; k <= 100; ++k) // a last step at rest
    {
      for (std::size_t i = 0; i < all.size(); ++i)
        for (int a = 0; a < 2; ++a)
          v[a][i] = k < 100 ? -.5 * p.x[i][a] / (100 * dt) : 0.;
      solver.drive_slaves({v[0], v[1]});
      EXPECT_TRUE(run.step(dt).ok);
    }
    const double bound = solver.stable_dt().dt;
    EXPECT_LT(bound, .65 * rest); // the hourglass potential does not change
    solver.set_slaves(rim);
    const std::vector<double> still(rim.size(), 0.);
    double                    first = 0, most = 0;
    for (int k = 0; k < 600; ++k)
    {
      solver.drive_slaves({still, still});
      if (!run.step(share * bound).ok)
        return 1e300;
      most = std::max(most, solver.balance().kinetic);
      if (k < 20)
        first = most;
    }
    return most / first;
  };
  EXPECT_LT(moved(.9), 20);
  EXPECT_GT(moved(2), 1e6);
}

TEST(StepBound, NamesTheStiffestParticle)
{
  auto p   = box<2>(Vec3::Zero(), spacing * Vec3(10, 10, 0), spacing, copper());
  p.v[55]  = {400, 0}; // the quadratic viscosity of its pairs
  Parameters q;
  q.options.correction = "none"; // a split would stiffen the neighbour that is compressed
  Solver<2>       solver(q, {p});
  const StepLimit limit = solver.stable_dt();
  EXPECT_EQ(limit.culprit.id, 55);
  EXPECT_GT(limit.dt, 0);
  EXPECT_LT(limit.dt, 1.3 * spacing / 4660);
}
} // namespace
