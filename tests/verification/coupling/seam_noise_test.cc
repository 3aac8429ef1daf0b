// SPDX-License-Identifier: LGPL-2.1-or-later
// Free blocks that begin as noise: a seam must not feed on it.
#include "tests/verification/coupling/seams.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace ogive::coupling
{
namespace
{
using namespace seams;

double mechanical(const LedgerRow &row)
{
  return row.kinetic + row.elastic;
}

/// What random noise becomes: its energy over that at the start after a tenth of
/// the steps and after all of them, and the largest in between.
struct Decay
{
  double early = 0, late = 0, most = 0;
};

template <int dim>
Decay decay(const Blocks &blocks, int steps)
{
  Start<dim>   run(scene_of(blocks), noise<dim>());
  const double first = mechanical(run.model.ledger());
  Decay        d;
  for (int n = 1; n <= steps; ++n)
  {
    if (!run.step())
    {
      ADD_FAILURE() << "step " << n << " fails";
      return d;
    }
    if (n == steps / 10)
      d.early = mechanical(run.model.ledger()) / first;
    if (n % (steps / 100) == 0 && n > steps / 10)
      d.most = std::max(d.most, mechanical(run.model.ledger()) / first);
  }
  d.late = mechanical(run.model.ledger()) / first;
  std::printf("%s, %d-D, elements of %g dx, %s: energy of noise %.5f after %d steps, %.5f after %d, at most %.5f between\n",
              blocks.method.c_str(), dim, blocks.ratio, blocks.element.c_str(), d.early, steps / 10, d.late, steps,
              d.most);
  return d;
}

// numerics.md section 6: E(N) < E(N/10) < E0/2. Between the two it comes and goes
// with what is stored against hourglass modes.
template <int dim>
void expect_decay(const Blocks &blocks, int steps)
{
  const Decay d = decay<dim>(blocks, steps);
  EXPECT_LT(d.early, .5);
  EXPECT_LT(d.late, d.early);
  EXPECT_LT(d.most, .5);
}

#ifdef OGIVE_SLOW
constexpr int steps = 100000;
#else
constexpr int steps = 10000;
#endif
} // namespace

TEST(SeamNoise, TiedDecays) { expect_decay<2>({.method = "tied"}, steps); }
TEST(SeamNoise, PairFluxDecays) { expect_decay<2>({}, steps); }
TEST(SeamNoise, PairFluxOfLargerElementsDecays)
{
  expect_decay<2>({.ratio = 2}, steps);
  expect_decay<2>({.ratio = 4}, steps);
}
TEST(SeamNoise, TiedBBarDecays) { expect_decay<2>({.method = "tied", .element = "b-bar"}, steps); }
TEST(SeamNoise, PairFluxInAxialSymmetryDecays)
{
  expect_decay<2>({.dimension = input::Dimension::axisymmetric}, steps);
}
TEST(SeamNoise, PairFluxInSpaceDecays)
{
  expect_decay<3>({.dimension = input::Dimension::three_d, .half = Vec3(6 * dx, 6 * dx, 6 * dx)}, steps / 5);
}
} // namespace ogive::coupling
