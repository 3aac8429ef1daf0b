// SPDX-License-Identifier: LGPL-2.1-or-later
// What a wave loses where the mesh jumps from h to 2 h, by hanging nodes and by a
// tie, against the exact jump of impedance Z = rho c cos(k h/2) (validation.md, E1).
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
constexpr double h = 1e-3, c = 4585.60; // m; m/s, copper

enum class Join
{
  hanging,
  tied,    ///< nested: two fine edges on a coarse one
  shifted, ///< three fine edges on two coarse ones of 1.5 h
};

input::Body strip(double from, double to, double edge)
{
  return box({from, 0, 0}, {to, 12 * h, 12 * h}, edge);
}

template <int dim>
std::vector<BodyMesh<dim>> meshes_of(Join join, double left, double right)
{
  input::Scene scene;
  scene.dimension = dimension_of(dim, false);
  std::vector<BodyMesh<dim>> meshes;
  const auto                 metal = make(copper());
  if (join == Join::hanging)
  {
    input::Body body      = strip(-left, right, h);
    body.coarsen          = 1;
    body.coarsen_distance = left;
    body.coarsen_from     = {-left, 0, 0};
    body.coarsen_along    = {0, 1, 0};
    meshes.push_back(make_mesh<dim>(body, scene, 0, metal));
    return meshes;
  }
  const double coarse = join == Join::tied ? 2 * h : 1.5 * h;
  meshes.push_back(make_mesh<dim>(strip(0, right, coarse), scene, 0, metal));
  meshes.push_back(make_mesh<dim>(strip(-left, 0, h), scene, 1, metal));
  return meshes;
}

/// Amplitude reflected at x = 0 of a packet of this wavelength coming from the
/// fine side, over the incident one; waves of uniaxial strain.
template <int dim>
double reflected(Join join, double elements)
{
  const double wave = elements * h, sigma = 2.5 * wave;
  const double left = 6 * h * std::ceil(14 * sigma / (6 * h)), right = 6 * h * std::ceil(8 * sigma / (6 * h));
  auto         meshes = meshes_of<dim>(join, left, right);
  Parameters   p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  for (std::size_t body = 0; body < meshes.size(); ++body)
    for (const char *face : {"y-", "y+", "z-", "z+"})
      if (face[0] - 'x' < dim)
      {
        p.boundaries.push_back(boundary(face, input::BoundaryKind::fixed));
        p.boundaries.back().fix[0] = false;
        p.boundary_bodies.push_back(static_cast<int>(body));
      }
  if (meshes.size() > 1)
    p.ties = {{"seam", 1, 0, .1}};
  for (auto &mesh : meshes)
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    {
      const double s = mesh.x[0][a] + 4 * sigma;
      mesh.v[0][a]   = 1e-3 * std::exp(-.5 * s * s / (sigma * sigma)) * std::sin(2 * M_PI * s / wave);
    }
  auto         solver = solver_with<dim>(std::move(meshes), p);
  const double before = solver->balance().kinetic; // of two packets, half of each in motion later on
  Driver<dim>  driver{*solver};
  EXPECT_TRUE(driver.until(8 * sigma / c).ok);
  const auto   s         = solver->surface();
  double       back      = 0;
  const int    fine_body = join == Join::hanging ? 0 : 1;
  const Sample now       = solver->sample(fine_body);
  for (std::size_t a = 0; a < now.mass.size(); ++a)
    if (now.x0[0][a] > -8 * sigma && now.x0[0][a] < 0)
      for (int i = 0; i < dim; ++i)
        back += .5 * now.mass[a] * now.v[i][a] * now.v[i][a];
  return std::sqrt(back / (.25 * before));
}

/// |Z1 - Z2|/(Z1 + Z2) of lumped linear meshes with one frequency.
double exact(double elements, double ratio)
{
  const double half = M_PI / elements; // k1 h1/2; sin(k2 h2/2) = ratio sin(k1 h1/2)
  const double z1 = std::cos(half), z2 = std::sqrt(1 - std::pow(ratio * std::sin(half), 2));
  return (z1 - z2) / (z1 + z2);
}

// The table of E1.
TEST(Jump, ClosedForm)
{
  const double elements[] = {40, 20, 15, 12, 10}, table[] = {.0047, .0196, .0364, .0606, .0949};
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(exact(elements[k], 2), table[k], 5e-5);
}

template <int dim>
void expect_jump(Join join, const char *name, double ratio)
{
  for (const double elements : {20., 12.})
  {
    const double r = reflected<dim>(join, elements);
    std::printf("%s, %d-D, %g elements a wavelength: %.4f, exact %.4f\n", name, dim, elements, r,
                exact(elements, ratio));
    // The packet's spectrum is 1/(sqrt(2) 2.5 2 pi) = 4.5 % wide; R grows as k^2, so
    // its mean over the energy is 1 % above that of the middle.
    EXPECT_NEAR(r / exact(elements, ratio), 1, .05);
  }
}
TEST(Jump, HangingLine)
{
  expect_jump<1>(Join::hanging, "one mesh", 2);
}
TEST(Jump, HangingPlaneStrain)
{
  expect_jump<2>(Join::hanging, "hanging nodes", 2);
}
TEST(Jump, TiedLine)
{
  expect_jump<1>(Join::tied, "tied 2:1", 2);
}
TEST(Jump, TiedPlaneStrain)
{
  expect_jump<2>(Join::tied, "tied 2:1", 2);
}

// Meshes that are not nested: the uneven pull of a uniform traction at the masters
// (tests/unit/fem/tie_test.cc) scatters more than the jump itself. It fades with
// finer meshes, at least as their edge.
TEST(Jump, ShiftedPlaneStrain)
{
  const double coarse = reflected<2>(Join::shifted, 20), fine = reflected<2>(Join::shifted, 40);
  std::printf(
      "tied 3:2, 2-D, 20 and 40 elements a wavelength: %.4f %.4f; nested meshes would reflect %.4f %.4f\n",
      coarse, fine, exact(20, 1.5), exact(40, 1.5));
  EXPECT_LT(fine, .5 * coarse);
  EXPECT_GT(coarse, exact(20, 1.5));
}
} // namespace
