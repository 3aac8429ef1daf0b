// SPDX-License-Identifier: LGPL-2.1-or-later
// Conservation, restart, failure and the step bound of the solver.
#include "core/io/memory_archive.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <random>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
template <int dim>
void expect_conservation(bool axisymmetric, const std::string &hourglass, const std::string &element = "one-point",
                         int degree = 1)
{
  Parameters p;
  p.options.hourglass = hourglass;
  auto solver = solver_of<dim>(wild_block<dim>(make(copper()), axisymmetric, 40, .2, element, degree), p);
  Driver<dim>  driver{*solver};
  const Balance b0 = solver->balance();
  double        previous = closed(b0);
  for (int k = 0; k < 200; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    const double now = closed(solver->balance());
    ASSERT_NEAR(now / previous, 1, 1e-12) << "step " << k;
    previous = now;
  }
  const Balance b = solver->balance();
  EXPECT_NEAR(previous / closed(b0), 1, 1e-12);
  EXPECT_LT(b.kinetic, .9 * b0.kinetic); // it did work
  EXPECT_GT(b.bulk_viscosity_heat, 0);
  if (dim > 1 && element == "one-point")
    EXPECT_GT(b.hourglass_fem, 0);
  const double scale = b0.mass * 40;
  for (int i = axisymmetric ? 1 : 0; i < dim; ++i)
    EXPECT_NEAR((b.momentum[i] - b0.momentum[i]) / scale, 0, 1e-13);
}
TEST(Conservation, Line) { expect_conservation<1>(false, "stiffness"); }
TEST(Conservation, PlaneStrain) { expect_conservation<2>(false, "stiffness"); }
TEST(Conservation, Axisymmetric) { expect_conservation<2>(true, "stiffness"); }
TEST(Conservation, Hex) { expect_conservation<3>(false, "stiffness"); }
TEST(Conservation, HexViscousHourglass) { expect_conservation<3>(false, "viscous"); }
TEST(Conservation, BBarPlaneStrain) { expect_conservation<2>(false, "stiffness", "b-bar"); }
TEST(Conservation, BBarAxisymmetric) { expect_conservation<2>(true, "stiffness", "b-bar"); }
TEST(Conservation, BBarHex) { expect_conservation<3>(false, "stiffness", "b-bar"); }
TEST(Conservation, FullAxisymmetric) { expect_conservation<2>(true, "stiffness", "full"); }
TEST(Conservation, FullHex) { expect_conservation<3>(false, "stiffness", "full"); }
TEST(Conservation, SpectralLine) { expect_conservation<1>(false, "stiffness", "spectral", 4); }
TEST(Conservation, SpectralPlaneStrain) { expect_conservation<2>(false, "stiffness", "spectral", 3); }
TEST(Conservation, SpectralHex) { expect_conservation<3>(false, "stiffness", "spectral", 2); }

// x_{n+1} x v_{n+1/2} = x_n x v_{n+1/2}: exact after the first step.
void expect_angular_momentum(const std::string &element, int degree, int steps)
{
  auto mesh = wild_block<3>(make(copper()), false, 0, .2, element, degree);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const Vec3 x(mesh.x[0][a], mesh.x[1][a], mesh.x[2][a]);
    const Vec3 v = Vec3(2e4, -3e4, 1e4).cross(x - Vec3(2e-3, 4e-3, 0));
    for (int i = 0; i < 3; ++i)
      mesh.v[i][a] = v[i];
  }
  auto      solver = solver_of<3>(std::move(mesh));
  Driver<3> driver{*solver};
  ASSERT_TRUE(driver.once().ok);
  const Vec3 L0 = solver->balance().angular_momentum;
  for (int k = 0; k < steps; ++k)
    ASSERT_TRUE(driver.once().ok);
  EXPECT_NEAR((solver->balance().angular_momentum - L0).norm() / L0.norm(), 0, 1e-12);
}
TEST(Conservation, AngularMomentumOfASpinningBlock) { expect_angular_momentum("one-point", 1, 2000); }
TEST(Conservation, AngularMomentumOfASpinningBlockBBar) { expect_angular_momentum("b-bar", 1, 1000); }
TEST(Conservation, AngularMomentumOfASpinningBlockSpectral) { expect_angular_momentum("spectral", 3, 500); }

// Patch test: an affine velocity on a distorted mesh gives every element the
// same stress, and the net force on inner nodes is zero. The first step moves
// the nodes freely (no forces yet), so x stays affine.
template <int dim>
void expect_patch(bool axisymmetric, const std::string &element = "one-point", int degree = 1)
{
  auto mesh = wild_block<dim>(make(copper()), axisymmetric, 0, .2, element, degree);
  const double g[3][3] = {{900, 400, -300}, {-200, -700, 500}, {100, -600, 800}};
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    for (int i = 0; i < dim; ++i)
    {
      mesh.v[i][a] = 0;
      for (int j = 0; j < dim; ++j)
        if (!axisymmetric || i == j) // u_r = a r, u_z = b z: uniform also in the hoop direction
          mesh.v[i][a] += g[i][j] * mesh.x[j][a];
    }
  auto solver = solver_of<dim>(std::move(mesh));
  ASSERT_TRUE(solver->step({0, 1e-9, 1e-5}).ok); // strains of about a per cent
  const Sample s = solver->sample(0);
  // Slopes of higher polynomials magnify rounding: the largest of degree 4 is 5.
  const double tolerance = degree * 1e-12 * 117e9 * 1e-2;
  for (int c = 0; c < 6; ++c)
    for (const double stress : s.sigma[c])
      EXPECT_NEAR(stress, s.sigma[c][0], tolerance);
  EXPECT_GT(std::abs(s.sigma[0][0]), 1e5);
}
TEST(Patch, Line) { expect_patch<1>(false); }
TEST(Patch, PlaneStrain) { expect_patch<2>(false); }
TEST(Patch, Axisymmetric) { expect_patch<2>(true); }
TEST(Patch, Hex) { expect_patch<3>(false); }
TEST(Patch, BBarPlaneStrain) { expect_patch<2>(false, "b-bar"); }
TEST(Patch, BBarAxisymmetric) { expect_patch<2>(true, "b-bar"); }
TEST(Patch, BBarHex) { expect_patch<3>(false, "b-bar"); }
TEST(Patch, FullHex) { expect_patch<3>(false, "full"); }
TEST(Patch, SpectralLine) { expect_patch<1>(false, "spectral", 2); }
TEST(Patch, SpectralPlaneStrain) { expect_patch<2>(false, "spectral", 4); }
TEST(Patch, SpectralHex) { expect_patch<3>(false, "spectral", 3); }

// A rigid turn strains nothing: chords of a turn by .3 rad in one step leave less
// than 1e-10 of E (numerics: exact for any affine motion).
template <int dim>
void expect_no_stress_from_a_turn(const std::string &element, int degree = 1)
{
  auto         mesh = wild_block<dim>(make(copper()), false, 0, .2, element, degree);
  const double dt   = 1e-6;
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(.3, dim == 3 ? Vec3(1, 2, -2).normalized() : Vec3(Vec3::UnitZ())).toRotationMatrix();
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    Vec3 x = Vec3::Zero();
    for (int i = 0; i < dim; ++i)
      x[i] = mesh.x[i][a];
    const Vec3 v = (turn * x - x) / dt;
    for (int i = 0; i < dim; ++i)
      mesh.v[i][a] = v[i];
  }
  auto solver = solver_of<dim>(std::move(mesh));
  ASSERT_TRUE(solver->step({0, 1e-12, dt}).ok);
  const Sample s = solver->sample(0);
  for (const auto &component : s.sigma)
    for (const double stress : component)
      EXPECT_LT(std::abs(stress), 1e-10 * 117e9);
}
TEST(RigidTurn, OnePoint)
{
  expect_no_stress_from_a_turn<2>("one-point");
  expect_no_stress_from_a_turn<3>("one-point");
}
TEST(RigidTurn, BBarAndFull)
{
  for (const char *element : {"b-bar", "full"})
  {
    expect_no_stress_from_a_turn<2>(element);
    expect_no_stress_from_a_turn<3>(element);
  }
}
TEST(RigidTurn, Spectral)
{
  expect_no_stress_from_a_turn<2>("spectral", 4);
  expect_no_stress_from_a_turn<3>("spectral", 3);
}

// Half the run, save, load into a fresh solver, the other half: the same bits.
TEST(State, RestartAndRestoreAreBitwise)
{
  const auto metal  = make(copper_linear_hardening());
  auto       first  = solver_of<3>(wild_block<3>(metal));
  auto       second = solver_of<3>(wild_block<3>(metal));
  Driver<3>  a{*first};
  for (int k = 0; k < 30; ++k)
    ASSERT_TRUE(a.once().ok);
  io::MemoryArchive archive;
  first->save(archive, "fem");
  first->snapshot();
  const double time = a.time, last = a.last;
  for (int k = 0; k < 30; ++k)
    ASSERT_TRUE(a.once().ok);
  const Sample end = first->sample(0);

  second->load(archive, "fem");
  Driver<3> b{*second, time, last};
  first->restore();
  Driver<3> c{*first, time, last};
  for (int k = 0; k < 30; ++k)
  {
    ASSERT_TRUE(b.once().ok);
    ASSERT_TRUE(c.once().ok);
  }
  for (const auto *solver : {first.get(), second.get()})
  {
    const Sample s = solver->sample(0);
    EXPECT_EQ(s.x, end.x);
    EXPECT_EQ(s.v, end.v);
    EXPECT_EQ(s.sigma, end.sigma);
    EXPECT_EQ(s.energy, end.energy);
  }
}

TEST(State, InvertedElementIsNamed)
{
  auto mesh    = wild_block<3>(make(copper()), false, 0);
  mesh.v[0][0] = 2e5;
  auto             solver = solver_of<3>(std::move(mesh));
  const StepStatus status = solver->step({0, 1e-7, 1e-7});
  ASSERT_FALSE(status.ok);
  EXPECT_STREQ(status.culprit.entity, "element");
  EXPECT_EQ(status.culprit.id, 0);
  EXPECT_STREQ(status.culprit.why, "the element turned inside out");
}

TEST(State, NanIsNamed)
{
  auto mesh    = wild_block<2>(make(copper()), false, 0);
  mesh.v[0][3] = std::nan("");
  auto             solver = solver_of<2>(std::move(mesh));
  const StepStatus status = solver->step({0, 1e-9, 1e-9});
  ASSERT_FALSE(status.ok);
  EXPECT_STREQ(status.culprit.why, "not a number");
}

/// Highest frequency by power iteration: small displacements u, accelerations
/// from one step of the solver itself with kick only (stress after drift u).
template <int dim>
double highest_frequency(const std::function<std::unique_ptr<Solver<dim>>()> &fresh)
{
  // v -> force response: with v0 = u/dt one step of drift dt gives f(u); the next
  // kick of dt changes v by f dt/m. Linear for small u.
  auto                                   probe = fresh();
  const std::size_t                      n     = probe->surface().n;
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double                           scale = 1e-10; // m: strains of 1e-7
  std::array<std::vector<double>, dim>   u;
  for (auto &c : u)
    for (std::size_t a = 0; a < n; ++a)
      c.push_back(uniform(random));
  probe->snapshot();
  double w2 = 0;
  for (int k = 0; k < 300; ++k)
  {
    double size = 0;
    for (const auto &c : u)
      for (const double x : c)
        size += x * x;
    size = std::sqrt(size);
    probe->restore();
    const double dt = 1e-9;
    auto         s  = probe->surface();
    // A coupling force in the first step sets v = u/dt exactly.
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < n; ++a)
        s.force[i][a] = s.mass[a] * scale * u[i][a] / size / dt / dt;
    probe->step({0, dt, dt});
    std::array<std::vector<double>, dim> v;
    s = probe->surface();
    for (int i = 0; i < dim; ++i)
      v[i].assign(s.v[i].begin(), s.v[i].end());
    probe->step({dt, dt, dt});
    s       = probe->surface();
    double norm = 0;
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < n; ++a)
      {
        u[i][a] = -(s.v[i][a] - v[i][a]) / dt / scale;
        norm += u[i][a] * u[i][a];
      }
    w2 = std::sqrt(norm);
  }
  return std::sqrt(w2);
}

template <int dim>
void expect_step_bound(double distortion, bool axisymmetric, double sharpness,
                       const std::string &element = "one-point", int degree = 1)
{
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  p.options.step_factor                            = 1;
  const auto metal = make(copper());
  const auto fresh = [&] { return solver_of<dim>(wild_block<dim>(metal, axisymmetric, 0, distortion, element, degree), p); };
  const double critical = 2 / highest_frequency<dim>(fresh);
  const double bound    = fresh()->stable_dt().dt;
  EXPECT_LE(bound, critical * 1.001);
  // The solver's own power iteration, by another way: the elements' tangent.
  if (element != "area-weighted") // whose operator is not symmetric
    EXPECT_NEAR(fresh()->critical_dt().dt / critical, 1, 5e-3);
  EXPECT_GE(bound, sharpness * critical);
  // The operator's own limit: .95 holds, 1.05 blows up.
  for (const double factor : {.95, 1.05})
  {
    auto s     = solver_of<dim>(wild_block<dim>(metal, axisymmetric, 1e-6, distortion, element, degree), p);
    Driver<dim> driver{*s};
    driver.fixed_dt = factor * critical;
    const double k0 = s->balance().kinetic;
    bool         ok = true;
    for (int k = 0; k < 1500 && ok; ++k)
      ok = driver.once().ok && s->balance().kinetic < 1e6 * k0;
    EXPECT_EQ(ok, factor < 1) << "factor " << factor;
  }
}
TEST(StepBound, Line) { expect_step_bound<1>(.2, false, .75); }
TEST(StepBound, PlaneStrain) { expect_step_bound<2>(.2, false, .6); }
TEST(StepBound, Axisymmetric) { expect_step_bound<2>(.2, true, .5); }
TEST(StepBound, Hex) { expect_step_bound<3>(.25, false, .5); }
// The operator of area-weighted rings is not symmetric and has frequencies that
// are not real: undamped noise grows, by the operator and not by the step, since
// half the step changes nothing (docs/numerics.md, known limits).
TEST(StepBound, AreaWeightedNoiseGrowsWhateverTheStep)
{
  const auto doubling_time = [](double factor) {
    Parameters p;
    p.options.bulk_linear = p.options.bulk_quadratic = 0;
    p.options.step_factor                            = factor;
    auto         s = solver_of<2>(wild_block<2>(make(copper()), true, 1e-6, .1, "area-weighted"), p);
    Driver<2>    driver{*s};
    const double k0 = s->balance().kinetic;
    while (s->balance().kinetic < 1e3 * k0)
      EXPECT_TRUE(driver.once().ok);
    return driver.time / std::log2(1e3);
  };
  const double whole = doubling_time(.9), half = doubling_time(.45);
  EXPECT_NEAR(half / whole, 1, .2);
  // one-point rings with the weight of the ring keep their noise as it is
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  auto         s = solver_of<2>(wild_block<2>(make(copper()), true, 1e-6, .1), p);
  Driver<2>    driver{*s};
  const double k0 = s->balance().kinetic;
  ASSERT_TRUE(driver.until(10 * whole * std::log2(1e3)).ok);
  EXPECT_LT(s->balance().kinetic, 2 * k0);
}
TEST(StepBound, BBarPlaneStrain) { expect_step_bound<2>(.2, false, .5, "b-bar"); }
TEST(StepBound, BBarAxisymmetric) { expect_step_bound<2>(.2, true, .45, "b-bar"); }
TEST(StepBound, BBarHex) { expect_step_bound<3>(.25, false, .5, "b-bar"); }
TEST(StepBound, FullHex) { expect_step_bound<3>(.25, false, .3, "full"); }
TEST(StepBound, SpectralLine) { expect_step_bound<1>(.2, false, .6, "spectral", 4); }
TEST(StepBound, SpectralPlaneStrain) { expect_step_bound<2>(.2, false, .4, "spectral", 3); }
TEST(StepBound, SpectralHex) { expect_step_bound<3>(.2, false, .3, "spectral", 2); }
} // namespace
