// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/memory_archive.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ogive::fem
{
namespace
{
using test::Driver;

template <int dim>
std::unique_ptr<Solver<dim>> solver_of(BodyMesh<dim> mesh)
{
  Parameters p;
  p.axisymmetric = mesh.axisymmetric;
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(std::move(mesh));
  return std::make_unique<Solver<dim>>(p, std::move(meshes));
}

/// A shaken, flying, spinning block that is drawn more and more towards one end:
/// its elements die one after the other, at a plastic strain of 4 %.
template <int dim>
std::unique_ptr<Solver<dim>> drawn_block(bool axisymmetric)
{
  const double h = 1e-3;
  input::Scene scene;
  scene.dimension = axisymmetric ? input::Dimension::axisymmetric :
                    dim == 1     ? input::Dimension::uniaxial :
                    dim == 2     ? input::Dimension::plane_strain :
                                   input::Dimension::three_d;
  const double corner = axisymmetric ? 0 : 2e-3;
  input::Body  body   = test::box({corner, 1e-3, -1e-3}, {corner + 3 * h, 1e-3 + 7 * h, -1e-3 + 3 * h}, h);
  body.erosion.on     = true;
  body.erosion.strain = dim == 1 ? .01 : .04; // a bar has fewer ways to flow
  auto mesh = make_mesh<dim>(body, scene, 0, test::make(test::copper_linear_hardening()));
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const int                              up = dim > 1 ? 1 : 0;
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const double t = (mesh.x[up][a] - 1e-3) / (7 * h);
    for (int i = 0; i < dim; ++i)
      mesh.v[i][a] = (axisymmetric && i == 0 ? 0. : 20. * (i + 1) + 3 * u(random)) + (i == up ? 400 * t * t : 0);
    if (!axisymmetric && dim > 1)
      mesh.v[0][a] -= 3e3 * mesh.x[1][a]; // spin
  }
  return solver_of<dim>(std::move(mesh));
}

Vec3 whole(const Vec3 &left, const Vec3 &gone) { return left + gone; }

/// Mass, momenta and energy with what has left; 1e-12 of what there is.
template <int dim>
void expect_conservation(bool axisymmetric)
{
  auto          solver = drawn_block<dim>(axisymmetric);
  Driver<dim>   driver{*solver};
  const Balance b0   = solver->balance();
  double        died = 0, steps_with_death = 0;
  for (int k = 0; k < 400; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    const Balance b = solver->balance();
    steps_with_death += b.eroded_elements > died;
    died = b.eroded_elements;
    EXPECT_NEAR(b.mass + b.eroded_mass, b0.mass, 1e-13 * b0.mass);
    EXPECT_LE((whole(b.momentum, b.eroded_momentum) - b0.momentum).norm(), 1e-12 * b0.momentum.norm());
    EXPECT_LE((whole(b.angular_momentum, b.eroded_angular_momentum) - b0.angular_momentum).norm(),
              1e-12 * b0.angular_momentum.norm());
    EXPECT_NEAR(test::closed(b) + b.eroded_energy, b0.kinetic, 1e-12 * b0.kinetic);
  }
  EXPECT_GT(steps_with_death, dim == 1 ? 1 : 3);
  EXPECT_LT(died, static_cast<double>(solver->size()));
  EXPECT_GT(solver->balance().eroded_energy, .01 * b0.kinetic);
  testing::Test::RecordProperty("died", std::to_string(died));
}

/// Every number that a solver tells.
template <int dim>
std::vector<double> all_of(Solver<dim> &solver)
{
  const Sample        s = solver.sample(0);
  const Balance       b = solver.balance();
  std::vector<double> numbers{b.kinetic, b.elastic,       b.plastic_work, b.hourglass_fem, b.eroded_mass,
                              b.mass,    b.eroded_energy, b.momentum[0],  b.eroded_momentum[0]};
  for (const auto *field : {&s.x[0], &s.v[0], &s.mass, &s.sigma[0], &s.plastic_strain, &s.volume})
    numbers.insert(numbers.end(), field->begin(), field->end());
  const auto surface = solver.surface();
  numbers.push_back(static_cast<double>(surface.topology));
  numbers.insert(numbers.end(), surface.contact_points.begin(), surface.contact_points.end());
  for (const auto &facet : surface.facets)
    numbers.insert(numbers.end(), facet.node.begin(), facet.node.end());
  return numbers;
}

/// A bar of elastic metal, its left half flying left at `v`, its right half right.
template <int dim>
std::unique_ptr<Solver<dim>> torn_bar(int elements, double v)
{
  auto metal                   = test::copper();
  metal.damage.law             = "tension";
  metal.damage.failure_tension = 50e6;
  const double h = 1e-3, half = .5 * elements * h;
  input::Scene scene;
  scene.dimension = dim == 1 ? input::Dimension::uniaxial : input::Dimension::plane_strain;
  auto body       = test::box({-half, 0, 0}, {half, 2 * h, 0}, h);
  body.erosion.on = true;
  auto mesh       = make_mesh<dim>(body, scene, 0, test::make(metal));
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    mesh.v[0][a] = mesh.x[0][a] < 0 ? -v : v;
  return solver_of<dim>(std::move(mesh));
}

/// Momentum of the nodes left (side -1) or right (1) of the middle, N s.
double momentum_of(const Sample &s, double side)
{
  double sum = 0;
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    sum += side * s.x[0][a] > 0 ? s.mass[a] * s.v[0][a] : 0;
  return sum;
}

/// The middle element fails in the first step that strains it beyond 50 MPa mean
/// tension and with it all that joins the halves; nothing pulls them any more.
template <int dim>
void expect_halves_fly_apart()
{
  const int    elements = 41;
  const double v = 10, h = 1e-3;
  auto         bar = torn_bar<dim>(elements, v);
  Driver<dim>  driver{*bar};
  const double facets = static_cast<double>(bar->surface().facets.size());
  const double mass   = bar->balance().mass;
  const double c      = std::sqrt((117e9 / (3 * .3) + 4. / 3 * 117e9 / 2.7) / 8930);
  while (bar->balance().eroded_elements == 0)
    ASSERT_TRUE(driver.once(2 * h / c).ok) << "no element died within two of its periods";
  const double across = dim == 1 ? 1 : 2; // elements across the bar
  ASSERT_EQ(bar->balance().eroded_elements, across);
  EXPECT_NEAR(bar->balance().eroded_mass, mass / elements, 1e-12 * mass);
  EXPECT_EQ(static_cast<double>(bar->surface().facets.size()), facets + (dim == 1 ? 2 : 2 * across - 2));

  const Sample at_death = bar->sample(0);
  const double left = momentum_of(at_death, -1), right = momentum_of(at_death, 1);
  // A half has lost at most what the middle could give: its yield force for as long.
  EXPECT_GT(right, .5 * (mass - mass / elements) * (.9 * v));
  double gap = 0;
  for (int k = 0; k < 300; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    const Sample s = bar->sample(0);
    if (bar->balance().eroded_elements == across)
    {
      EXPECT_NEAR(momentum_of(s, -1), left, 1e-12 * right);
      EXPECT_NEAR(momentum_of(s, 1), right, 1e-12 * right);
    }
    double inner[2] = {-1, 1};
    for (const double x : s.x[0])
      (x < 0 ? inner[0] : inner[1]) = x < 0 ? std::max(inner[0], x) : std::min(inner[1], x);
    gap = inner[1] - inner[0];
  }
  EXPECT_GT(gap, h + 1.8 * v * driver.time);
}
} // namespace

TEST(Erosion, ConservesInOneDimension) { expect_conservation<1>(false); }
TEST(Erosion, ConservesInPlaneStrain) { expect_conservation<2>(false); }
TEST(Erosion, ConservesInAxialSymmetry) { expect_conservation<2>(true); }
TEST(Erosion, ConservesInThreeDimensions) { expect_conservation<3>(false); }

TEST(Erosion, ATornBarFliesApart)
{
  expect_halves_fly_apart<1>();
  expect_halves_fly_apart<2>();
}

TEST(Erosion, RestartAndRejectedStepAreBitwise)
{
  auto      first = drawn_block<3>(false), second = drawn_block<3>(false);
  Driver<3> a{*first};
  while (first->balance().eroded_elements < 3)
    ASSERT_TRUE(a.once().ok);
  io::MemoryArchive archive;
  first->save(archive, "fem");
  first->snapshot();
  const auto   there = all_of(*first);
  const double time = a.time, last = a.last, before = first->balance().eroded_elements;
  for (int k = 0; k < 60; ++k)
    ASSERT_TRUE(a.once().ok);
  ASSERT_GT(first->balance().eroded_elements, before);
  const auto end = all_of(*first);

  first->restore();
  EXPECT_EQ(all_of(*first), there);
  second->load(archive, "fem");
  EXPECT_EQ(all_of(*second), there);
  Driver<3> b{*second, time, last}, c{*first, time, last};
  for (int k = 0; k < 60; ++k)
  {
    ASSERT_TRUE(b.once().ok);
    ASSERT_TRUE(c.once().ok);
  }
  EXPECT_EQ(all_of(*second), end);
  EXPECT_EQ(all_of(*first), end);
}

// The last element of all takes the last mass, copies that fill up its pack too;
// what has none moves no more numbers.
TEST(Erosion, NothingIsLeftOfABodyThatDiesWhole)
{
  input::Scene scene;
  scene.dimension     = input::Dimension::three_d;
  input::Body body    = test::box({0, 0, 0}, {3e-3, 1e-3, 1e-3}, 1e-3);
  body.erosion.on     = true;
  body.erosion.strain = 1e-3;
  auto mesh           = make_mesh<3>(body, scene, 0, test::make(test::copper_linear_hardening()));
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    mesh.v[0][a] = 2e5 * mesh.x[0][a];
  auto          solver = solver_of<3>(std::move(mesh));
  const Balance b0     = solver->balance();
  Driver<3>     driver{*solver};
  driver.fixed_dt = .5 * solver->stable_dt().dt;
  for (int k = 0; k < 100; ++k)
    ASSERT_TRUE(driver.once().ok);
  const Balance b = solver->balance();
  EXPECT_EQ(b.eroded_elements, 3);
  EXPECT_EQ(b.mass, 0);
  EXPECT_EQ(b.kinetic + b.internal(), 0);
  EXPECT_NEAR(b.eroded_mass, b0.mass, 1e-15 * b0.mass);
  EXPECT_NEAR(b.eroded_energy, b0.kinetic, 1e-12 * b0.kinetic);
  EXPECT_TRUE(solver->surface().facets.empty());
  EXPECT_TRUE(solver->surface().contact_points.empty());
  EXPECT_TRUE(solver->sample(0).cells.empty());
}

// Elements of 1 mm and .5 mm: with the bound of the step between theirs only the
// small ones die, at once.
TEST(Erosion, ElementsBelowTheStepDie)
{
  input::Scene scene;
  scene.dimension   = input::Dimension::uniaxial;
  input::Body body  = test::box({0, 0, 0}, {10e-3, 0, 0}, 1e-3);
  body.erosion.on   = true;
  const double c    = std::sqrt((117e9 / (3 * .3) + 4. / 3 * 117e9 / 2.7) / 8930);
  body.erosion.step = .6e-3 / c;
  auto mesh         = make_mesh<1>(body, scene, 0, test::make(test::copper()));
  for (double &x : mesh.x[0])
    x = x > 8.5e-3 ? 8e-3 + .5 * (x - 8e-3) : x;
  auto      solver = solver_of<1>(std::move(mesh));
  Driver<1> driver{*solver};
  ASSERT_TRUE(driver.once().ok);
  EXPECT_EQ(solver->balance().eroded_elements, 2);
  EXPECT_GT(solver->stable_dt().dt, 0);
  ASSERT_TRUE(driver.once().ok);
  EXPECT_EQ(solver->balance().eroded_elements, 2);
}
} // namespace ogive::fem
