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
double growth(double share, const Vec3 &upper, int steps)
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
