// SPDX-License-Identifier: LGPL-2.1-or-later
// Going back and coming back: equal to the bit.
#include "core/base/error.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.7e-3, dt = 4e-8;

template <int dim>
Parameters parameters(const char *form, const char *correction)
{
  Parameters p;
  p.options.form       = form;
  p.options.correction = correction;
  p.symmetry           = {{0}};
  p.walls.push_back({"wall", Vec3(0, -.2 * spacing, 0), Vec3::UnitY(), Vec3(0, 30, 0), .1});
  return p;
}

template <int dim>
BodyParticles<dim> block()
{
  materials::Parameters m = material(8930, 130e9, 48e9, 3e8)->parameters();
  m.damage.law            = "plastic-strain";
  m.damage.failure_strain = .02;
  auto p = box<dim>(Vec3::Zero(), spacing * (dim == 2 ? Vec3(15, 9, 0) : Vec3(9, 7, 6)), spacing,
                    materials::make_material(m), 0, 1, {{0}});
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    p.v[i][0] = -300 * p.x[i][0] / (9 * spacing);
    p.v[i][1] = -90 + 60 * std::sin(900 * p.x[i][0]);
  }
  return p;
}

template <int dim>
void push(Solver<dim> &solver)
{
  auto s = solver.surface();
  for (const auto i : s.contact_points)
    s.force[1][i] += 40 * std::cos(3. * static_cast<double>(s.id[i]));
}

void equal(const Sample &a, const Sample &b)
{
  ASSERT_EQ(a.id, b.id);
  const auto same = [](const std::vector<double> &u, const std::vector<double> &v) {
    ASSERT_EQ(u.size(), v.size());
    ASSERT_EQ(std::memcmp(u.data(), v.data(), u.size() * sizeof(double)), 0);
  };
  for (int k = 0; k < 3; ++k)
  {
    same(a.x[k], b.x[k]);
    same(a.v[k], b.v[k]);
  }
  for (int k = 0; k < 6; ++k)
    same(a.sigma[k], b.sigma[k]);
  same(a.density, b.density);
  same(a.energy, b.energy);
  same(a.damage, b.damage);
}

template <int dim>
void round_trip(const char *form, const char *correction)
{
  SCOPED_TRACE(std::string(form) + " " + correction + " " + std::to_string(dim));
  const auto  p = parameters<dim>(form, correction);
  Solver<dim> solver(p, {block<dim>()});
  Runner<dim> run{solver};
  const auto  advance = [](Solver<dim> &s, Runner<dim> &r, int n) {
    for (int k = 0; k < n; ++k)
    {
      push(s);
      ASSERT_TRUE(r.step(dt).ok);
    }
  };
  advance(solver, run, 25);
  Memory memory;
  solver.save(memory, "sph");
  solver.snapshot();
  const Runner<dim> there = run;
  const double      bound = solver.stable_dt().dt;
  const Balance     then  = solver.balance();

  const auto rebuilds = solver.diagnostics().rebuilds;
  advance(solver, run, 40);
  const Sample  first = solver.sample(0);
  const Balance after = solver.balance();
  EXPECT_GT(solver.diagnostics().rebuilds, rebuilds); // else this proves little
  EXPECT_GT(*std::max_element(first.damage.begin(), first.damage.end()), 0);

  solver.restore();
  EXPECT_EQ(solver.balance().kinetic, then.kinetic);
  EXPECT_EQ(solver.stable_dt().dt, bound);
  Runner<dim> again{solver, there.time, there.last};
  advance(solver, again, 40);
  equal(solver.sample(0), first);
  EXPECT_EQ(solver.balance().wall_loss, after.wall_loss);

  Solver<dim> other(p, {block<dim>()});
  other.load(memory, "sph");
  EXPECT_EQ(other.stable_dt().dt, bound);
  Runner<dim> third{other, there.time, there.last};
  advance(other, third, 40);
  equal(other.sample(0), first);
  EXPECT_EQ(other.balance().elastic, after.elastic);
  EXPECT_EQ(other.updates(), solver.updates());
}

TEST(State, SnapshotAndCheckpointContinueToTheBit)
{
  round_trip<2>("corrected", "pairwise");
  round_trip<2>("standard", "none");
  round_trip<3>("corrected", "pairwise");
}

TEST(State, CheckpointOfAnotherSceneIsRefused)
{
  const auto p = parameters<2>("corrected", "none");
  Solver<2>  solver(p, {block<2>()});
  Memory     memory;
  solver.save(memory, "sph");
  Solver<2> other(p, {box<2>(Vec3::Zero(), spacing * Vec3(5, 5, 0), spacing, copper())});
  EXPECT_THROW(other.load(memory, "sph"), InputError);
}

TEST(State, IndexOfIdFollowsTheSorting)
{
  Solver<3>  solver(parameters<3>("corrected", "none"), {block<3>()});
  const auto surface = solver.surface();
  for (std::size_t i = 0; i < surface.n; ++i)
    EXPECT_EQ(solver.index_of_id()[surface.id[i]], i);
}

/// Slaves go where they are told, hand their force over, and weigh nothing here.
TEST(State, SlavesAreDriven)
{
  Parameters p;
  auto       particles = box<2>(Vec3::Zero(), spacing * Vec3(10, 6, 0), spacing, copper());
  for (std::size_t i = 0; i < particles.x.size(); ++i)
    particles.v[i] = {-200 * particles.x[i][0] / spacing, 0};
  Solver<2>                       solver(p, {particles});
  const double                    whole = solver.balance().mass;
  const std::vector<std::int64_t> ids{9, 19, 29};
  solver.set_slaves(ids);
  EXPECT_NEAR(solver.balance().mass, whole * 57 / 60, 1e-12 * whole);
  Runner<2>           run{solver};
  std::vector<double> vx{1, 2, 3}, vy{-4, -5, -6}, fx(3), fy(3);
  for (int k = 0; k < 5; ++k)
  {
    solver.drive_slaves({std::span<const double>(vx), std::span<const double>(vy)});
    ASSERT_TRUE(run.step(dt).ok);
  }
  const auto surface = solver.surface();
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(surface.v[0][solver.index_of_id()[ids[k]]], vx[k]);
    EXPECT_EQ(surface.v[1][solver.index_of_id()[ids[k]]], vy[k]);
  }
  // Newton's third law: what slaves feel, the others lose, to rounding.
  surface.force[0][solver.index_of_id()[19]] = 123;
  solver.slave_forces({std::span<double>(fx), std::span<double>(fy)});
  const double  with = fx[1];
  const Balance b    = solver.balance();
  surface.force[0][solver.index_of_id()[19]] = 0;
  solver.slave_forces({std::span<double>(fx), std::span<double>(fy)});
  EXPECT_NEAR(with - fx[1], 123, 1e-9 * (123 + std::abs(fx[1])));
  ASSERT_TRUE(solver.step({0, dt, dt}).ok);
  const double impulse = dt * (fx[0] + fx[1] + fx[2]);
  EXPECT_NEAR(solver.balance().momentum[0] - b.momentum[0], -impulse, 1e-10 * std::abs(impulse));
}
} // namespace
