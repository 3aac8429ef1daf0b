// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"
#include "coupling/fragments.h"
#include "hand_made.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

/// Bodies that meet themselves.
namespace ogive::coupling
{
namespace
{
using hand_made::World;

constexpr double dt = 3.7e-7, share = .1, spacing = 1e-3;

ContactSpec itself(Party party, double friction, double joined_within = 0, bool at_start = false)
{
  return {"itself", 0, 0, party, party, friction, share, "rest", joined_within, at_start};
}

/// A box of facets of 5 mm, and one of 4.5 mm that flies at the middle of its
/// side, aslant; every node of one meets the other by 2.8 mm inside or outside of
/// its rim.
World<3> two_boxes(int second_body)
{
  World<3> world;
  hand_made::add_box(world.mesh, {.02, .02, .02}, 8, .02, 0);
  const std::size_t n = world.mesh.mass.size();
  hand_made::add_box(world.mesh, {.0045, .0045, .0045}, 2, .02, second_body);
  for (std::size_t i = n; i < world.mesh.mass.size(); ++i)
  {
    const Point<3> at(.0201 + .0045, .0023, -.0023), v(-60, 12, 7);
    for (int a = 0; a < 3; ++a)
    {
      world.mesh.x[a][i] += at[a];
      world.mesh.v[a][i] = v[a];
    }
  }
  return world;
}

/// A square lattice of particles of body 0, its lower left one at `at`.
void add_lattice(World<2> &world, const Point<2> &at, int columns, int rows, const Point<2> &v)
{
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      world.particles.add(at + spacing * Point<2>(i, j), v, 1e-3, 0, .5 * spacing);
}
} // namespace

// Away from rims it does not matter whether two boxes are two bodies or two pieces
// of one.
TEST(SelfContact, PiecesOfAMeshMeetAsTwoBodiesDo)
{
  World<3>      one = two_boxes(0), two = two_boxes(1);
  ContactSet<3> self({itself(mesh_party, .2)}, {}, dt, .9);
  ContactSet<3> pair({{"pair", 0, 1, mesh_party, mesh_party, .2, share}}, {}, dt, .9);
  self.start(one.look());
  pair.start(two.look());
  const double   kinetic = one.kinetic();
  const Point<3> before  = one.momentum();
  std::size_t    most    = 0;
  for (int s = 0; s < 30; ++s)
  {
    one.step(self, dt);
    two.step(pair, dt);
    most = std::max(most, self.active());
    ASSERT_NEAR(one.kinetic() + self.energy().taken, kinetic, 1e-12 * kinetic);
    ASSERT_EQ(self.active(), pair.active());
  }
  EXPECT_EQ(most, 13u); // nine nodes of the small face, four of the large one
  EXPECT_EQ(self.active(), 0u);
  EXPECT_EQ(self.lost(), 0);
  EXPECT_LE((one.momentum() - before).norm(), 1e-13 * before.norm());
  EXPECT_GT(self.energy().friction_heat, 0);
  EXPECT_NEAR(self.energy().friction_heat, pair.energy().friction_heat, 1e-10 * kinetic);
  for (std::size_t i = 0; i < one.mesh.mass.size(); ++i)
    ASSERT_LE((one.mesh.at(one.mesh.v, i) - two.mesh.at(two.mesh.v, i)).norm(), 1e-9 * 60);
  EXPECT_EQ(self.force(0, 0), Vec3::Zero().eval());
}

// A thin plate whose faces are nearer to each other than a facet is long, bent
// and shaken: nothing touches.
TEST(SelfContact, FacesOfAThinPlateDoNotTouch)
{
  World<3> world;
  hand_made::add_box(world.mesh, {.02, .018, .0004}, 6, .02, 0);
  ContactSet<3> contacts({itself(mesh_party, .2)}, {}, dt, .9);
  contacts.start(world.look());
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t i = 0; i < world.mesh.mass.size(); ++i)
  {
    const Point<3> p   = world.mesh.at(world.mesh.x, i);
    world.mesh.v[2][i] = 2e5 * p[0] * p[0];
    for (int a = 0; a < 3; ++a)
      world.mesh.v[a][i] += u(random);
  }
  for (int s = 0; s < 300; ++s)
  {
    world.step(contacts, dt);
    ASSERT_EQ(contacts.active(), 0u);
  }
}

// Particles that were far from each other at the start meet as bodies do; those
// that were near do not.
TEST(SelfContact, FoldsOfParticlesMeet)
{
  World<2> world;
  add_lattice(world, {0, 0}, 9, 4, {0, 30});
  add_lattice(world, {.3e-3, 8e-3}, 9, 4, {0, -30});
  ContactSet<2> contacts({itself(particle_party, .2, 3.5 * spacing, true)}, {}, dt, .9);
  contacts.start(world.look());
  const double kinetic = world.kinetic();
  const auto   mean    = [&](const auto &field, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < first + 9; ++i)
      sum += field[1][i] / 9;
    return sum;
  };
  // Nothing holds the layers of a sheet, so look at the two that meet until they part.
  std::size_t most = 0;
  double      gap  = 1;
  while (mean(world.particles.v, 27) > mean(world.particles.v, 36) && world.time < 2e-4)
  {
    world.step(contacts, dt);
    most = std::max(most, contacts.active());
    gap  = std::min(gap, mean(world.particles.x, 36) - mean(world.particles.x, 27));
    ASSERT_NEAR(world.kinetic() + contacts.energy().taken, kinetic, 1e-12 * kinetic);
  }
  EXPECT_GE(most, 16u);
  EXPECT_LT(world.time, 1.2e-4);
  EXPECT_LT(gap, spacing);
  EXPECT_GT(gap, .5 * spacing);
  EXPECT_LE(world.momentum().norm(), 1e-13 * 72 * 1e-3 * 30);
}

namespace
{
/// A bar of 12 by 5 whose columns 6 and 7 fail, so that two fragments are left.
World<2> broken_bar()
{
  World<2> world;
  add_lattice(world, {0, 0}, 12, 5, {0, 0});
  world.damage.assign(60, 0.);
  for (int j = 0; j < 5; ++j)
    world.damage[12 * j + 6] = world.damage[12 * j + 7] = 1;
  return world;
}

bool look(Fragments<2> &fragments, World<2> &world)
{
  bool fresh = false;
  for (int n = 0; n < 16; ++n)
    fresh |= fragments.update(world.look());
  return fresh;
}
} // namespace

TEST(Fragments, AreWhatHoldsTogether)
{
  World<2>     world = broken_bar();
  Fragments<2> fragments(0, 1.8 * spacing, false);
  fragments.start(world.look());
  EXPECT_TRUE(fragments.joined(0, 11));
  const auto version = fragments.version();
  EXPECT_TRUE(look(fragments, world));
  EXPECT_GT(fragments.version(), version);
  EXPECT_FALSE(look(fragments, world)); // nothing new
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 12; ++i)
      EXPECT_EQ(fragments.label()[12 * j + i], i < 6 ? 0 : i < 8 ? Fragments<2>::nobody : 8);
  EXPECT_FALSE(fragments.joined(0, 11));
  EXPECT_TRUE(fragments.joined(0, 49));
  EXPECT_TRUE(fragments.joined(6, 0)); // failed: the particle solver's

  // Together again they stay two.
  for (int j = 0; j < 5; ++j)
    for (int i = 8; i < 12; ++i)
      world.particles.x[0][12 * j + i] -= 2 * spacing;
  EXPECT_FALSE(look(fragments, world));
  EXPECT_FALSE(fragments.joined(5, 8));

  // A piece torn off without damage is one more; a particle that comes in is of
  // the piece it comes to.
  for (int j = 0; j < 5; ++j)
    world.particles.x[0][12 * j + 11] += 3 * spacing;
  world.particles.add(Point<2>(-spacing, 0), Point<2>::Zero(), 1e-3, 0, .5 * spacing);
  world.damage.push_back(0);
  EXPECT_TRUE(look(fragments, world));
  EXPECT_EQ(fragments.label()[11], 11);
  EXPECT_EQ(fragments.label()[59], 11);
  EXPECT_EQ(fragments.label()[10], 8);
  EXPECT_EQ(fragments.label()[60], 0);
}

TEST(Fragments, DoNotDependOnTheOrderOfParticles)
{
  World<2>     world = broken_bar(), mixed;
  Fragments<2> plain(0, 1.8 * spacing, false), turned(0, 1.8 * spacing, false);
  std::vector<std::size_t> order(60);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(4));
  for (const std::size_t i : order)
  {
    mixed.particles.add(world.particles.at(world.particles.x, i), Point<2>::Zero(), 1e-3, 0, .5 * spacing);
    mixed.particles.id.back() = static_cast<std::int64_t>(i);
    mixed.damage.push_back(world.damage[i]);
  }
  plain.start(world.look());
  turned.start(mixed.look());
  look(plain, world);
  look(turned, mixed);
  EXPECT_EQ(plain.state(), turned.state());
}

// Two fragments closed again by the flight of one, with friction: from a
// checkpoint and after going back to the bit, the labels included.
TEST(SelfContact, RestartsToTheBitThroughFragments)
{
  const auto make = [] {
    World<2> world = broken_bar();
    for (int j = 0; j < 5; ++j)
      for (int i = 8; i < 12; ++i)
      {
        world.particles.v[0][12 * j + i] = -40;
        world.particles.v[1][12 * j + i] = 10;
      }
    for (int j = 0; j < 5; ++j) // the failed ones fly out of the way
      for (int i = 6; i < 8; ++i)
        world.particles.v[1][12 * j + i] = 900;
    return world;
  };
  World<2>      world = make(), again = make();
  ContactSet<2> whole({itself(particle_party, .3, 1.8 * spacing)}, {}, dt, .9);
  ContactSet<2> resumed({itself(particle_party, .3, 1.8 * spacing)}, {}, 9 * dt, .9);
  whole.start(world.look());
  resumed.start(again.look());
  EXPECT_TRUE(whole.new_pieces().empty());
  while (whole.active() == 0 && world.time < 1e-3)
    world.step(whole, dt);
  ASSERT_GT(whole.active(), 0u);
  EXPECT_EQ(whole.new_pieces()[8], 8);
  EXPECT_TRUE(whole.new_pieces().empty());

  hand_made::MemoryArchive archive;
  whole.save(archive, "coupling");
  again = world;
  resumed.load(archive, "coupling");
  EXPECT_TRUE(resumed.new_pieces().empty());
  whole.snapshot();
  const World<2> mark = world;
  for (int round = 0; round < 2; ++round) // the second after going back
  {
    if (round == 1)
    {
      whole.restore();
      world = mark;
    }
    for (int s = 0; s < 60; ++s)
      world.step(whole, dt);
  }
  for (int s = 0; s < 60; ++s)
    again.step(resumed, dt);
  EXPECT_GT(whole.energy().friction_heat, 0);
  EXPECT_EQ(world.particles.x, again.particles.x);
  EXPECT_EQ(world.particles.v, again.particles.v);
  EXPECT_EQ(whole.energy().taken, resumed.energy().taken);
  EXPECT_EQ(whole.energy().friction_heat, resumed.energy().friction_heat);
}
} // namespace ogive::coupling
