// SPDX-License-Identifier: LGPL-2.1-or-later
// An elastic bar in uniaxial strain meets a rigid wall: it leaves after 2L/c
// with the speed it came with (d'Alembert, validation.md A1).
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

TEST(ElasticBar, ContactTimeAndRebound)
{
  const double length = .1, v0 = 1.2, dx = length / 400;
  // Copper, E 117 GPa, nu .35, rho 8930: c_L 4585.60 m/s.
  const auto   copper = material(8930, 130e9, 117e9 / 2.7);
  const double c      = 4585.60;
  EXPECT_NEAR(copper->sound_speed(), c, 1);
  auto p = box<1>(Vec3::Zero(), Vec3(length, 0, 0), dx, copper);
  for (auto &v : p.v)
    v[0] = -v0;
  Parameters q;
  q.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitX(), Vec3::Zero(), 0});
  Solver<1>    solver(q, {p});
  Runner<1>    run{solver};
  double       first = -1, last = 0;
  while (run.time < 3 * length / c)
  {
    const double dt = solver.stable_dt().dt;
    ASSERT_TRUE(run.step(dt).ok);
    if (solver.wall_force(0) > 0)
    {
      if (first < 0)
        first = run.time;
      last = run.time;
    }
  }
  const Balance b = solver.balance();
  EXPECT_NEAR((last - first) / (2 * length / c), 1, .02);
  EXPECT_NEAR(b.momentum[0] / b.mass / v0, 1, .02);
}
} // namespace
