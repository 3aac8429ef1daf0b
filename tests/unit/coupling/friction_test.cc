// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"
#include "coupling/laws.h"

#include "hand_made.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::coupling
{
namespace
{
using hand_made::World;

constexpr double dt = 2.3e-5, mass = .04, share = .1;

/// A block, as one ball, on a long plate of 8 facets in the plane across the
/// tilted last axis; the plate is as good as fixed.
struct Slope
{
  World<3>                    world;
  Eigen::Matrix<double, 3, 3> turn = hand_made::tilt<3>();
  Point<3>                    up = turn * Point<3>::UnitZ(), along = turn * Point<3>::UnitX();

  Slope()
  {
    std::array<std::uint32_t, 2> last{};
    for (int i = 0; i <= 8; ++i)
    {
      std::array<std::uint32_t, 2> here;
      for (int j = 0; j < 2; ++j)
        here[j] = world.mesh.add(turn * Point<3>(.05 * i - .1, .06 * j - .03, 0), Point<3>::Zero(), 1e12, 1);
      if (i > 0)
      {
        Surface<3>::Facet facet;
        facet.node = {last[0], here[0], here[1], last[1]};
        facet.body = 1;
        world.mesh.facets.push_back(facet);
      }
      last = here;
    }
    world.particles.add(.01 * up, Point<3>::Zero(), mass, 0, .01);
  }
  ContactSet<3> contacts(double friction) const
  {
    return {{{"slope", 0, 1, particle_party, mesh_party, friction, share}}, {}, dt, .9};
  }
  double speed() const { return world.particles.at(world.particles.v, 0).dot(along); }
  double bobbing() const { return world.particles.at(world.particles.v, 0).dot(up); }
  double place() const { return world.particles.at(world.particles.x, 0).dot(along); }
};
} // namespace

TEST(Coulomb, SticksBelowTheLimitAndSlipsAtIt)
{
  const double   k = 3e6, limit = 12;
  const Point<2> spring(1e-6, -2e-6), slide(.5e-6, 1e-6);
  const auto     stick = coulomb<2>(spring, slide, k, limit);
  EXPECT_EQ(stick.spring, Point<2>(spring + slide));
  EXPECT_EQ(stick.heat, 0);
  const auto slip = coulomb<2>(spring, 10 * slide, k, limit);
  EXPECT_NEAR(k * slip.spring.norm(), limit, 1e-14 * limit);
  EXPECT_NEAR(slip.spring.normalized().dot((spring + 10 * slide).normalized()), 1, 1e-15);
  EXPECT_GT(slip.heat, 0);
}

// The identity that lets the books close: for springs s_n with forces -k s_n
// and any slides d_n, work of the force over a kick (mean of the motions before
// and after) + change of 1/2 k s_n.(s_n + d_{n+1}) + heat = 0.
TEST(Coulomb, HeatClosesTheBooksOfTheLeapfrog)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const double                           k = 5e5;
  Point<2>                               spring = Point<2>::Zero(), slide(1e-6 * u(random), 1e-6 * u(random));
  double                                 heat   = 0;
  for (int n = 0; n < 1000; ++n)
  {
    const double   stored = .5 * k * spring.dot(spring + slide);
    const auto     step   = coulomb<2>(spring, slide, k, .8 * (1 + u(random)));
    const Point<2> next(1e-6 * u(random), 1e-6 * u(random));
    const double   work  = -k * step.spring.dot(.5 * (slide + next));
    const double   after = .5 * k * step.spring.dot(step.spring + next);
    EXPECT_NEAR(work + (after - stored) + step.heat, 0, 1e-14);
    spring = step.spring;
    slide  = next;
    heat += step.heat;
  }
  EXPECT_GT(heat, 1e-5);
}

// v = v0 - mu g t, at rest after v0/(mu g), having gone v0^2/(2 mu g). The
// block also bobs on its spring, and friction follows the normal force, whose
// impulse is m (g t + bobbing speed).
TEST(Friction, BlockSlidesToRestOnTheFlat)
{
  Slope        slope;
  const double mu = .35, g = 12.5, v0 = 1.3, stop = v0 / (mu * g);
  slope.world.gravity = -g * slope.up;
  for (int a = 0; a < 3; ++a)
    slope.world.particles.v[a][0] = v0 * slope.along[a];
  auto contacts = slope.contacts(mu);
  contacts.start(slope.world.look());
  const double start = slope.place();
  while (slope.world.time < .9 * stop)
  {
    slope.world.step(contacts, dt);
    ASSERT_NEAR(slope.speed(), v0 - mu * (g * slope.world.time + slope.bobbing()), 1e-9 * v0);
    ASSERT_LT(std::abs(slope.bobbing()), 4 * g * dt / std::sqrt(share));
  }
  const double kinetic = .5 * mass * v0 * v0;
  EXPECT_NEAR(contacts.energy().friction_heat, .99 * kinetic, 2e-3 * kinetic);
  while (slope.world.time < 1.5 * stop)
    slope.world.step(contacts, dt);
  EXPECT_NEAR(slope.place() - start, v0 * v0 / (2 * mu * g), 1e-3 * v0 * v0 / (2 * mu * g));
  EXPECT_NEAR(contacts.energy().friction_heat, kinetic, 2e-3 * kinetic);
  EXPECT_LE(std::abs(contacts.energy().loss()), 2e-3 * kinetic);
  EXPECT_EQ(contacts.lost(), 0);
}

// a = g (sin - mu cos), less mu times the bobbing speed as above; the first
// steps, before the tangential spring slips, add at most a few g dt.
TEST(Friction, BlockSlidesDownASlope)
{
  Slope        slope;
  const double mu = .2, g = 9.2, angle = .5;
  slope.world.gravity = g * (std::sin(angle) * slope.along - std::cos(angle) * slope.up);
  auto contacts = slope.contacts(mu);
  contacts.start(slope.world.look());
  const double a = g * (std::sin(angle) - mu * std::cos(angle));
  while (slope.world.time < .25)
    slope.world.step(contacts, dt);
  EXPECT_NEAR(slope.speed() + mu * slope.bobbing(), a * slope.world.time, 10 * g * dt);
}

// Below the angle of friction it stays: no farther than twice the stretch
// m g sin/k of the tangential spring, however long.
TEST(Friction, BlockSticksOnAGentleSlope)
{
  Slope        slope;
  const double mu = .6, g = 9.2, angle = .25;
  slope.world.gravity = g * (std::sin(angle) * slope.along - std::cos(angle) * slope.up);
  auto contacts = slope.contacts(mu);
  contacts.start(slope.world.look());
  const double start = slope.place(), stretch = g * std::sin(angle) * dt * dt / share;
  double       farthest = 0;
  for (int n = 0; n < 20000; ++n)
  {
    slope.world.step(contacts, dt);
    farthest = std::max(farthest, std::abs(slope.place() - start));
  }
  // The bobbing of the first moments lets it slip a few stretches, once.
  EXPECT_LT(farthest, 20 * stretch);
  EXPECT_LT(std::abs(slope.speed()), g * dt / std::sqrt(share) * 2);
}
} // namespace ogive::coupling
