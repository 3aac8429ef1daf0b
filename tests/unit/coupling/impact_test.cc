// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "hand_made.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::coupling
{
namespace
{
using hand_made::World;

/// Ten thousand points fly from all around at random places of a closed box:
/// its faces, edges and corners. None may be inside in the end, and momentum is
/// kept. The box is a million times heavier, its nodes free.
struct Rain
{
  static constexpr double dt = 1.7e-6, share = .1, mass = 2e-3;
  World<3>                world;
  Point<3>                half;
  Party                   party;
  double                  radius;
  int                     drop_body; ///< 1: that of the box
  std::size_t             first = 0; ///< drop

  Rain(const Point<3> &h, Party p, double r, unsigned seed, int of_body = 0)
    : half(h), party(p), radius(r), drop_body(of_body)
  {
    constexpr int count = 10000, facets = 4;
    hand_made::add_box(world.mesh, half, facets, mass * 1e6, 1);
    first = party == mesh_party ? world.mesh.mass.size() : 0;
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    std::normal_distribution<double>       normal;
    // A step carries a point at most a tenth of the shortest facet.
    const double fastest = .1 * 2 * half.maxCoeff() / facets / dt;
    for (int i = 0; i < count; ++i)
    {
      Point<3>  target(half[0] * u(random), half[1] * u(random), half[2] * u(random));
      const int snapped = i % 4; // 1: face, 2: edge, 3: corner, 0: through the inside
      for (int k = 0; k < snapped; ++k)
      {
        const int a = (i / 4 + k) % 3;
        target[a]   = std::copysign(half[a], target[a]);
      }
      Point<3> from(normal(random), normal(random), normal(random));
      from = target + (1.3 * half.norm() + radius) * from.normalized();
      if ((from.cwiseAbs() - half).maxCoeff() < 2 * radius)
        from += 1.5 * half.norm() * Point<3>::UnitX();
      const double   speed = fastest * (.3 + .35 * (1 + u(random)));
      const Point<3> v     = speed * (target - from).normalized();
      auto          &to    = party == mesh_party ? world.mesh : world.particles;
      to.add(from, v, mass, drop_body, radius);
    }
  }

  double depth(std::size_t i) const
  {
    const auto &from = party == mesh_party ? world.mesh : world.particles;
    return -(from.at(from.x, i).cwiseAbs() - half).maxCoeff();
  }

  void fall()
  {
    ContactSet<3> contacts({{"rain", drop_body, 1, party, mesh_party, 0, share}}, {}, dt, .9);
    contacts.start(world.look());
    const Point<3> before  = world.momentum();
    const double   kinetic = world.kinetic();
    const auto    &drops   = party == mesh_party ? world.mesh : world.particles;
    double         flux    = 0; // scale of what the sums cancel from
    for (std::size_t i = first; i < drops.mass.size(); ++i)
      flux += mass * drops.at(drops.v, i).norm();

    for (int n = 0; n < 260; ++n)
      world.step(contacts, dt);
    EXPECT_GT(contacts.impulse(), .3 * flux);
    EXPECT_EQ(contacts.lost(), 0);
    EXPECT_EQ(contacts.active(), 0u);
    std::size_t inside = 0;
    for (std::size_t i = first; i < drops.mass.size(); ++i)
      inside += depth(i) > 1e-6 * half.norm();
    EXPECT_EQ(inside, 0u);
    EXPECT_LE((world.momentum() - before).norm(), 1e-12 * flux);
    EXPECT_NEAR(world.kinetic() + contacts.energy().taken, kinetic, 1e-11 * kinetic);
    // Nothing is gained. What is lost goes where a point pressed in by up to a
    // third of a facet slips off an edge.
    EXPECT_GE(contacts.energy().loss(), 0);
    EXPECT_LE(contacts.energy().loss(), .1 * kinetic);
  }
};
} // namespace

TEST(Impacts, NoParticleLeaksIntoABox)
{
  Rain({.011, .008, .013}, particle_party, .0009, 1).fall();
}
TEST(Impacts, NoNodeLeaksIntoABox)
{
  Rain({.011, .008, .013}, mesh_party, 0, 2).fall();
}
// One facet of the side is an eighth of those of the faces high: a point that
// crosses the middle is nearer to the far face, and must not leave there.
TEST(Impacts, NoNodeLeaksThroughAThinPlate)
{
  Rain({.02, .0012, .018}, mesh_party, 0, 3).fall();
}
// Debris of the box's own: the same, as a body that meets itself. Nodes of the
// plate's two faces are near each other and must not touch.
TEST(Impacts, NoNodeLeaksIntoItsOwnBody)
{
  Rain({.011, .008, .013}, mesh_party, 0, 5, 1).fall();
}
TEST(Impacts, NoNodeLeaksThroughAThinPlateOfItsOwnBody)
{
  Rain({.02, .0012, .018}, mesh_party, 0, 6, 1).fall();
}
TEST(Impacts, NoParticleLeaksThroughAThinPlate)
{
  Rain({.02, .0012, .018}, particle_party, .0006, 4).fall();
}
} // namespace ogive::coupling
