// SPDX-License-Identifier: LGPL-2.1-or-later
// What the outside does to a mesh: motion and loads in time, dashpots, tilted walls.
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;
using input::BoundaryKind;

namespace
{
constexpr double h = 1e-3, step = .1e-6; // m; s, below every bound here

const input::History ramp{{0, 2e-6, 5e-6}, {0, 1, .5}};

template <int dim>
BodyMesh<dim> small_block(bool axisymmetric = false)
{
  return block<dim>({axisymmetric ? 0 : 1e-3, 2e-3, 0}, {axisymmetric ? 3e-3 : 4e-3, 5e-3, 2e-3}, h,
                    axisymmetric);
}

// The node moves at v times the history at the middle of each step: exact.
TEST(History, DrivesAVelocity)
{
  Parameters p;
  p.boundaries             = {boundary("y-", BoundaryKind::velocity)};
  p.boundaries[0].velocity = {3, -20, 0};
  p.boundaries[0].history  = ramp;
  auto      solver         = solver_with(small_block<2>(), p);
  Driver<2> driver{*solver};
  driver.fixed_dt   = step;
  const double e0   = closed(solver->balance());
  double       path = 0;
  for (int k = 0; k < 80; ++k)
  {
    const double middle = driver.time + .5 * step;
    ASSERT_TRUE(driver.once().ok);
    path += -20 * ramp.at(middle) * step;
    const Sample s = solver->sample(0);
    EXPECT_NEAR(s.v[1][0], -20 * ramp.at(middle), 1e-12);
    EXPECT_NEAR(s.x[1][0] - s.x0[1][0], path, 1e-15);
  }
  const Balance b = solver->balance();
  EXPECT_NEAR((closed(b) - e0) / b.external_work, 0, 1e-12);
}

// After any number of steps of any length the node stands at x0 + u(t).
TEST(History, LandsADisplacement)
{
  Parameters p;
  p.boundaries                 = {boundary("z+", BoundaryKind::displacement)};
  p.boundaries[0].displacement = {0, 1e-5, -2e-5};
  p.boundaries[0].history      = ramp;
  auto         solver          = solver_with(small_block<3>(), p);
  Driver<3>    driver{*solver};
  const double e0 = closed(solver->balance());
  for (int k = 0; k < 300; ++k)
  {
    driver.fixed_dt = (k % 3 ? .6 : .11) * step;
    ASSERT_TRUE(driver.once().ok);
  }
  const Sample s    = solver->sample(0);
  int          held = 0;
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    if (s.x0[2][a] == 2e-3)
    {
      ++held;
      EXPECT_NEAR(s.x[0][a], s.x0[0][a], 1e-17);
      EXPECT_NEAR(s.x[1][a] - s.x0[1][a], 1e-5 * ramp.at(driver.time), 1e-17);
      EXPECT_NEAR(s.x[2][a] - s.x0[2][a], -2e-5 * ramp.at(driver.time), 1e-17);
    }
  EXPECT_EQ(held, 16);
  const Balance b = solver->balance();
  EXPECT_NEAR((closed(b) - e0) / b.external_work, 0, 1e-11);
}

// The impulse of a free body is area times the integral of the pressure; the
// sum over kicks is the trapezoidal rule, exact for a table whose knots fall on steps.
template <int dim>
void expect_pressed(bool axisymmetric, double area)
{
  Parameters p;
  p.boundaries             = {boundary(dim == 1 ? "x-" : "y-", BoundaryKind::pressure)};
  p.boundaries[0].pressure = 2e6;
  p.boundaries[0].history  = ramp;
  auto        solver       = solver_with(small_block<dim>(axisymmetric), p);
  Driver<dim> driver{*solver};
  driver.fixed_dt = step;
  for (int k = 0; k < 70; ++k)
    ASSERT_TRUE(driver.once().ok);
  const double  integral = .5 * 2e-6 + .75 * 3e-6 + .5 * (driver.time - .5 * step - 5e-6);
  const Balance b        = solver->balance();
  // The area changes with strains of p/E = 2e-5.
  EXPECT_NEAR(b.momentum[dim == 1 ? 0 : 1] / (2e6 * area * integral), 1, dim == 1 ? 1e-12 : 4e-5);
  EXPECT_NEAR(b.momentum[1] - b.external_impulse[1], 0, 1e-14 * 2e6 * area * integral);
  EXPECT_NEAR(closed(b) / b.external_work, 0, 1e-12);
}
TEST(History, LoadsALine)
{
  expect_pressed<1>(false, 1);
}
TEST(History, LoadsASquare)
{
  expect_pressed<2>(false, 3e-3);
}
TEST(History, LoadsARing)
{
  expect_pressed<2>(true, M_PI * 9e-6);
}
TEST(History, LoadsACube)
{
  expect_pressed<3>(false, 6e-6);
}

// A body force moves all nodes alike: v = int g dt to rounding, no strain, and
// its work is the kinetic energy.
// A uniform pressure gives the nodes of a spectral face the weights of its points:
// all of a block's face then starts alike, as nodes with the mass of those weights.
TEST(History, PressesSpectralFacesEvenly)
{
  for (const int degree : {2, 3, 4})
  {
    input::Scene scene;
    scene.fem.element = "spectral";
    scene.fem.degree  = degree;
    std::vector<BodyMesh<3>> meshes;
    meshes.push_back(make_mesh<3>(box({0, 0, 0}, {2e-3, 3e-3, 2e-3}, 1e-3), scene, 0, make(copper())));
    Parameters p;
    p.options = scene.fem;
    input::Boundary push;
    push.name     = "push";
    push.face     = "x-";
    push.kind     = input::BoundaryKind::pressure;
    push.pressure = 1e8;
    p.boundaries.push_back(push);
    p.boundary_bodies = {0};
    Solver<3>    solver(p, std::move(meshes));
    const double dt = 1e-10;
    ASSERT_TRUE(solver.step({0, dt, dt}).ok);
    const Sample s = solver.sample(0);
    for (std::size_t a = 0; a < s.mass.size(); ++a)
      if (s.x0[0][a] == 0)
        // p A over the mass of a layer: p dt/(rho w_0 h/2), w_0 of the first point
        EXPECT_NEAR(s.v[0][a] * 8930 * .5e-3 * (degree == 2 ? 1. / 3 : degree == 3 ? 1. / 6 : .1) / (1e8 * dt), 1, 1e-9);
  }
}

template <int dim>
void expect_fall(bool axisymmetric)
{
  Parameters p;
  p.boundaries                 = {boundary("", BoundaryKind::body_force)};
  p.boundaries[0].acceleration = {axisymmetric ? 0. : 3e5, dim > 1 ? -1e7 : 0, dim > 2 ? 5e4 : 0};
  p.boundaries[0].history      = ramp;
  auto mesh                    = small_block<dim>(axisymmetric);
  shake(mesh, .2 * h, 0);
  auto        solver = solver_with(std::move(mesh), p);
  Driver<dim> driver{*solver};
  driver.fixed_dt = .5 * step;
  for (int k = 0; k < 140; ++k)
    ASSERT_TRUE(driver.once().ok);
  const double integral = .5 * 2e-6 + .75 * 3e-6 + .5 * (driver.time - .25 * step - 5e-6);
  const Sample s        = solver->sample(0);
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    for (int i = 0; i < dim; ++i)
      EXPECT_NEAR(s.v[i][a], p.boundaries[0].acceleration[i] * integral, 1e-10 * 1e7 * integral);
  const Balance b = solver->balance();
  EXPECT_NEAR(b.kinetic / b.external_work, 1, 1e-10);
  EXPECT_NEAR((b.momentum - b.external_impulse).norm() / b.momentum.norm(), 0, 1e-12);
}
TEST(BodyForce, Line)
{
  expect_fall<1>(false);
}
TEST(BodyForce, PlaneStrain)
{
  expect_fall<2>(false);
}
TEST(BodyForce, Axisymmetric)
{
  expect_fall<2>(true);
}
TEST(BodyForce, Hex)
{
  expect_fall<3>(false);
}

// Dashpots all round a shaken block: energy and momentum are booked to rounding
// at every step, and 3000 steps at .98 of the bound of the elements leave it calm.
template <int dim>
void expect_absorbed(bool axisymmetric)
{
  Parameters p;
  p.boundaries          = {boundary("all", BoundaryKind::absorbing)};
  p.options.step_factor = .98;
  auto mesh             = small_block<dim>(axisymmetric);
  shake(mesh, .2 * h, 5);
  auto          solver = solver_with(std::move(mesh), p);
  const Balance b0     = solver->balance();
  const Books   worst  = books_over(*solver, 200);
  EXPECT_LT(worst.energy, 1e-12 * b0.kinetic);
  EXPECT_LT(worst.momentum, 1e-13 * b0.mass * 5 * 200);
  Driver<dim> driver{*solver};
  double      before = solver->balance().absorbed;
  for (int k = 0; k < 3000; ++k)
  {
    ASSERT_TRUE(driver.once().ok);
    const double now = solver->balance().absorbed;
    ASSERT_GE(now, before);
    before = now;
  }
  const Balance b = solver->balance();
  EXPECT_LT(b.kinetic, 1e-6 * b0.kinetic);
  EXPECT_GT(b.absorbed, .3 * b0.kinetic); // the rest is bulk viscosity's and hourglass control's
}
TEST(Absorbing, Line)
{
  expect_absorbed<1>(false);
}
TEST(Absorbing, PlaneStrain)
{
  expect_absorbed<2>(false);
}
TEST(Absorbing, Axisymmetric)
{
  expect_absorbed<2>(true);
}
TEST(Absorbing, Hex)
{
  expect_absorbed<3>(false);
}

// A face may be both held along its plane and absorbing.
TEST(Absorbing, LeavesHeldComponentsAlone)
{
  Parameters p;
  p.boundaries           = {boundary("x+", BoundaryKind::absorbing), boundary("x+", BoundaryKind::fixed)};
  p.boundaries[1].fix[0] = false;
  auto mesh              = small_block<2>();
  shake(mesh, 0, 5);
  auto          solver = solver_with(std::move(mesh), p);
  const Balance b0     = solver->balance();
  const Books   worst  = books_over(*solver, 100);
  EXPECT_LT(worst.energy, 1e-12 * b0.kinetic);
  const Sample s = solver->sample(0);
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    if (s.x0[0][a] == 4e-3)
    {
      EXPECT_EQ(s.v[1][a], 0);
    }
}

Eigen::Matrix3d turn(int dim)
{
  Eigen::Matrix3d Q = Eigen::AngleAxisd(.7, Vec3::UnitZ()).toRotationMatrix();
  return dim == 3 ? Eigen::Matrix3d(Q * Eigen::AngleAxisd(-.4, Vec3(1, 2, 0).normalized())) : Q;
}

/// A block strikes a wall with friction; all of it turned by Q.
template <int dim>
std::unique_ptr<Solver<dim>> drop(const Eigen::Matrix3d &Q, double friction, double slip)
{
  Parameters p;
  p.walls   = {{"wall", Q * Vec3(0, 2e-3, 0), Q * Vec3::UnitY(), Q * Vec3(4, 0, 0), friction}};
  auto mesh = small_block<dim>();
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    Vec3 x = Vec3::Zero(), v(slip, -30, dim == 3 ? -.5 * slip : 0);
    for (int i = 0; i < dim; ++i)
      x[i] = mesh.x[i][a];
    x = Q * x;
    v = Q * v;
    for (int i = 0; i < dim; ++i)
    {
      mesh.x[i][a] = x[i];
      mesh.v[i][a] = v[i];
    }
  }
  return solver_with(std::move(mesh), p);
}

// The same drop in a turned frame is the same to rounding.
template <int dim>
void expect_frame_independent()
{
  const Eigen::Matrix3d Q = turn(dim);
  auto        straight = drop<dim>(Eigen::Matrix3d::Identity(), .3, 20), tilted = drop<dim>(Q, .3, 20);
  Driver<dim> a{*straight}, b{*tilted};
  a.fixed_dt = b.fixed_dt = step;
  for (int k = 0; k < 40; ++k)
  {
    ASSERT_TRUE(a.once().ok);
    ASSERT_TRUE(b.once().ok);
    EXPECT_NEAR(straight->wall_force(0), tilted->wall_force(0), 1e-9 * (1 + straight->wall_force(0)));
  }
  const Sample s = straight->sample(0), t = tilted->sample(0);
  for (std::size_t n = 0; n < s.mass.size(); ++n)
  {
    const Vec3 v = Q * Vec3(s.v[0][n], s.v[1][n], s.v[2][n]);
    for (int i = 0; i < dim; ++i)
      EXPECT_NEAR(t.v[i][n], v[i], 1e-10 * 30);
  }
  EXPECT_NEAR(straight->balance().friction_heat / tilted->balance().friction_heat, 1, 1e-11);
  EXPECT_GT(straight->balance().friction_heat, .01 * straight->balance().kinetic);
}
TEST(TiltedWall, PlaneStrain)
{
  expect_frame_independent<2>();
}
TEST(TiltedWall, Hex)
{
  expect_frame_independent<3>();
}

// While every node on the wall slips the same way, the impulse along it is the
// coefficient times the impulse across it.
TEST(TiltedWall, CoulombsRatioIsExact)
{
  const double mu     = .3;
  const auto   Q      = turn(2);
  auto         solver = drop<2>(Q, mu, 400);
  Driver<2>    driver{*solver};
  for (int k = 0; k < 30; ++k)
    ASSERT_TRUE(driver.once().ok);
  const Vec3 impulse = Q.transpose() * solver->balance().external_impulse;
  EXPECT_GT(impulse.y(), 0);
  EXPECT_NEAR(impulse.x() / impulse.y(), -mu, 1e-12);
}
} // namespace
