// SPDX-License-Identifier: LGPL-2.1-or-later
// Snapshots and checkpoints of particles on several ranks.
#include "ranked.h"
#include "sph/store.h"
#include "sph/territory.h"

#include <cmath>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.7e-3;

/// A block that turns and lands on a wall, with flow.
std::vector<BodyParticles<2>> bodies()
{
  auto b = spinning<2>(spacing, Vec3(17, 11, 0), 2e4, material(8930, 130e9, 48e9, 3e8));
  for (auto &v : b.v)
    v[1] -= 100;
  return {b};
}

Parameters parameters()
{
  Parameters p;
  p.parallel.interval  = 15;
  p.parallel.imbalance = 1;
  p.walls.push_back({"wall", Vec3(0, -7 * spacing, 0), Vec3::UnitY(), Vec3::Zero(), .1});
  return p;
}

/// All fields of the store go where a particle goes because the store names them:
/// one that it does not name shows in its size.
template <int dim>
void every_field_is_named()
{
  Store<dim> store;
  store.in_parts = true;
  std::size_t bytes = 8; // in_parts
  store.for_each_array([&](const std::string &, const auto &a) { bytes += sizeof(a); });
  store.for_each_integer([&](const char *, const auto &a) { bytes += sizeof(a); });
  EXPECT_EQ(bytes, sizeof(store));
}

TEST(RankedState, TheStoreNamesEveryField)
{
  every_field_is_named<1>();
  every_field_is_named<2>();
  every_field_is_named<3>();
}

TEST(RankedState, SnapshotAndCheckpointContinueToTheBit)
{
  const Ranks ranks = Ranks::world();
  Course<2>   course(parameters(), bodies(), ranks);
  course.advance(33);
  Files files;
  course.solver.save(files, "s");
  course.solver.snapshot();
  const Runner<2> there  = course.run;
  const Balance   then   = course.solver.balance();
  const double    bound  = course.solver.stable_dt().dt;
  const auto      before = migrated(ranks, course.solver.diagnostics());
  course.advance(40);
  const Sample  last  = course.solver.sample(0);
  const Balance after = course.solver.balance();
  if (!ranks.alone())
  {
    EXPECT_GT(migrated(ranks, course.solver.diagnostics()), before); // else this proves little
  }

  course.solver.restore();
  EXPECT_EQ(course.solver.balance().kinetic, then.kinetic);
  EXPECT_EQ(course.solver.stable_dt().dt, bound);
  course.run.time = there.time;
  course.run.last = there.last;
  course.advance(40);
  expect_equal(course.solver.sample(0), last);
  EXPECT_EQ(course.solver.balance().wall_loss, after.wall_loss);

  Course<2> other(parameters(), bodies(), ranks);
  other.solver.load(files, "s");
  EXPECT_EQ(other.solver.stable_dt().dt, bound);
  other.run.time = there.time;
  other.run.last = there.last;
  other.advance(40);
  expect_equal(other.solver.sample(0), last);
  EXPECT_EQ(other.solver.balance().elastic, after.elastic);
  EXPECT_EQ(other.solver.balance().friction_heat, after.friction_heat);
  EXPECT_EQ(other.solver.updates(), course.solver.updates());
}

/// Written by one process and read by all, and the other way round. No longer
/// than to the first particle that a wall lets go: that threshold makes 1e-4 of
/// 1e-14, of a run that is alone too.
template <int dim>
void change_ranks(const Parameters &p, const std::vector<BodyParticles<dim>> &b)
{
  const Ranks  ranks = Ranks::world();
  const Ranks  one;
  for (const bool from_one : {true, false})
  {
    Course<dim> first(p, b, from_one ? one : ranks), second(p, b, from_one ? ranks : one);
    first.advance(15);
    Files files, again;
    first.solver.save(files, "s");
    second.solver.load(files, "s");
    second.solver.save(again, "s");
    expect_same_fields(files, again, 0);
    expect_near(first.solver.balance(), second.solver.balance(), 1e-13);
    second.run.time = first.run.time;
    second.run.last = first.run.last;
    first.advance(20);
    second.advance(20);
    expect_near(first.solver.sample(0), second.solver.sample(0), 1e-9);
    expect_near(first.solver.balance(), second.solver.balance(), 1e-9);
  }
}

TEST(RankedState, CheckpointOfAnotherNumberOfRanks)
{
  auto p              = parameters();
  p.parallel.interval = 1e9;
  change_ranks<2>(p, bodies());
}

TEST(RankedState, CheckpointOfAnotherNumberOfRanksInTheReferenceConfiguration)
{
  Parameters p;
  p.options.configuration = "reference";
  change_ranks<2>(p, {spinning<2>(spacing, Vec3(15, 11, 0), 2e4)});
}

/// A particle without a bound on its speed stops all ranks, with one culprit.
TEST(RankedState, OneRanksFailureIsEveryones)
{
  auto b  = bodies();
  b.push_back(box<2>(spacing * Vec3(20, 0, 0), spacing * Vec3(21, 1, 0), spacing, copper())); // all by itself
  b[1].body    = 1;
  b[1].v[0][0] = 1e9;
  const auto id = static_cast<std::int64_t>(b[0].x.size());
  auto       p  = parameters();
  p.ranks       = Ranks::world();
  Solver<2>        solver(p, b);
  const StepStatus status = solver.step({0, 5e-8, 1e-7});
  EXPECT_FALSE(status.ok);
  EXPECT_EQ(status.culprit.id, id);
  EXPECT_EQ(status.culprit.body, 1);
  EXPECT_STREQ(status.culprit.entity, "particle");
  EXPECT_STREQ(status.culprit.why, "velocity without bound");
}

/// Slaves and steps in parts, with forces of a coupling layer on own particles.
TEST(RankedState, SlavesAndStepsInParts)
{
  const Ranks ranks = Ranks::world();
  auto        p     = parameters();
  p.walls.clear();
  const std::vector<std::int64_t> slaves{3, 60, 61, 150, 186};
  const auto run = [&](const Ranks &who, std::vector<double> &forces, Sample &last, double &error) {
    p.ranks = who;
    Solver<2> solver(p, bodies());
    solver.allow_parts();
    solver.set_slaves(slaves);
    double                 time = 0, before = 0;
    constexpr double       dt = 8e-8;
    std::array<std::vector<double>, 2> force, velocity;
    for (auto *list : {&force[0], &force[1], &velocity[0], &velocity[1]})
      list->assign(slaves.size(), 0.);
    for (int n = 0; n < 25; ++n)
    {
      const TimeStep whole{time, .5 * (before + dt), dt};
      const double   share[3] = {.25, .25, .5};
      for (int part = 0; part < 3; ++part)
      {
        solver.slave_forces({force[0], force[1]});
        for (std::size_t k = 0; k < slaves.size(); ++k)
        {
          velocity[0][k] = 100 * std::sin(2e5 * time + static_cast<double>(k)) + 1e-6 * force[0][k];
          velocity[1][k] = -100 + 1e-6 * force[1][k];
        }
        solver.drive_slaves({velocity[0], velocity[1]});
        auto s = solver.surface();
        for (std::size_t i = 0; i < solver.damage().size(); ++i)
          s.force[1][i] += 400 * std::cos(3. * static_cast<double>(s.id[i]));
        const TimeStep piece{time, share[part] * whole.kick, share[part] * dt};
        ASSERT_TRUE((part == 0 ? solver.begin(whole, piece) : solver.go_on(piece)).ok);
      }
      ASSERT_TRUE(solver.finish(whole).ok);
      time += dt;
      before = dt;
    }
    solver.slave_forces({force[0], force[1]});
    forces = force[0];
    last   = solver.sample(0);
    error  = solver.parts_error();
    for (std::size_t k = 0; k < slaves.size(); ++k)
    {
      const auto i = solver.index_of_id()[slaves[k]];
      EXPECT_EQ(who.sum(std::int64_t(i != Solver<2>::elsewhere)), 1);
    }
  };
  std::vector<double> alone, together;
  Sample              a, b;
  double              error_a = 0, error_b = 0;
  run(Ranks(), alone, a, error_a);
  run(ranks, together, b, error_b);
  expect_near(a, b, 1e-9);
  const std::vector<std::size_t> order{0, 1, 2, 3, 4};
  expect_near(alone, order, together, order, 1e-8, "forces of slaves");
  EXPECT_NEAR(error_a, error_b, 1e-9 * std::abs(error_a));
}

/// A layer of a lattice may lie on a cut to the bit: its particles are one rank's.
TEST(Territory, GivesAPointOnACutToOneRank)
{
  Territory<1> t;
  t.boxes = {{{-1.}, {.0132}}, {{.0132}, {1.}}};
  t.find_overlaps();
  EXPECT_TRUE(t.disjoint);
  for (const int guess : {0, 1})
    EXPECT_EQ(t.at({.0132}, guess), 0);
  EXPECT_EQ(t.at({std::nextafter(.0132, 1)}, 0), 1);
}
} // namespace
