// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8_modes.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::fem
{
namespace
{
/// A distorted brick away from the origin, with velocities, a stress and
/// hourglass forces of no pattern.
struct Wild
{
  double x[8][3], v[8][3], sigma[6], Q[4][3];
  Wild()
  {
    constexpr double                       corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i)
        x[a][i] = 2 + corner[a][i] + .25 * u(random), v[a][i] = u(random);
    for (double &s : sigma)
      s = u(random);
    for (auto &q : Q)
      for (double &force : q)
        force = u(random);
  }
};
} // namespace

// Hex8 and its modes are the same element: shape, motion, lengths and forces of a
// distorted brick agree to rounding (numbers of order one).
TEST(Modes, AreTheBrickOfItsCorners)
{
  const Wild                w;
  Geometry<Hex8, double>    g{};
  Deformation<Hex8, double> d{}, e{};
  ModalShape<double>        m{};
  deform<Hex8, double>(w.x, w.v, .1, g, d);
  deform<Hex8, double>(w.x, w.v, .1, m, e);
  constexpr double close = 1e-13;
  EXPECT_NEAR(m.volume, g.volume, close);
  EXPECT_GT(g.volume, .3);
  for (int c = 0; c < 6; ++c)
  {
    EXPECT_NEAR(e.strain[c], d.strain[c], close);
    EXPECT_NEAR(e.dual[c], d.dual[c], close);
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(e.spin[c], d.spin[c], close);
  EXPECT_NEAR(e.trace, d.trace, close);
  double B[8][3], force[8][3], expected[8][3];
  corner_areas(m, B);
  corner_forces<Hex8, double>(g, w.sigma, w.Q, expected);
  corner_forces<Hex8, double>(m, w.sigma, w.Q, force);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(B[a][i], g.B[a][i], close);
      EXPECT_NEAR(force[a][i], expected[a][i], close);
      EXPECT_NEAR(e.rate[a % 4][i], d.rate[a % 4][i], close);
      EXPECT_NEAR(m.skew[a % 4][i], g.skew[a % 4][i], close);
    }
  const double ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  const auto   corners = gram<Hex8, double>(g, ones), modes = gram<Hex8, double>(m, ones);
  EXPECT_NEAR(modes.largest, corners.largest, close);
  EXPECT_NEAR(modes.divergence, corners.divergence, close);
  EXPECT_NEAR(modes.trace, corners.trace, close);
}

// The power of the stress in a shape is that of the corner forces of the shape,
// less than zero where they push.
TEST(Modes, StressTakesThePowerOfItsForces)
{
  const Wild                w;
  ModalShape<double>        m{};
  Deformation<Hex8, double> d{};
  deform<Hex8, double>(w.x, w.v, .1, m, d);
  double force[8][3], X[7][3], V[7][3], power = 0, size = 0;
  corner_forces<Hex8, double>(m, w.sigma, w.Q, force);
  modes_of(w.x, X);
  modes_of(w.v, V);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
    {
      power -= force[a][i] * w.v[a][i];
      size += std::abs(force[a][i] * w.v[a][i]);
    }
  EXPECT_NEAR(power_taken(X, V, w.sigma, w.Q), power, 1e-14 * size);
  EXPECT_GT(size, 1);
}
} // namespace ogive::fem
