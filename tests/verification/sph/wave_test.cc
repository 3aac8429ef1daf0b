// SPDX-License-Identifier: LGPL-2.1-or-later
// A standing wave of 32 spacings keeps its energy with the correction, and
// loses what theory says without.
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

/// Share of the mechanical energy that heats in one period (= one wavelength of
/// travel) of a standing wave between a mirror and a free end, where it has its
/// nodes and its greatest speed.
double loss(const char *correction)
{
  const double dx = 1.1e-3, amplitude = .5; // m/s
  auto         p  = box<1>(Vec3::Zero(), Vec3(72 * dx, 0, 0), dx, copper());
  const double k = 2 * M_PI / (32 * dx), c = p.material->sound_speed();
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i][0] = amplitude * std::sin(k * p.x[i][0]);
  Parameters q;
  q.options.correction = correction;
  q.symmetry           = {{0}};
  Solver<1>    solver(q, {p});
  Runner<1>    run{solver};
  const double start = solver.balance().kinetic;
  while (run.time < 32 * dx / c)
    EXPECT_TRUE(run.step().ok);
  return solver.balance().viscosity_heat / start;
}

TEST(Wave, CorrectionKeepsIt)
{
  const double corrected = loss("pairwise"), plain = loss("none");
  EXPECT_LE(corrected, .01);
  // Linear viscosity on approach only: nu = alpha c h/4 (validation.md E2), the
  // energy of a standing wave decays as exp(-nu k^2 t): over one period
  // 1 - exp(-alpha h (2 pi)^2/(4 lambda)).
  const double expected = 1 - std::exp(-1.3 * 4 * M_PI * M_PI / (4 * 32));
  EXPECT_NEAR(plain, expected, .1 * expected);
}
} // namespace
