// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"
#include "hand_made.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ogive::coupling
{
namespace
{
using hand_made::World;

constexpr double dt = 3.7e-7, share = .1;
} // namespace

// Past the rim, too, the forces are the gradient of the springs' energy: boxes
// pressed into each other by a third of a facet, nodes shaken, so that rims
// stand in and out of each other. Central differences err by h^2.
TEST(Rim, PastItForcesHaveAPotential)
{
  World<3>       world;
  const Point<3> half(.01, .01, .01);
  const double   size = .01, h = 1e-5 * size;
  hand_made::add_box(world.mesh, half, 2, .02, 0);
  const std::size_t n = world.mesh.mass.size();
  hand_made::add_box(world.mesh, half, 2, .02, 1);
  auto &x = world.mesh.x;
  for (std::size_t i = 0; i < 2 * n; ++i)
    x[2][i] += (i < n ? -1.02 : 1.02) * half[2];
  ContactSet<3> contacts({{"boxes", 0, 1, mesh_party, mesh_party, 0, share}}, {}, dt, .9);
  contacts.start(world.look());
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> shake(-.1 * size, .1 * size);
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (int a = 0; a < 3; ++a)
      x[a][i] += shake(random) + (a == 2 ? (i < n ? .17 : -.17) * size : 0);

  auto faces = world.look();
  contacts.gather(faces); // contacts keep the stiffness that they begin with
  contacts.snapshot();
  const auto forces = world.mesh.f;
  const auto energy = [&]
  {
    contacts.restore();
    auto moved = world.look();
    moved.clear_forces();
    contacts.gather(moved);
    contacts.close(moved, {0, 0, 0});
    return contacts.energy().stored;
  };
  double largest = 0;
  for (const auto &component : forces)
    for (const double f : component)
      largest = std::max(largest, std::abs(f));
  ASSERT_GT(energy(), 0);
  std::size_t sideways = 0;
  for (int a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < 2 * n; ++i)
    {
      const double before = x[a][i];
      x[a][i]             = before + h;
      const double up     = energy();
      x[a][i]             = before - h;
      const double down   = energy();
      x[a][i]             = before;
      EXPECT_NEAR(forces[a][i], (down - up) / (2 * h), 1e-6 * largest) << "node " << i << " axis " << a;
      sideways += a < 2 && std::abs(forces[a][i]) > .01 * largest;
    }
  EXPECT_GT(sideways, 0u);
}

// A box pressed flush into its like and drawn aside: the springs' energy goes
// down without a jump, neither where the rims cross nor where they let go. Each
// box has a rim, three of nine nodes, past the other's, so a third of the energy
// falls as (1 - u^2)^2, by at most 1.54 du; du = .02.
TEST(Rim, LetsGoWithoutAJump)
{
  World<3>       world;
  const Point<3> half(.01, .01, .01);
  const double   size = .01, step = .01 * size;
  hand_made::add_box(world.mesh, half, 2, .02, 0);
  const std::size_t n = world.mesh.mass.size();
  hand_made::add_box(world.mesh, half, 2, .02, 1);
  auto &x = world.mesh.x;
  for (std::size_t i = 0; i < 2 * n; ++i)
    x[2][i] += (i < n ? -1.02 : 1.02) * half[2];
  ContactSet<3> contacts({{"boxes", 0, 1, mesh_party, mesh_party, 0, share}}, {}, dt, .9);
  contacts.start(world.look());
  for (std::size_t i = 0; i < 2 * n; ++i)
    x[2][i] += (i < n ? .12 : -.12) * size;
  double first = 0, last = 0;
  for (int s = 0; s < 75; ++s) // at 80 the next row comes as near to the side as it is deep
  {
    auto faces = world.look();
    faces.clear_forces();
    contacts.gather(faces);
    contacts.close(faces, {0, 0, 0});
    const double energy = contacts.energy().stored;
    if (s == 0)
      first = last = energy;
    EXPECT_LE(std::abs(energy - last), 1.54 * .02 / 3 * first) << s;
    last = energy;
    for (std::size_t i = n; i < 2 * n; ++i)
      x[0][i] += step;
  }
  EXPECT_NEAR(last / first, 12. / 18, 1e-12);
}
} // namespace ogive::coupling
