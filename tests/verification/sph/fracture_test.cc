// SPDX-License-Identifier: LGPL-2.1-or-later
// Material that breaks must not feed on what stands beside it: once a strip has
// torn and flies apart, what it has turned into heat cannot exceed what it
// brought, and stress has given back no more than it took (first law). Forces
// and gradients that are not transposed of each other, such as a damage factor
// on the force alone, fail this by an order of magnitude.
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

TEST(Fracture, TornStripDrawsNoEnergyFromItsStress)
{
  const double          dx = 1.1e-3, v0 = 350;
  materials::Parameters m = material(7850, 160e9, 77e9, 6e8)->parameters();
  m.damage.law            = "plastic-strain";
  m.damage.failure_strain = .15;
  auto p = box<2>(Vec3::Zero(), dx * Vec3(40, 12, 0), dx, materials::make_material(m));
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    p.v[i][0] = v0 * (p.x[i][0] - 20 * dx) / (20 * dx);
    p.v[i][1] = .5 * v0 * std::sin(300 * p.x[i][0]); // shears it too
  }
  Solver<2>     solver({}, {p});
  Runner<2>     run{solver};
  const Balance start = solver.balance();
  while (run.time < 150e-6)
    ASSERT_TRUE(run.step(solver.stable_dt().dt).ok);

  const Sample  sample = solver.sample(0);
  const auto    broken = std::count_if(sample.damage.begin(), sample.damage.end(), [](double d) { return d >= 1; });
  const Balance end    = solver.balance();
  EXPECT_GT(broken, 10);
  EXPECT_LT(end.plastic_work + end.viscosity_heat + end.hourglass_sph, start.kinetic);
  EXPECT_GT(end.elastic, -.02 * start.kinetic);
  EXPECT_NEAR(end.kinetic + end.internal(), start.kinetic, 1e-10 * start.kinetic);
}
} // namespace
