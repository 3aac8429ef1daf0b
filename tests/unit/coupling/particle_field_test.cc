// SPDX-License-Identifier: LGPL-2.1-or-later
// The surface that particles show: even over a lattice, at the touch, and with
// slopes that are the derivative of the depth. Bounds of evenness: the lattice
// sums of a separate script, 1e-4 to 3e-4 of the spacing at h = 1.5 spacings.
#include "coupling/particle_field.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::coupling
{
namespace
{
/// Depth of a point over the half space of lattice points z <= 0 (last axis).
template <int dim>
double depth_over_lattice(const ParticleField<dim> &field, const Point<dim> &at, double spacing)
{
  const int n   = static_cast<int>(std::ceil(field.reach() / spacing)) + 2;
  double    psi = 0;
  int       all = 1;
  for (int a = 0; a < dim; ++a)
    all *= 2 * n + 1;
  for (int k = 0; k < all; ++k)
  {
    Point<dim> x;
    for (int a = 0, rest = k; a < dim; ++a, rest /= 2 * n + 1)
      x[a] = (rest % (2 * n + 1) - n) * spacing;
    if (x[dim - 1] < .5 * spacing)
      psi += field.weight((at - x).norm());
  }
  return field.depth(psi);
}

template <int dim>
void even_and_exact()
{
  const double                           spacing = 1.7e-3;
  const ParticleField<dim>               field(spacing, spacing);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> u(-.5, .5);
  for (int trial = 0; trial < 200; ++trial)
  {
    Point<dim> at;
    for (int a = 0; a < dim; ++a)
      at[a] = u(random) * spacing;
    for (const double depth : {0., .02, .1})
    {
      at[dim - 1] = (1 - depth) * spacing;
      // Touch where the surfaces meet; the depth grows by 1 m per m there.
      EXPECT_NEAR(depth_over_lattice(field, at, spacing), depth * spacing, (4e-4 + .15 * depth) * spacing);
    }
  }
}
} // namespace

TEST(ParticleField, IsEvenOverALattice)
{
  even_and_exact<1>();
  even_and_exact<2>();
  even_and_exact<3>();
}

TEST(ParticleField, SlopeIsTheDerivativeOfTheDepth)
{
  const ParticleField<3> field(2e-3, 1.5e-3);
  for (double r = .05e-3; r < field.reach(); r += .21e-3)
  {
    const double d = 1e-8;
    EXPECT_NEAR(field.slope(r), (field.depth(field.weight(r - d)) - field.depth(field.weight(r + d))) / (2 * d),
                1e-6);
  }
  EXPECT_EQ(field.slope(field.reach()), 0);
}
} // namespace ogive::coupling
