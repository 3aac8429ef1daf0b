// SPDX-License-Identifier: LGPL-2.1-or-later
// Free blocks that begin as noise: a seam must not feed on it.
#include "tests/verification/coupling/seams.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cstdio>

namespace ogive::coupling
{
namespace
{
using namespace seams;

/// Energy of the motion of the whole, J: it does not decay.
template <int dim>
double rigid_energy(const Model<dim> &model, const LedgerRow &row, bool turns)
{
  const Vec3      velocity = row.momentum / row.mass;
  Vec3            middle   = Vec3::Zero();
  Eigen::Matrix3d inertia  = Eigen::Matrix3d::Zero();
  const auto      for_each = [&](auto &&f) {
    for (int body = 0; body < 2; ++body)
    {
      const Sample s = model.sample(body);
      for (std::size_t i = 0; i < s.mass.size(); ++i)
        f(s.mass[i], Vec3(s.x[0][i], s.x[1][i], s.x[2][i]));
    }
  };
  for_each([&](double m, const Vec3 &x) { middle += m / row.mass * x; });
  for_each([&](double m, const Vec3 &x) {
    const Vec3 r = x - middle;
    inertia += m * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  });
  const Vec3   spin = row.angular_momentum - row.mass * middle.cross(velocity);
  const double move = .5 * row.mass * velocity.squaredNorm();
  if (!turns)
    return move;
  return move + (dim == 3 ? .5 * spin.dot(inertia.ldlt().solve(spin)) : .5 * spin[2] * spin[2] / inertia(2, 2));
}

/// What is left of the noise, J.
template <int dim>
double noise_energy(const Model<dim> &model, const Blocks &blocks)
{
  const LedgerRow row = model.ledger();
  return row.kinetic + row.elastic + row.hourglass_fem -
         rigid_energy(model, row, blocks.dimension != input::Dimension::axisymmetric);
}

/// What random noise becomes: its energy, less that of the motion of the whole, over that at the start after a tenth of
/// the steps and after all of them, and the largest in between.
struct Decay
{
  double early = 0, late = 0, most = 0;
};

template <int dim>
Decay decay(const Blocks &blocks, int steps)
{
  Start<dim>   run(scene_of(blocks), noise<dim>());
  const double first = noise_energy(run.model, blocks);
  Decay        d;
  for (int n = 1; n <= steps; ++n)
  {
    if (!run.step())
    {
      ADD_FAILURE() << "step " << n << " fails";
      return d;
    }
    if (n == steps / 10)
      d.early = noise_energy(run.model, blocks) / first;
    if (n % (steps / 100) == 0 && n > steps / 10)
      d.most = std::max(d.most, noise_energy(run.model, blocks) / first);
  }
  d.late = noise_energy(run.model, blocks) / first;
  std::printf("%s, %d-D, elements of %g dx, %s: energy of noise %.5f after %d steps, %.5f after %d, at most %.5f between\n",
              blocks.method.c_str(), dim, blocks.ratio, blocks.element.c_str(), d.early, steps / 10, d.late, steps,
              d.most);
  return d;
}

// numerics.md section 6: E(N) < E(N/10) < E0/2.
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
TEST(SeamNoise, BlendedDecays)
{
  expect_decay<2>({.method = "blended"}, steps);
  expect_decay<2>({.method = "blended", .ratio = 2}, steps);
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
