// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/coupler.h"
#include "hand_made.h"

#include <gtest/gtest.h>

/// Contacts of a body that is made of elements and of particles.
namespace ogive::coupling
{
namespace
{
constexpr double dt = 3e-7, radius = .5e-3;

struct Mesh : MeshPort<2>
{
  hand_made::Arrays<2> &arrays;
  explicit Mesh(hand_made::Arrays<2> &a) : arrays(a) {}
  Surface<2> surface() override { return arrays.surface(); }
  StepLimit  stable_dt() const override { return {dt, {}}; }
  void       add_mass(std::uint32_t, double) override {}
  bool       embed(std::uint32_t, const std::array<double, 2> &, double, Embedding<2> &) const override { return false; }
};

struct Particles : ParticlePort<2>
{
  hand_made::World<2> &world;
  explicit Particles(hand_made::World<2> &w) : world(w) {}
  Surface<2> surface() override { return world.particles.surface(); }
  StepLimit  stable_dt() const override { return {dt, {}}; }
  void       set_slaves(std::span<const std::int64_t>) override {}
  void       drive_slaves(const std::array<std::span<const double>, 2> &) override {}
  void       slave_forces(const std::array<std::span<double>, 2> &) const override {}
  std::span<const std::uint32_t> index_of_id() const override
  {
    world.look();
    return world.index_of_id;
  }
};

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
  input::Scene      scene;
  scene.bodies.resize(2);
  scene.bodies[0].name   = "anvil";
  scene.bodies[1].name   = "plate";
  scene.bodies[1].method = input::Method::automatic;
  scene.contacts.push_back({"touch", "anvil", "plate", 0, .1});
  Coupler<2> coupler(scene, std::make_unique<Mesh>(world.mesh), std::make_unique<Particles>(world));
  const auto step = [&] {
    coupler.gather();
    world.mesh.kick_and_drift(dt, {0, 0});
    world.particles.kick_and_drift(dt, {0, 0});
    coupler.close({world.time, dt, dt});
    world.time += dt;
  };
  for (int n = 0; n < 5; ++n)
    step();
  EXPECT_EQ(coupler.active_contacts(), 0u);

  // Two particles within the plate's own elements, that fly at the anvil.
  for (const double x : {-.004, .0037})
    world.particles.add({x, 1.2e-3}, {0, -30}, 1e-3, 1, radius);
  ++world.particles.topology;
  std::size_t most = 0;
  while (world.time < 1e-4 && (most == 0 || coupler.active_contacts() > 0))
  {
    step();
    most = std::max(most, coupler.active_contacts());
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
    most = std::max(most, coupler.active_contacts());
  }
  EXPECT_GE(most, 5u);
  for (std::size_t i = anvil; i < all; ++i)
    EXPECT_GT(world.mesh.v[1][i], -10); // as heavy as the anvil, which takes it over
}
} // namespace ogive::coupling
