// SPDX-License-Identifier: LGPL-2.1-or-later
// Elastic-plastic piston (validation.md A3): copper, exact speeds and states of
// the hypoelastic model, from ExactPack ep_piston.
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

std::shared_ptr<const materials::Material> piston_copper()
{
  materials::Parameters p;
  p.name                  = "copper";
  p.density               = 8930;
  p.shear_modulus         = 45e9;
  p.eos.law               = "mie-grueneisen";
  p.eos.bulk_sound_speed  = 3940;
  p.eos.slope             = 1.49;
  p.eos.gamma             = 2;
  p.strength.law          = "perfect-plastic";
  p.strength.yield_stress = 90e6;
  return materials::make_material(p);
}

/// Where the axial stress, sorted by x, last passes `level`.
double front(const Sample &s, double level)
{
  double at = 0;
  for (std::size_t i = 0; i < s.id.size(); ++i)
    if (-s.sigma[0][i] > level)
      at = std::max(at, s.x[0][i]);
  return at;
}

struct Exact
{
  double piston, stress, shock;
};

class Piston : public testing::TestWithParam<Exact>
{};

TEST_P(Piston, ShockPrecursorAndPlateau)
{
  const Exact exact = GetParam();
  auto        p     = box<1>(Vec3::Zero(), Vec3(1, 0, 0), 1. / 800, piston_copper());
  Parameters  q;
  q.walls.push_back({"piston", Vec3::Zero(), Vec3::UnitX(), Vec3(exact.piston, 0, 0), 0});
  Solver<1> solver(q, {p});
  Runner<1> run{solver};
  double    front_then[2] = {0, 0}, t_then = 0;
  const double precursor = .19903e9, middle = .5 * (precursor + exact.stress);
  while (run.time < 150e-6)
  {
    ASSERT_TRUE(run.step(std::min(solver.stable_dt().dt, 150e-6 - run.time + 1e-12)).ok);
    if (t_then == 0 && run.time > 60e-6)
    {
      t_then        = run.time;
      front_then[0] = front(solver.sample(0), middle);
      front_then[1] = front(solver.sample(0), .5 * precursor);
    }
  }
  const Sample s     = solver.sample(0);
  const double shock = (front(s, middle) - front_then[0]) / (run.time - t_then);
  const double wave  = (front(s, .5 * precursor) - front_then[1]) / (run.time - t_then);
  double       plateau = 0, n = 0;
  for (std::size_t i = 0; i < s.id.size(); ++i)
    if (s.x[0][i] > .1 && s.x[0][i] < .4)
    {
      plateau -= s.sigma[0][i];
      ++n;
    }
  plateau /= n;
  std::printf("piston %g m/s: shock %.2f (%.2f) m/s, precursor %.2f (4722.18), plateau %.5g (%.5g) Pa\n",
              exact.piston, shock, exact.shock, wave, plateau, exact.stress);
  EXPECT_NEAR(shock / exact.shock, 1, .01);
  EXPECT_NEAR(wave / 4722.18, 1, .02);
  EXPECT_NEAR(plateau / exact.stress, 1, .01);
}

INSTANTIATE_TEST_SUITE_P(A3, Piston,
                         testing::Values(Exact{20, .74159e9, 3976.96}, Exact{40, 1.46113e9, 4006.71}));
} // namespace
