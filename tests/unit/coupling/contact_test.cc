// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"
#include "hand_made.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ogive::coupling
{
namespace
{
using hand_made::World;

constexpr double dt = 3.7e-7, share = .1;

ContactSpec particle_on_mesh(double friction = 0)
{
  return {"touch", 0, 1, particle_party, mesh_party, friction, share};
}

/// A ball of radius r over the middle of a plate, flying at it at `speed`
/// along a direction off the axes.
template <int dim>
World<dim> ball_and_plate(double speed, double ball_mass, double plate_mass)
{
  World<dim>   world;
  const auto   turn = hand_made::tilt<dim>();
  const double size = .01, r = .002;
  Point<dim>   up = Point<dim>::Zero();
  up[dim - 1]     = 1;
  up              = turn * up;
  hand_made::add_plate<dim>(world.mesh, size, plate_mass, 1, turn);
  world.particles.add((r + .31 * speed * dt) * up, -speed * up, ball_mass, 0, r);
  return world;
}

template <int dim>
void head_on()
{
  const double speed = 40, m = .003, plate = .011;
  auto         world = ball_and_plate<dim>(speed, m, plate);
  if constexpr (dim == 1)
    world.mesh.facets[0].outward = 1;
  ContactSet<dim> contacts({particle_on_mesh()}, {}, dt, .9);
  contacts.start(world.look());
  const auto   before  = world.momentum();
  const double kinetic = world.kinetic();
  double       loss_between = 0;
  std::size_t  touching     = 0;
  for (int n = 0; n < 60; ++n)
  {
    const double loss = contacts.energy().loss();
    const auto   had  = contacts.active();
    world.step(contacts, dt);
    // From the second step of contact to the last but one the stored energy
    // 1/2 k g_n g_{n+1} of the leapfrog is exact.
    if (had && contacts.active() && contacts.energy().stored > 0)
      loss_between = std::max(loss_between, std::abs(contacts.energy().loss() - loss));
    touching += contacts.active();
    EXPECT_NEAR(world.kinetic() + contacts.energy().taken, kinetic, 1e-13 * kinetic);
  }
  EXPECT_GT(touching, 5u);
  EXPECT_EQ(contacts.active(), 0u);
  EXPECT_LE((world.momentum() - before).norm(), 1e-14 * before.norm() * 60);
  EXPECT_LE(loss_between, 1e-13 * kinetic);
  EXPECT_EQ(contacts.energy().stored, 0);
  // Opening and closing between two steps each err by at most k (v dt)^2/8,
  // with (w dt)^2 = share that is share/4 of the energy of the relative motion.
  const double relative = .5 * m * plate / (m + plate) * speed * speed;
  EXPECT_LE(std::abs(contacts.energy().loss()), share / 4 * relative);

  // Elastic impact: the velocity of separation is that of approach.
  Point<dim> plate_velocity = world.mesh.momentum() / plate;
  const double separation   = (world.particles.momentum() / m - plate_velocity).norm();
  EXPECT_NEAR(separation / speed, 1, share / 8 * 1.01);
}
} // namespace

TEST(Contact, HeadOnImpactKeepsMomentumAndEnergyInOneDimension) { head_on<1>(); }
TEST(Contact, HeadOnImpactKeepsMomentumAndEnergyInTwoDimensions) { head_on<2>(); }
TEST(Contact, HeadOnImpactKeepsMomentumAndEnergyInThreeDimensions) { head_on<3>(); }

// Two equal balls exchange their velocities; the time of contact is half a
// period of the mass m/2 on the spring k = share (m/2)/dt^2.
TEST(Contact, EqualBallsExchangeVelocities)
{
  World<3>     world;
  const auto   turn = hand_made::tilt<3>();
  const double r = .4e-3, m = 2e-6, v = 120;
  const Point<3> n = turn * Point<3>::UnitX();
  world.particles.add(Point<3>::Zero(), v * n, m, 0, r);
  world.particles.add((2 * ball_share * r + .5 * v * dt) * n, Point<3>::Zero(), m, 1, r);
  ContactSet<3> contacts({{"balls", 0, 1, particle_party, particle_party, 0, share}}, {}, dt, .9);
  contacts.start(world.look());
  int touching = 0;
  for (int s = 0; s < 40; ++s)
  {
    world.step(contacts, dt);
    touching += contacts.active() > 0;
    EXPECT_EQ(contacts.force(0, 1), Vec3(-contacts.force(1, 0)));
  }
  EXPECT_LE(world.particles.at(world.particles.v, 0).norm(), share / 8 * v);
  EXPECT_LE((world.particles.at(world.particles.v, 1) - v * n).norm(), share / 8 * v);
  EXPECT_NEAR(touching, M_PI / std::sqrt(share), 1);
  EXPECT_LE((world.momentum() - m * v * n).norm(), 1e-15 * m * v * 40);
}

// Two passes at half stiffness: what A does to B, B does to A.
TEST(Contact, EqualMeshesReboundAlike)
{
  World<3>       world;
  const Point<3> half(.01, .012, .009);
  hand_made::add_box(world.mesh, half, 2, .02, 0);
  const std::size_t n = world.mesh.mass.size();
  hand_made::add_box(world.mesh, half, 2, .02, 1);
  const double v = 15;
  for (std::size_t i = 0; i < 2 * n; ++i)
  {
    world.mesh.x[0][i] += (i < n ? -1 : 1) * (half[0] + .4 * v * dt);
    world.mesh.v[0][i] = i < n ? v : -v;
  }
  std::vector<std::size_t> image(n); // in the plane of touch
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n; j < 2 * n; ++j)
      if ((world.mesh.at(world.mesh.x, i) -
           world.mesh.at(world.mesh.x, j).cwiseProduct(Point<3>(-1, 1, 1))).norm() < 1e-9)
        image[i] = j;
  ContactSet<3> contacts({{"boxes", 0, 1, mesh_party, mesh_party, 0, share}}, {}, dt, .9);
  contacts.start(world.look());
  EXPECT_TRUE(contacts.initial_overlaps().empty());
  std::size_t  most    = 0;
  const double kinetic = world.kinetic();
  for (int s = 0; s < 30; ++s)
  {
    world.step(contacts, dt);
    most = std::max(most, contacts.active());
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(world.mesh.v[0][i], -world.mesh.v[0][image[i]], 1e-12 * v);
    EXPECT_NEAR(world.kinetic() + contacts.energy().taken, kinetic, 1e-12 * kinetic);
  }
  EXPECT_EQ(most, 18u); // nine nodes of each face
  // Flush edges and corners are thrown back like the middle of the face.
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(world.mesh.v[0][i] - v) > 1e-12 * v)
    {
      EXPECT_NEAR(world.mesh.v[0][i], -v, share / 8 * v);
    }
  EXPECT_LE(world.momentum().norm(), 1e-13 * .02 * double(n) * v);
}

// Everything turned gives everything turned.
TEST(Contact, IsTheSameInATurnedFrame)
{
  const auto turn = hand_made::tilt<3>();
  World<3>   plain, turned;
  for (World<3> *world : {&plain, &turned})
  {
    hand_made::add_box(world->mesh, {.01, .02, .015}, 3, .004, 1);
    const double ways[4][6] = {{.0102, .0203, .0151, -9, -25, -11},
                               {.003, .0209, .002, 12, -30, 5},
                               {.0111, .0009, .0157, -21, 2, -18},
                               {-.0107, -.003, .004, 30, 3, 0}};
    for (const auto &w : ways)
      world->particles.add({w[0], w[1], w[2]}, {w[3], w[4], w[5]}, .002, 0, .0005);
  }
  const auto rotate = [&](hand_made::Arrays<3> &arrays) {
    for (auto *field : {&arrays.x, &arrays.v})
      for (std::size_t i = 0; i < arrays.mass.size(); ++i)
      {
        const Point<3> p = turn * arrays.at(*field, i);
        for (int a = 0; a < 3; ++a)
          (*field)[a][i] = p[a];
      }
  };
  rotate(turned.mesh);
  rotate(turned.particles);
  const double  step = 2e-6;
  ContactSet<3> one({particle_on_mesh(.3)}, {}, step, .9), two({particle_on_mesh(.3)}, {}, step, .9);
  one.start(plain.look());
  two.start(turned.look());
  double heat = 0;
  for (int s = 0; s < 100; ++s)
  {
    plain.step(one, step);
    turned.step(two, step);
    heat = one.energy().friction_heat;
    ASSERT_EQ(one.active(), two.active());
  }
  EXPECT_GT(heat, 0);
  EXPECT_NEAR(two.energy().friction_heat, heat, 1e-10 * heat);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LE((turn * plain.particles.at(plain.particles.v, i) - turned.particles.at(turned.particles.v, i)).norm(),
              1e-9 * 30);
}

// Particles may be put in another order at any time.
TEST(Contact, DoesNotDependOnTheOrderOfParticles)
{
  World<3> kept, mixed;
  for (World<3> *world : {&kept, &mixed})
  {
    hand_made::add_box(world->mesh, {.01, .01, .01}, 2, .004, 1);
    for (int i = 0; i < 6; ++i)
      world->particles.add({-.008 + .003 * i, .001 * i - .002, .0106 + .0001 * i}, {8., 3., -30.}, .002, 0, .0005);
  }
  const double  step = 2e-6;
  ContactSet<3> one({particle_on_mesh(.2)}, {}, step, .9), two({particle_on_mesh(.2)}, {}, step, .9);
  one.start(kept.look());
  two.start(mixed.look());
  for (int s = 0; s < 60; ++s)
  {
    kept.step(one, step);
    auto faces = mixed.look();
    two.gather(faces);
    mixed.mesh.kick_and_drift(step, Point<3>::Zero());
    auto &p = mixed.particles;
    p.kick_and_drift(step, Point<3>::Zero());
    if (s % 7 == 3) // as a solver does within its step
    {
      const auto rotate = [](auto &a) { std::rotate(a.begin(), a.begin() + 1, a.end()); };
      for (int a = 0; a < 3; ++a)
      {
        rotate(p.x[a]);
        rotate(p.v[a]);
        rotate(p.f[a]);
      }
      rotate(p.mass);
      rotate(p.radius);
      rotate(p.body);
      rotate(p.id);
      ++p.topology;
    }
    two.close(mixed.look(), {0, step, step});
  }
  EXPECT_GT(one.energy().friction_heat, 0);
  EXPECT_EQ(one.energy().friction_heat, two.energy().friction_heat);
  EXPECT_EQ(one.energy().taken, two.energy().taken);
  for (std::uint32_t id = 0; id < 6; ++id)
  {
    mixed.look();
    EXPECT_EQ(kept.particles.at(kept.particles.v, id), mixed.particles.at(mixed.particles.v, mixed.index_of_id[id]));
  }
}

TEST(Contact, RestartsToTheBit)
{
  auto make = [] {
    World<3> world;
    hand_made::add_box(world.mesh, {.01, .01, .01}, 2, .004, 1);
    for (int i = 0; i < 6; ++i)
      world.particles.add({-.008 + .003 * i, .001 * i - .002, .0104 + .0001 * i}, {8., 3., -30.}, .002, 0, .0005);
    return world;
  };
  const double  step  = 2e-6;
  World<3>      world = make();
  ContactSet<3> whole({particle_on_mesh(.2)}, {}, step, .9);
  whole.start(world.look());
  for (int s = 0; s < 5; ++s)
    world.step(whole, step);
  ASSERT_GT(whole.active(), 0u);

  hand_made::MemoryArchive archive;
  whole.save(archive, "coupling");
  World<3>      again = make();
  ContactSet<3> resumed({particle_on_mesh(.2)}, {}, 9 * step, .9);
  resumed.start(again.look());
  again = world;
  resumed.load(archive, "coupling");
  EXPECT_EQ(resumed.stable_dt().dt, whole.stable_dt().dt);
  EXPECT_EQ(resumed.force(0, 1), whole.force(0, 1));

  whole.snapshot();
  const World<3> mark = world;
  for (int round = 0; round < 2; ++round) // the second after going back
  {
    for (int s = 0; s < 40; ++s)
      world.step(whole, step);
    if (round == 0)
    {
      whole.restore();
      world = mark;
    }
  }
  for (int s = 0; s < 40; ++s)
    again.step(resumed, step);
  EXPECT_EQ(world.particles.x, again.particles.x);
  EXPECT_EQ(world.mesh.v, again.mesh.v);
  EXPECT_EQ(whole.energy().taken, resumed.energy().taken);
  EXPECT_EQ(whole.energy().friction_heat, resumed.energy().friction_heat);
  EXPECT_EQ(whole.impulse(), resumed.impulse());
}

// Row of the particle: 2 k/m with k = share m_eff/dt^2, so with a plate of
// infinite mass the bound is dt sqrt(2 (1 - f^2)/share), above dt for f = .9.
TEST(Contact, StepBoundOfOneContact)
{
  auto          world = ball_and_plate<2>(40., .003, 1e15);
  ContactSet<2> contacts({particle_on_mesh()}, {}, dt, .9);
  contacts.start(world.look());
  EXPECT_EQ(contacts.stable_dt().dt, std::numeric_limits<double>::infinity());
  while (contacts.active() == 0)
    world.step(contacts, dt);
  EXPECT_NEAR(contacts.stable_dt().dt, dt * std::sqrt(2 * .19 / share), 1e-9 * dt);
  EXPECT_GT(contacts.stable_dt().dt, dt);
  EXPECT_STREQ(contacts.stable_dt().culprit.entity, "contact");
  EXPECT_EQ(contacts.stable_dt().culprit.body, 0);
}

namespace
{
/// Two equal balls, each on a spring of its own that works at the share f of
/// the leapfrog's limit for the step `run_dt`, pressed together; in the mode
/// in which they move against each other contact has w^2 = 2k/m, its bound.
/// Largest excursion from rest over 3000 steps, with a first one of `start`.
double pressed_balls(double share_of_bound, double f, double start)
{
  World<3>     world;
  const double r = .002 * ball_share, m = .003; // where they meet
  world.particles.add(Point<3>(-r - 1e-9, 0, 0), Point<3>::Zero(), m, 0, .002);
  world.particles.add(Point<3>(r + 1e-9, 0, 0), Point<3>::Zero(), m, 1, .002);
  ContactSet<3> contacts({{"balls", 0, 1, particle_party, particle_party, 0, share}}, {}, dt, f);
  contacts.start(world.look());
  const double k      = share * .5 * m / (dt * dt);
  const double run_dt = share_of_bound * 2 * std::sqrt((1 - f * f) / (2 * k / m));
  const double spring = m * std::pow(2 * f / run_dt, 2);
  const double push = 2 * k * 100 * start, depth = 100 * start; // k (2 depth) = push at rest
  const double rest[2] = {-r + depth, r - depth};
  double       largest = 0;
  for (int n = 0; n < 3000; ++n)
  {
    auto faces = world.look();
    if (n == 0)
      for (int i = 0; i < 2; ++i)
        world.particles.x[0][i] = rest[i] + (i == 0 ? start : -start);
    faces.clear_forces();
    contacts.gather(faces);
    for (int i = 0; i < 2; ++i)
      world.particles.f[0][i] += (i == 0 ? push : -push) + spring * (rest[i] - world.particles.x[0][i]);
    if (n == 2)
    {
      EXPECT_NEAR(contacts.stable_dt().dt * share_of_bound, run_dt, 1e-12 * run_dt);
    }
    world.particles.kick_and_drift(run_dt, Point<3>::Zero());
    contacts.close(world.look(), {0, run_dt, run_dt});
    largest = std::max(largest, std::abs(world.particles.x[0][0] - rest[0]));
  }
  return largest;
}
} // namespace

TEST(Contact, StepBoundIsSharpBesideElementsAtTheirOwnBound)
{
  const double start = 1e-5;
  for (const double f : {.7, .9})
  {
    // Below the bound a mode swings within 1/sqrt(1 - (w dt/2)^2) of its start,
    // (w dt/2)^2 = f^2 + .98^2 (1 - f^2); above it grows until the balls part,
    // 100 starts away.
    EXPECT_LT(pressed_balls(.98, f, start), 1.01 * start / std::sqrt((1 - f * f) * (1 - .98 * .98)));
    EXPECT_GT(pressed_balls(1.03, f, start), 50 * start);
  }
}

TEST(Contact, InitialOverlapIsHealedAndReported)
{
  auto world = ball_and_plate<3>(0., .003, .011);
  const Point<3> up = hand_made::tilt<3>() * Point<3>::UnitZ();
  for (int a = 0; a < 3; ++a)
    world.particles.x[a][0] -= .0005 * up[a];
  ContactSet<3> contacts({particle_on_mesh()}, {}, dt, .9);
  contacts.start(world.look());
  ASSERT_EQ(contacts.initial_overlaps().size(), 1u);
  EXPECT_EQ(contacts.initial_overlaps()[0].count, 1u);
  EXPECT_NEAR(contacts.initial_overlaps()[0].worst, .0005, 1e-12);
  for (int n = 0; n < 20; ++n)
    world.step(contacts, dt);
  EXPECT_EQ(world.kinetic(), 0); // nothing pushes them apart

  // Pushed on, it resists from there; pulled out, the reference follows.
  const double push = 7.;
  for (int a = 0; a < 3; ++a)
    world.particles.v[a][0] = -push * up[a];
  for (int n = 0; n < 40; ++n)
    world.step(contacts, dt);
  const double apart =
    (world.particles.at(world.particles.v, 0) - world.mesh.momentum() / .011).dot(up);
  EXPECT_NEAR(apart / push, 1, share / 8 * 1.01);
}

TEST(Contact, DeepInitialOverlapIsAnInputError)
{
  auto           world = ball_and_plate<3>(0., .003, .011);
  const Point<3> up    = hand_made::tilt<3>() * Point<3>::UnitZ();
  for (int a = 0; a < 3; ++a)
    world.particles.x[a][0] -= .0021 * up[a]; // the radius is .002
  ContactSet<3> contacts({particle_on_mesh()}, {}, dt, .9);
  try
  {
    contacts.start(world.look());
    FAIL() << "accepted";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("touch"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("0.0021"), std::string::npos);
  }
}

// Facets on a symmetry plane are cuts: a particle may lie against them.
TEST(Contact, FacetsOnASymmetryPlaneDoNotTouch)
{
  World<2>           world;
  Surface<2>::Facet  facet;
  for (const double y : {-.01, .01}) // upwards: outside on the right, x > 0
    facet.node[y > 0] = world.mesh.add({0, y}, Point<2>::Zero(), 1, 1);
  facet.body = 1;
  world.mesh.facets.push_back(facet);
  world.particles.add({.0012, .001}, {-30, 0}, .001, 0, .001);
  ContactSet<2> open({particle_on_mesh()}, {1}, dt, .9), cut({particle_on_mesh()}, {0}, dt, .9);
  open.start(world.look());
  cut.start(world.look());
  World<2> other = world;
  for (int n = 0; n < 60; ++n)
  {
    world.step(open, dt);
    other.step(cut, dt);
  }
  EXPECT_GT(world.particles.v[0][0], 0);
  EXPECT_EQ(other.particles.v[0][0], -30);
}
} // namespace ogive::coupling
