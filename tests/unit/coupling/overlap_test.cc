// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"
#include "hand_made.h"

#include <gtest/gtest.h>

/// Bodies that overlap at the start: healed or refused (at rest: contact_test.cc).
namespace ogive::coupling
{
namespace
{
using hand_made::World;

constexpr double dt = 3.7e-7, share = .1, radius = .5e-3;

/// A box of nodes and a layer of particles over its upper side, `deep` too low
/// (the last one `deepest`).
World<3> layer_on_box(double deep, double deepest)
{
  World<3> world;
  hand_made::add_box(world.mesh, {.004, .004, .004}, 4, .02, 1);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      world.particles.add({.001 * (i - 2), .001 * (j - 2), .004 + radius - (i + j == 8 ? deepest : deep)},
                          {0, 0, 0}, 1e-3, 0, radius);
  return world;
}

ContactSpec spec(const std::string &overlap)
{
  return {"touch", 0, 1, particle_party, mesh_party, 0, share, overlap};
}

void make(const std::vector<Move> &moves, World<3> &world)
{
  for (const Move &move : moves)
    for (int a = 0; a < 3; ++a)
      (move.party == mesh_party ? world.mesh : world.particles).x[a][move.id] += move.by[a];
}
} // namespace

// Each particle goes up by what it is too low: .1 mm, the last .3 mm.
TEST(Overlap, IsHealedByMovingPointsOut)
{
  World<3>                    world = layer_on_box(.1e-3, .3e-3);
  std::vector<InitialOverlap> healed;
  const auto moves = ContactSet<3>({spec("heal")}, {}, dt, .9).healing(world.look(), healed);
  ASSERT_EQ(moves.size(), 25u);
  for (const Move &move : moves)
  {
    EXPECT_EQ(move.party, particle_party);
    EXPECT_EQ(move.body, 0);
    EXPECT_NEAR(move.by[2], move.id == 24 ? .3e-3 : .1e-3, 1e-8);
    EXPECT_LT(std::hypot(move.by[0], move.by[1]), 1e-12);
  }
  ASSERT_EQ(healed.size(), 1u);
  EXPECT_EQ(healed[0].count, 25u);
  EXPECT_NEAR(healed[0].worst, .3e-3, 1e-12);
  EXPECT_NEAR(healed[0].moved, .3e-3, 1e-8);
  EXPECT_NE(healed[0].describe().find("moved apart"), std::string::npos);

  make(moves, world);
  ContactSet<3> contacts({spec("heal")}, {}, dt, .9);
  contacts.start(world.look());
  EXPECT_TRUE(contacts.initial_overlaps().empty());
  contacts.report_healed(healed);
  EXPECT_EQ(contacts.initial_overlaps().size(), 1u);
  for (int n = 0; n < 20; ++n)
    world.step(contacts, dt);
  EXPECT_EQ(world.kinetic(), 0);
  EXPECT_EQ(contacts.active(), 0u);
}

// Two meshes, neither flat on the other: both give way until none is inside.
TEST(Overlap, OfTwoMeshesIsHealedFromBothSides)
{
  World<3> world;
  hand_made::add_box(world.mesh, {.004, .004, .004}, 4, .02, 0);
  const std::size_t n = world.mesh.mass.size();
  hand_made::add_box(world.mesh, {.003, .003, .003}, 3, .02, 1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(.3, Point<3>(1, 1, 0).normalized()).toRotationMatrix();
  for (std::size_t i = n; i < world.mesh.mass.size(); ++i)
  {
    const Point<3> p = turn * world.mesh.at(world.mesh.x, i) + Point<3>(.0004, .0007, .0079);
    for (int a = 0; a < 3; ++a)
      world.mesh.x[a][i] = p[a];
  }
  const ContactSpec           heal{"touch", 0, 1, mesh_party, mesh_party, 0, share, "heal"};
  std::vector<InitialOverlap> healed;
  const auto                  moves = ContactSet<3>({heal}, {}, dt, .9).healing(world.look(), healed);
  ASSERT_FALSE(moves.empty());
  ASSERT_EQ(healed.size(), 1u);
  EXPECT_LE(healed[0].moved, 1.5 * healed[0].worst);
  make(moves, world);
  ContactSet<3> contacts({heal}, {}, dt, .9);
  contacts.start(world.look());
  EXPECT_TRUE(contacts.initial_overlaps().empty());
}

TEST(Overlap, RefusalNamesTheWorstPointAndWhatHelps)
{
  World<3> world = layer_on_box(.1e-3, .3e-3);
  try
  {
    ContactSet<3>({spec("refuse")}, {}, dt, .9).start(world.look());
    FAIL() << "accepted";
  }
  catch (const InputError &error)
  {
    const std::string what = error.what();
    for (const char *part : {"touch", "25 points", "particle 24", "0.0003", "0.002  0.002 0.0042", "overlap = heal"})
      EXPECT_NE(what.find(part), std::string::npos) << part << " in " << what;
    EXPECT_EQ(error.where().entry, "Contacts/touch/overlap");
  }
  World<3> apart = layer_on_box(0, -1e-5);
  EXPECT_NO_THROW(ContactSet<3>({spec("refuse")}, {}, dt, .9).start(apart.look()));
}

// More than half a spacing (.5 mm here) is a mistake that no word makes good.
TEST(Overlap, DeeperThanHalfASpacingIsRefusedByAll)
{
  for (const char *way : {"rest", "heal", "refuse"})
  {
    World<3>                    world = layer_on_box(.1e-3, .6e-3);
    std::vector<InitialOverlap> healed;
    EXPECT_THROW(
      {
        ContactSet<3> contacts({spec(way)}, {}, dt, .9);
        contacts.healing(world.look(), healed);
        contacts.start(world.look());
      },
      InputError)
      << way;
  }
}
} // namespace ogive::coupling
