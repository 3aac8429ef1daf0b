// SPDX-License-Identifier: LGPL-2.1-or-later
// What comes back from absorbing faces at normal incidence: next to nothing.
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;
using input::BoundaryKind;

namespace
{
Parameters quiet()
{
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  return p;
}

double mechanical(const Balance &b)
{
  return b.kinetic + b.elastic + b.hourglass_fem;
}

/// Energy that a packet of wavelength 20 h leaves in a bar of width 2 h in
/// uniaxial strain whose ends absorb, over what it had.
template <int dim>
double left_in_bar()
{
  const double h = 1e-3, length = 200 * h, wave = 20 * h;
  auto         mesh = block<dim>(Vec3::Zero(), {length, 2 * h, 2 * h}, h);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const double s = mesh.x[0][a] - .5 * length;
    mesh.v[0][a]   = 1e-3 * std::exp(-.5 * s * s / (wave * wave)) * std::sin(2 * M_PI * s / wave);
  }
  Parameters p = quiet();
  p.boundaries = {boundary("x-", BoundaryKind::absorbing), boundary("x+", BoundaryKind::absorbing)};
  for (const char *face : {"y-", "y+", "z-", "z+"})
    if (face[0] - 'x' < dim)
    {
      p.boundaries.push_back(boundary(face, BoundaryKind::fixed));
      p.boundaries.back().fix[0] = false;
    }
  auto          solver = solver_with(std::move(mesh), p);
  const Balance before = solver->balance();
  Driver<dim>   driver{*solver};
  EXPECT_TRUE(driver.until(1.2 * length / 4586).ok);
  const Balance after = solver->balance();
  EXPECT_NEAR(closed(after) / closed(before), 1, 1e-10);
  EXPECT_NEAR(after.absorbed / before.kinetic, 1, 1e-3);
  return mechanical(after) / mechanical(before);
}

// The wave on the mesh has the impedance rho c cos(k h/2) (validation.md, E1), the
// dashpot rho c: an amplitude of .0062 comes back at 20 h a wavelength, .01 is asked for.
TEST(Absorbing, NormalIncidence)
{
  for (const double left : {left_in_bar<1>(), left_in_bar<2>(), left_in_bar<3>()})
  {
    std::printf("amplitude that comes back: %.4f\n", std::sqrt(left));
    EXPECT_LT(left, 1e-4);
    EXPECT_GT(left, 1e-6); // the impedances of mesh and dashpot differ
  }
}
} // namespace
