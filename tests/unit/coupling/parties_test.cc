// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"
#include "hand_made.h"

#include <gtest/gtest.h>

/// Contacts of a body that is made of elements and of particles.
namespace ogive::coupling
{
namespace
{
constexpr double dt = 3e-7, radius = .5e-3;

/// A flat side of `body`, 20 mm long, facing up (or down) at the height y.
void add_side(hand_made::Arrays<2> &mesh, double y, bool up, int body)
{
  std::array<std::uint32_t, 5> node{};
  for (int i = 0; i < 5; ++i)
    node[i] = mesh.add({.005 * (i - 2) * (body == 0 ? 1 : .9), y}, {0, 0}, .02, body);
  for (int i = 0; i < 4; ++i)
  {
    Surface<2>::Facet facet;
    facet.node    = up ? std::array{node[i + 1], node[i]} : std::array{node[i], node[i + 1]};
    facet.body    = body;
    facet.element = static_cast<std::uint32_t>(mesh.facets.size());
    mesh.facets.push_back(facet);
  }
}
} // namespace

// An anvil and a body of both kinds whose first particles come in on the way: they touch the anvil as its
// elements do, and not its own elements, in which they stand.
TEST(Parties, OfABodyThatConvertsBothTouch)
{
  hand_made::World<2> world;
  add_side(world.mesh, 0, true, 0);
  add_side(world.mesh, 1e-3, false, 1);
  const std::size_t anvil = 5, all = 10;
  ContactSpec       spec{"touch", 0, 1, mesh_party, mesh_party, 0, .1};
  spec.second_radius  = radius;
  ContactSpec with    = spec;
  with.second_party   = particle_party;
  ContactSet<2> contacts({spec, with}, {}, dt, .9);
  contacts.start(world.look());
  const auto step = [&] { world.step(contacts, dt); };
  for (int n = 0; n < 5; ++n)
    step();
  EXPECT_EQ(contacts.active(), 0u);

  // Two particles within the plate's own elements, that fly at the anvil.
  for (const double x : {-.004, .0037})
    world.particles.add({x, 1.2e-3}, {0, -30}, 1e-3, 1, radius);
  ++world.particles.topology;
  std::size_t most = 0;
  while (world.time < 1e-4 && (most == 0 || contacts.active() > 0))
  {
    step();
    most = std::max(most, contacts.active());
  }
  EXPECT_EQ(most, 2u);
  EXPECT_NEAR(world.particles.v[1].front(), 30, 3); // the anvil's nodes are twenty times heavier
  EXPECT_GT(world.particles.x[1].front(), radius - .3 * radius);
  for (std::size_t i = anvil; i < all; ++i)
    EXPECT_EQ(world.mesh.v[1][i], 0);

  // Its elements touch as well.
  for (std::size_t i = anvil; i < all; ++i)
    world.mesh.v[1][i] = -40;
  most = 0;
  for (int n = 0; n < 100; ++n)
  {
    step();
    most = std::max(most, contacts.active());
  }
  EXPECT_GE(most, 5u);
  for (std::size_t i = anvil; i < all; ++i)
    EXPECT_GT(world.mesh.v[1][i], -10); // as heavy as the anvil, which takes it over
}
} // namespace ogive::coupling
