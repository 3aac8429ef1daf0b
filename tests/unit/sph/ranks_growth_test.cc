// SPDX-License-Identifier: LGPL-2.1-or-later
// Newcomers, riders and pieces of particles on several ranks.
#include "ranked.h"

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.7e-3;

Newcomers<2> layer(const Vec3 &lower, const Vec3 &upper, const materials::Material &m, const Vec3 &v)
{
  const auto   p = box<2>(spacing * lower, spacing * upper, spacing, copper());
  Newcomers<2> in;
  in.resize(p.x.size());
  m.initialise(in.points, 0, in.size());
  for (std::size_t k = 0; k < in.size(); ++k)
    for (int a = 0; a < 2; ++a)
    {
      in.x[a][k] = in.x0[a][k] = p.x[k][a];
      in.v[a][k]               = v[a] * (1 + .1 * std::sin(p.x[k][1 - a] / (2 * spacing)));
      in.half_cell[a][k]       = .5 * spacing;
      in.mass[k]               = p.mass[k];
    }
  return in;
}

BodyParticles<2> block()
{
  auto b  = box<2>(Vec3::Zero(), spacing * Vec3(17, 9, 0), spacing, copper());
  b.grows = true;
  for (std::size_t i = 0; i < b.x.size(); ++i)
  {
    b.v[i][0] = 250 + 40 * std::sin(b.x[i][1] / (2 * spacing));
    b.v[i][1] = 60 * std::sin(b.x[i][0] / (3 * spacing));
  }
  return b;
}

Parameters parameters()
{
  Parameters p;
  p.parallel.interval = 25;
  return p;
}

TEST(RankedGrowth, NewcomersOfABodyThatHadNone)
{
  const Ranks ranks = Ranks::world();
  auto        empty = block();
  empty.body        = 1;
  empty.x.clear();
  empty.v.clear();
  empty.mass.clear();
  std::array<std::unique_ptr<Course<2>>, 2> course;
  for (int k = 0; k < 2; ++k)
  {
    course[k] = std::make_unique<Course<2>>(parameters(), std::vector{block(), empty}, k == 0 ? Ranks() : ranks);
    auto &c   = *course[k];
    c.advance(10);
    for (int more = 0; more < 3; ++more)
    {
      auto in = layer(Vec3(20, 3. * more, 0), Vec3(36, 3. * more + 3, 0), *copper(), Vec3(250, 10, 0));
      in.body = 1;
      const auto ids = c.solver.add(in);
      ASSERT_EQ(ids.size(), 48u);
      EXPECT_EQ(ids.front(), 153 + 48 * more);
      EXPECT_EQ(ids.back(), ids.front() + 47);
      c.run.last = 0; // velocities and places of newcomers are of one time
      c.advance(15);
    }
    EXPECT_EQ(c.solver.size(), 153u + 144u);
  }
  for (const int body : {0, 1})
    expect_near(course[0]->solver.sample(body), course[1]->solver.sample(body), 1e-9);
  expect_near(course[0]->solver.balance(), course[1]->solver.balance(), 1e-9);
}

/// A scene that begins without any particle.
TEST(RankedGrowth, NewcomersOfASceneThatHadNone)
{
  const Ranks ranks = Ranks::world();
  auto        empty = block();
  empty.x.clear();
  empty.v.clear();
  empty.mass.clear();
  Course<2> alone(parameters(), {empty}, Ranks()), shared(parameters(), {empty}, ranks);
  for (auto *c : {&alone, &shared})
  {
    c->solver.add(layer(Vec3::Zero(), Vec3(16, 8, 0), *copper(), Vec3(100, 0, 0)));
    c->solver.add(layer(Vec3(16, 0, 0), Vec3(18, 8, 0), *copper(), Vec3(-100, 0, 0)));
    c->advance(40);
  }
  expect_near(alone.solver.sample(0), shared.solver.sample(0), 1e-9);
  const auto own = ranks.gather_one(static_cast<std::int64_t>(shared.solver.diagnostics().own));
  EXPECT_GT(*std::min_element(own.begin(), own.end()), 0); // they were shared out
}

/// Riders beyond one face, carried at a speed that depends on the step, under
/// stress; the plane of symmetry has images of them.
TEST(RankedGrowth, RidersBeyondASeam)
{
  const Ranks ranks = Ranks::world();
  Parameters  p;
  p.symmetry          = {{1}};
  p.parallel.interval = 1e9; // else lists are built at other times than alone
  std::array<std::unique_ptr<Course<2>>, 2> course;
  std::array<std::vector<double>, 2>        seam, normal;
  for (int which = 0; which < 2; ++which)
  {
    const Ranks who = which == 0 ? Ranks() : ranks;
    auto        b   = box<2>(Vec3::Zero(), spacing * Vec3(9, 15, 0), spacing, copper(), 0, 1, {{1}});
    b.grows         = true;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      b.v[i][0] = 50 * std::sin(b.x[i][1] / (4 * spacing));
    course[which] = std::make_unique<Course<2>>(p, std::vector{b}, who);
    auto &c       = *course[which];
    c.solver.set_riders(layer(Vec3(9, 0, 0), Vec3(12, 15, 0), *copper(), Vec3::Zero()));
    int n    = 0;
    c.before = [&n](Solver<2> &solver) {
      const auto riders = solver.riders(0);
      ASSERT_EQ(riders.n, 45u);
      for (std::size_t k = 0; k < riders.n; ++k)
      {
        riders.velocity[0][k]      = 300 * std::sin(.05 * n);
        riders.velocity[1][k]      = 30 * std::sin(.1 * static_cast<double>(k / 3));
        riders.state->sigma[0][k]  = -1e8 * std::sin(.03 * n);
        riders.state->density[k]   = 8930;
        riders.state->sound_speed[k] = 4660;
      }
      ++n;
    };
    c.advance(90);
    // By id: particles are where they are.
    std::array<std::vector<double>, 2> force, area;
    const std::size_t                  all = c.solver.surface().n;
    for (auto *list : {&force[0], &force[1], &area[0], &area[1]})
      list->assign(all, 0.);
    c.solver.seam_forces(0, {force[0], force[1]});
    c.solver.seam_normals(0, {area[0], area[1]});
    const auto surface = c.solver.surface();
    seam[which].assign(c.solver.size(), 0.);
    normal[which].assign(c.solver.size(), 0.);
    for (std::size_t i = 0; i < c.solver.damage().size(); ++i)
    {
      seam[which][surface.id[i]]   = force[0][i];
      normal[which][surface.id[i]] = area[0][i];
    }
    who.sum(std::span<double>(seam[which]));
    who.sum(std::span<double>(normal[which]));
  }
  expect_near(course[0]->solver.sample(0), course[1]->solver.sample(0), 1e-9);
  std::vector<std::size_t> order(seam[0].size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  expect_near(seam[0], order, seam[1], order, 1e-9, "forces at the seam");
  expect_near(normal[0], order, normal[1], order, 1e-9, "normals of the seam");
  EXPECT_GT(*std::max_element(normal[0].begin(), normal[0].end()), .3 * spacing);
  const double work = course[0]->solver.seam_work(0);
  EXPECT_NE(work, 0);
  EXPECT_NEAR(course[1]->solver.seam_work(0), work, 1e-9 * std::abs(work));
  EXPECT_EQ(course[0]->solver.diagnostics().pairs, course[1]->solver.diagnostics().pairs);
}

/// Pieces part where ranks meet, too: no pair of two pieces acts.
TEST(RankedGrowth, PiecesFlyApart)
{
  const Ranks ranks = Ranks::world();
  auto        b     = box<2>(Vec3::Zero(), spacing * Vec3(16, 9, 0), spacing, copper());
  std::vector<std::int64_t> pieces;
  for (std::size_t i = 0; i < b.x.size(); ++i)
  {
    const bool right = b.x[i][0] > 8 * spacing;
    b.v[i][0]        = right ? 100 : 0;
    b.v[i][1]        = 40 * std::sin(b.x[i][0] / (3 * spacing));
    pieces.push_back(right);
  }
  Parameters p;
  p.parallel.interval = 1e9;
  Course<2> alone(p, {b}, Ranks()), shared(p, {b}, ranks);
  for (auto *c : {&alone, &shared})
  {
    c->advance(10);
    c->solver.set_pieces(pieces);
    c->advance(40);
  }
  expect_near(alone.solver.sample(0), shared.solver.sample(0), 1e-9);
  EXPECT_EQ(alone.solver.diagnostics().pairs, shared.solver.diagnostics().pairs);
}
} // namespace
