// SPDX-License-Identifier: LGPL-2.1-or-later
// Mirror images behind rigid walls: a pressed body sees a plane of symmetry, a
// body that has left sees nothing, and the books close.
#include "support.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.3e-3;

double total(const Balance &b)
{
  return b.kinetic + b.internal() + b.wall_loss + b.friction_heat - b.external_work;
}

input::RigidWall wall(int axis, double side, double at, double speed, double friction = 0)
{
  Vec3 normal = Vec3::Zero();
  normal[axis] = side;
  return {"w" + std::to_string(axis), at * normal.cwiseAbs(), normal, speed * normal.cwiseAbs(), friction};
}

/// Largest distance between equal particles of two runs.
double apart(const Sample &a, const Sample &b)
{
  std::vector<std::size_t> of(b.id.size());
  for (std::size_t i = 0; i < b.id.size(); ++i)
    of[b.id[i]] = i;
  double most = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i)
    for (int d = 0; d < 3; ++d)
      most = std::max(most, std::abs(a.x[d][i] - b.x[d][of[a.id[i]]]));
  return most;
}

/// A block that yields on a wall across `axis`, next to a symmetry plane.
template <int dim>
std::unique_ptr<Solver<dim>> pressed(const input::RigidWall &w, int axis, const char *form, const char *correction)
{
  Parameters q;
  q.options.form       = form;
  q.options.correction = correction;
  q.symmetry           = {{axis == 0 ? 1 : 0}};
  if (dim == 1)
    q.symmetry.clear();
  q.walls.push_back(w);
  const Vec3 upper = spacing * (dim == 1 ? Vec3(20, 0, 0) : dim == 2 ? Vec3(9, 8, 0) : Vec3(6, 5, 7));
  auto       p     = box<dim>(Vec3::Zero(), upper, spacing, material(8930, 130e9, 48e9, 3e8), 0, 1, q.symmetry);
  for (std::size_t i = 0; i < p.v.size(); ++i)
  {
    for (int a = 0; a < dim; ++a)
      p.v[i][a] = 25 * std::sin(700 * p.x[i][(a + 1) % dim]);
    p.v[i][axis] -= 120 * w.normal[axis];
    p.x[i][axis] += .1 * spacing * w.normal[axis]; // so that the contact begins on the way
  }
  return std::make_unique<Solver<dim>>(q, std::vector<BodyParticles<dim>>{p});
}

template <int dim>
void books_close(int axis, double side, double speed, double friction, const char *form, const char *correction)
{
  SCOPED_TRACE(std::string(form) + " " + correction + " " + std::to_string(dim) + " " + std::to_string(axis));
  const double length = dim == 1 ? 20 : dim == 2 ? (axis == 0 ? 9 : 8) : axis == 0 ? 6 : axis == 1 ? 5 : 7;
  const auto   owner =
    pressed<dim>(wall(axis, side, side > 0 ? 0 : length * spacing, speed, friction), axis, form, correction);
  Solver<dim>  &solver = *owner;
  Runner<dim>   run{solver};
  const Balance start = solver.balance();
  const double  energy = total(start), momentum = std::sqrt(2 * start.kinetic * start.mass);
  double        force = 0;
  for (int k = 0; k < 80; ++k)
  {
    const double  before = total(solver.balance());
    const Balance then   = solver.balance();
    const double  dt     = solver.stable_dt().dt, kick = .5 * (run.last + dt);
    ASSERT_TRUE(run.step(dt).ok);
    const Balance now = solver.balance();
    EXPECT_NEAR(total(now), before, 1e-12 * energy);
    EXPECT_LT(((now.momentum - now.external_impulse) - (start.momentum - start.external_impulse)).norm(),
              1e-13 * momentum);
    // Across the wall nothing else pushes: what it gave is what it reports.
    EXPECT_NEAR(now.momentum[axis] - then.momentum[axis], side * kick * solver.wall_force(0), 1e-12 * momentum);
    force = std::max(force, solver.wall_force(0));
  }
  EXPECT_GT(force * run.last, 1e-4 * momentum);
  EXPECT_GT(solver.balance().plastic_work, 1e-3 * energy);
  if (speed != 0)
  {
    EXPECT_GT(std::abs(solver.balance().external_work), 1e-3 * energy);
  }
  if (friction > 0)
  {
    EXPECT_GT(solver.balance().friction_heat, 1e-6 * energy);
  }
}

TEST(WallImages, EnergyAndImpulseClose)
{
  books_close<1>(0, 1, 0, 0, "corrected", "pairwise");
  books_close<1>(0, -1, -35, 0, "standard", "none");
  books_close<2>(1, 1, 35, 0, "corrected", "pairwise");
  books_close<2>(0, -1, -35, .2, "corrected", "none");
  books_close<2>(1, 1, 0, .2, "standard", "pairwise");
  books_close<3>(2, 1, 0, .1, "corrected", "pairwise");
  books_close<3>(1, -1, -20, 0, "standard", "none");
}

/// While it presses, a wall is the symmetry plane. The wall of the second run
/// keeps the rest gap there too.
TEST(WallImages, PressedBlockSeesASymmetryPlane)
{
  const auto run = [](bool plane) {
    auto p = box<2>(Vec3::Zero(), spacing * Vec3(8, 12, 0), spacing, material(8930, 130e9, 48e9, 3e8));
    for (auto &v : p.v)
      v[1] = -200;
    Parameters q;
    q.symmetry = {{0}};
    if (plane)
      q.symmetry.push_back({1});
    q.walls.push_back(plane ? input::RigidWall{"w", Vec3::Zero(), Vec3(1e-5, 1, 0).normalized()} : wall(1, 1, 0, 0));
    Solver<2> solver(q, {p});
    Runner<2> r{solver};
    for (int k = 0; k < 60; ++k)
      EXPECT_TRUE(r.step(8e-8).ok);
    EXPECT_GT(solver.balance().plastic_work, 0);
    return solver.sample(0);
  };
  // The slightly oblique wall, which has no images, is off by 1e-5 of the width.
  EXPECT_LT(apart(run(true), run(false)), 1e-3 * spacing);
}

/// Squeezed at one rate everywhere, with the wall and a symmetry plane as the
/// other two sides, a block strains alike down to the wall: after one step of
/// v = (-a x, -b y) all particles within reach of the wall, and away from free
/// faces, have the stress of the closed form, to rounding.
TEST(WallImages, UniformCompressionSeesNoEdge)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(16, 16, 0), spacing, copper(), 0, 1, {{0}});
  const double a = 900, b = 1700, dt = 1e-13;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i] = {-a * p.x[i][0], -b * p.x[i][1]};
  Parameters q;
  q.options.alpha = q.options.beta = q.options.hourglass = 0;
  q.symmetry                       = {{0}};
  q.walls.push_back(wall(1, 1, 0, 0));
  for (auto &x : p.x)
    x[1] += 1e-9 * spacing; // within the slack of touching, so that nothing lands
  Solver<2> solver(q, {p});
  Runner<2> run{solver};
  ASSERT_TRUE(run.step(dt).ok);
  const Sample first = solver.sample(0);
  double       least = 1e300, most = -1e300;
  for (std::size_t i = 0; i < first.id.size(); ++i)
    if (first.x0[0][i] < 10 * spacing && first.x0[1][i] < 10 * spacing)
    {
      least = std::min(least, first.sigma[1][i]);
      most  = std::max(most, first.sigma[1][i]);
    }
  const double exact = -((130e9 + 4. / 3 * 48e9) * b + (130e9 - 2. / 3 * 48e9) * a) * dt;
  EXPECT_NEAR(least / exact, 1, 1e-6);
  EXPECT_NEAR(most / exact, 1, 1e-6);
}

/// A bar bounces off; once a spacing away it flies as if there was no wall:
/// its checkpoint goes on alike, to the bit, with the wall a metre away.
TEST(WallImages, LeavingBodyIsFree)
{
  const auto make = [](double at) {
    auto p = box<2>(Vec3::Zero(), spacing * Vec3(6, 5, 0), spacing, copper());
    for (auto &v : p.v)
      v[1] = -15;
    Parameters q;
    q.walls.push_back(wall(1, 1, at, 0));
    return std::make_unique<Solver<2>>(q, std::vector<BodyParticles<2>>{p});
  };
  auto      here = make(0);
  Runner<2> run{*here};
  const double dt    = 5e-8;
  bool         met   = false;
  double       lowest = 0;
  for (int k = 0; k < 6000 && lowest < 1.05 * spacing; ++k)
  {
    ASSERT_TRUE(run.step(dt).ok);
    met            = met || here->wall_force(0) > 0;
    const Sample s = here->sample(0);
    lowest         = *std::min_element(s.x[1].begin(), s.x[1].end());
  }
  ASSERT_TRUE(met);
  ASSERT_GT(lowest, 1.05 * spacing);
  EXPECT_GT(here->balance().momentum[1], 0);
  Memory memory;
  here->save(memory, "sph");
  auto far = make(-1);
  far->load(memory, "sph");
  Runner<2> other{*far, run.time, run.last};
  for (int k = 0; k < 50; ++k)
  {
    ASSERT_TRUE(run.step(dt).ok);
    ASSERT_TRUE(other.step(dt).ok);
    EXPECT_EQ(here->wall_force(0), 0);
  }
  const Sample a = here->sample(0), b = far->sample(0);
  ASSERT_EQ(a.id, b.id);
  for (int d = 0; d < 2; ++d)
  {
    EXPECT_EQ(std::memcmp(a.v[d].data(), b.v[d].data(), a.id.size() * sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(a.sigma[d].data(), b.sigma[d].data(), a.id.size() * sizeof(double)), 0);
  }
}

/// Snapshot and checkpoint in the middle of the contact, part of the foot
/// having let go: the runs go on alike, to the bit.
TEST(WallImages, StateComesBackInContact)
{
  const auto make = [] { return pressed<2>(wall(1, 1, 0, 35, .2), 1, "corrected", "pairwise"); };
  const auto owner = make(), second = make();
  Solver<2> &solver = *owner, &other = *second;
  Runner<2>  run{solver};
  const auto advance = [](Runner<2> &r) {
    for (int k = 0; k < 60; ++k)
      ASSERT_TRUE(r.step(5e-8).ok);
  };
  advance(run);
  ASSERT_GT(solver.wall_force(0), 0);
  Memory memory;
  solver.save(memory, "sph");
  solver.snapshot();
  const Runner<2> there = run;
  const double    bound = solver.stable_dt().dt;
  advance(run);
  const Sample  first = solver.sample(0);
  const Balance after = solver.balance();

  other.load(memory, "sph");
  solver.restore();
  for (Solver<2> *again : {&solver, &other})
  {
    EXPECT_EQ(again->stable_dt().dt, bound);
    Runner<2> r{*again, there.time, there.last};
    advance(r);
    const Sample s = again->sample(0);
    ASSERT_EQ(s.id, first.id);
    for (int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(std::memcmp(s.v[d].data(), first.v[d].data(), s.id.size() * sizeof(double)), 0);
      EXPECT_EQ(std::memcmp(s.sigma[d].data(), first.sigma[d].data(), s.id.size() * sizeof(double)), 0);
    }
    EXPECT_EQ(again->balance().external_work, after.external_work);
    EXPECT_EQ(again->balance().external_impulse, after.external_impulse);
  }
}

/// On its way in the body does not see the wall either.
TEST(WallImages, ArrivingBodyIsFree)
{
  auto p = box<2>(spacing * Vec3(0, .2, 0), spacing * Vec3(6, 5.2, 0), spacing, copper());
  for (auto &v : p.v)
    v[1] = -40;
  Parameters q;
  q.walls.push_back(wall(1, 1, 0, 0));
  Solver<2> solver(q, {p});
  Runner<2> run{solver};
  for (int k = 0; k < 20; ++k)
    ASSERT_TRUE(run.step(1e-7).ok); // 0.08 mm of 0.26
  const Sample s = solver.sample(0);
  for (const double v : s.v[1])
    EXPECT_NEAR(v, -40, 1e-13 * 4660);
  EXPECT_EQ(solver.wall_force(0), 0);
}
} // namespace
