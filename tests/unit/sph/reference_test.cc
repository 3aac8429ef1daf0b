// SPDX-License-Identifier: LGPL-2.1-or-later
// The reference configuration: neighbours, kernel and volumes of t = 0.
#include "core/base/error.h"
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.7e-3;

/// Without any dissipation.
Parameters bare(double stiffness = .2)
{
  Parameters p;
  p.options.configuration = "reference";
  p.options.correction    = "none";
  p.options.alpha = p.options.beta = p.options.hourglass = 0;
  p.options.hourglass_stiffness                          = stiffness;
  return p;
}

template <int dim>
BodyParticles<dim> jittered()
{
  return box<dim>(Vec3::Zero(), spacing * (dim == 1 ? Vec3(30, 0, 0) : dim == 2 ? Vec3(11, 9, 0) : Vec3(6, 5, 5)),
                  spacing, material(1000, 9e6, 3e6), .2);
}

/// Any affine motion, surfaces and jitter included: rho is rho0/det F and a
/// stress is the same everywhere. Exact.
template <int dim>
void follows_affine_motion()
{
  using Matrix = Eigen::Matrix<double, dim, dim>;
  using Vector = Eigen::Matrix<double, dim, 1>;
  const auto p = jittered<dim>();
  Solver<dim> solver(bare(), {p});
  std::vector<std::int64_t> all(p.x.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<std::int64_t>(i);
  solver.set_slaves(all);
  Matrix f;
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b)
      f(a, b) = (a == b ? 1.35 - .4 * a : .3 * (a - b));
  const int                         steps = 40;
  const double                      dt    = 1e-6;
  std::array<std::vector<double>, dim>     v;
  std::array<std::span<const double>, dim> view;
  for (int k = 0; k < steps; ++k)
  {
    for (int a = 0; a < dim; ++a)
    {
      v[a].resize(all.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        v[a][i] = (f.row(a) - Matrix::Identity().row(a)).dot(Eigen::Map<const Vector>(p.x[i].data())) / (steps * dt);
      view[a] = v[a];
    }
    solver.drive_slaves(view);
    ASSERT_TRUE(solver.step({k * dt, dt, dt}).ok);
  }
  const Sample s = solver.sample(0);
  for (std::size_t i = 0; i < s.id.size(); ++i)
  {
    EXPECT_NEAR(s.density[i], 1000 / f.determinant(), 1e-10);
    for (int a = 0; a < dim; ++a)
      EXPECT_NEAR(s.sigma[a][i], s.sigma[a][0], 1e-12 * 9e6);
  }
  // Work of the forces in an affine motion: sum f (x) X = -V0 J sigma F^-T.
  std::array<std::vector<double>, dim> force;
  std::array<std::span<double>, dim>   forces;
  for (int a = 0; a < dim; ++a)
  {
    force[a].resize(all.size());
    forces[a] = force[a];
  }
  solver.slave_forces(forces);
  Matrix virial = Matrix::Zero(), sigma;
  double volume = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        virial(a, b) += force[a][i] * p.x[i][b];
    volume += p.mass[i] / 1000;
  }
  constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b)
      sigma(a, b) = s.sigma[component[a][b]][0];
  const Matrix expected = -volume * f.determinant() * sigma * f.inverse().transpose();
  EXPECT_LT((virial - expected).norm(), 1e-11 * expected.norm());

  // An affine motion leaves nothing for the hourglass potential.
  const Balance b = solver.balance();
  EXPECT_GT(b.elastic, 0);
  EXPECT_LT(std::abs(b.hourglass_sph), 1e-12 * b.elastic);
}

TEST(Reference, FollowsAffineMotion)
{
  follows_affine_motion<1>();
  follows_affine_motion<2>();
  follows_affine_motion<3>();
}

/// What the gradient does not see swings on a potential: whatever goes into it
/// comes out again, a thousand steps long. Exact but for the step, of which .1
/// of the bound leaves (w dt)^2/8 < 1 %.
TEST(Reference, SawToothSwingsOnThePotential)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(12, 12, 0), spacing, material(1000, 9e6, 3e6));
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    const int column = static_cast<int>(p.x[i][0] / spacing) + static_cast<int>(p.x[i][1] / spacing);
    p.v[i]           = {column % 2 ? .1 : -.1, 0};
  }
  Solver<2>    solver(bare(), {p});
  Runner<2>    run{solver};
  const double start = solver.balance().kinetic, dt = .1 * solver.stable_dt().dt;
  double       least = 1, most = 0;
  for (int k = 0; k < 1000; ++k)
  {
    ASSERT_TRUE(run.step(dt).ok);
    const double share = solver.balance().hourglass_sph / start;
    least              = std::min(least, share);
    most               = std::max(most, share);
  }
  EXPECT_GT(least, -.01);
  EXPECT_LT(most, 1.01);
  EXPECT_GT(most, .5);
}

/// A block bent and sheared far, then let go, spinning: without dissipation the
/// forces have no torque. Rounding of the sums over the turns.
TEST(Reference, HourglassStiffnessHasNoTorque)
{
  auto         p = box<2>(Vec3::Zero(), spacing * Vec3(14, 5, 0), spacing, material(1000, 9e6, 3e6), .2);
  const double length = 14 * spacing;
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    const double x = p.x[i][0] / length - .5, y = p.x[i][1] / length;
    p.v[i] = {-25 * y, 25 * x + 30 * (x * x - .1)};
  }
  Solver<2>     solver(bare(1), {p});
  Runner<2>     run{solver};
  const Balance start = solver.balance();
  double        worst = 0, hourglass = 0;
  for (int k = 0; k < 3000; ++k)
  {
    ASSERT_TRUE(run.step().ok);
    const Balance b = solver.balance();
    worst           = std::max(worst, (b.angular_momentum - start.angular_momentum).norm());
    hourglass       = std::max(hourglass, b.hourglass_sph);
  }
  EXPECT_LT(worst, 1e-11 * start.angular_momentum.norm());
  EXPECT_GT(hourglass, 1e-3 * start.kinetic); // it was at work
}

/// Walls have no images there; what lands is in the books all the same.
TEST(Reference, BlockReboundsFromAWall)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(12, 10, 0), spacing, material(1000, 9e6, 3e6));
  for (auto &v : p.v)
    v = {.5, -3};
  Parameters q;
  q.options.configuration = "reference";
  q.walls.push_back({"floor", Vec3(0, -.2 * spacing, 0), Vec3::UnitY(), Vec3(0, .5, 0), .3});
  Solver<2>   solver(q, {p});
  Runner<2>   run{solver};
  const auto  total = [](const Balance &b) {
    return b.kinetic + b.internal() + b.wall_loss + b.friction_heat - b.external_work;
  };
  const Balance start = solver.balance();
  for (int k = 0; k < 1500; ++k)
  {
    const StepStatus status = run.step();
    ASSERT_TRUE(status.ok) << status.culprit.why;
  }
  const Balance end = solver.balance();
  EXPECT_NEAR(total(end), total(start), 1e-12 * total(start));
  EXPECT_LT((end.momentum - start.momentum - end.external_impulse).norm(), 1e-12 * start.momentum.norm());
  EXPECT_GT(end.momentum[1], .3 * std::abs(start.momentum[1]));
  EXPECT_GT(end.friction_heat, 0);
}

/// Back to a snapshot and on gives what it gave.
TEST(Reference, GoesBackToASnapshot)
{
  auto p = jittered<2>();
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i] = {-400 * p.x[i][0], 900 * p.x[i][0]};
  Parameters q;
  q.options.configuration = "reference";
  Solver<2>  solver(q, {p});
  Runner<2>  run{solver};
  const auto advance = [&] {
    for (int k = 0; k < 20; ++k)
      ASSERT_TRUE(run.step().ok);
  };
  advance();
  solver.snapshot();
  const Runner<2> at = run;
  advance();
  const Sample once = solver.sample(0);
  solver.restore();
  run.time = at.time;
  run.last = at.last;
  advance();
  const Sample twice = solver.sample(0);
  for (int a = 0; a < 2; ++a)
    EXPECT_EQ(once.x[a], twice.x[a]);
  EXPECT_EQ(once.energy, twice.energy);
}

TEST(Reference, FailsWhereItIsTurnedInsideOut)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(10, 8, 0), spacing, copper());
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i][0] = -2 * p.x[i][0] / 1e-7; // its mirror image after the step
  Solver<2>        solver(bare(), {p});
  const StepStatus status = solver.step({0, 0, 1e-7});
  EXPECT_FALSE(status.ok);
  EXPECT_NE(std::string(status.culprit.why).find("inside out"), std::string::npos);
}

TEST(Reference, RefusesWhatItCannotHold)
{
  const auto refuses = [](void (*set)(input::SphOptions &), const std::string &word, bool damage = false) {
    Parameters q;
    q.options.configuration = "reference";
    set(q.options);
    materials::Parameters m = copper()->parameters();
    if (damage)
    {
      m.damage.law            = "plastic-strain";
      m.damage.failure_strain = .3;
    }
    const auto p = box<2>(Vec3::Zero(), spacing * Vec3(6, 6, 0), spacing, materials::make_material(m));
    try
    {
      Solver<2> solver(q, {p});
      ADD_FAILURE() << word;
    }
    catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  using O = input::SphOptions;
  refuses([](O &) {}, "plastic-strain", true);
  refuses([](O &o) { o.form = "standard"; }, "SPH/form");
  refuses([](O &o) { o.density = "summation"; }, "SPH/density");
  refuses([](O &o) { o.artificial_stress = .3; }, "SPH/artificial stress");
  refuses([](O &o) { o.configuration = "referenz"; }, "current, reference");
}
} // namespace
