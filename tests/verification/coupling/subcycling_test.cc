// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "tests/unit/coupling/hand_made.h"
#include "tests/verification/coupling/support.h"

#include <gtest/gtest.h>

#include <cmath>

/// Several steps of one solver in one of the other (coupling/subcycling.h).
namespace ogive::coupling
{
namespace
{
using scenes::add_box;
using scenes::Driver;
using scenes::steel_scene;

constexpr double length = .1, speed = 12;

/// A bar flies into a wall: struck half particles of `dx`, rear half elements of `size`.
input::Scene split_bar(double dx, double size)
{
  auto scene = steel_scene(input::Dimension::uniaxial);
  add_box(scene, "zone", input::Method::sph, {0, 0, 0}, {.5 * length, 0, 0}, dx, {-speed, 0, 0});
  add_box(scene, "rest", input::Method::fem, {.5 * length, 0, 0}, {length, 0, 0}, size, {-speed, 0, 0});
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  scene.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitX(), Vec3::Zero(), 0});
  return scene;
}

/// A block of small elements hits one of larger particles, or the reverse, and
/// a tied seam behind the particles.
input::Scene free_impact(double particles, double elements)
{
  auto         scene = steel_scene(input::Dimension::plane_strain);
  const double a = 2e-3;
  add_box(scene, "striker", input::Method::fem, {a, 4.05 * a, 0}, {4 * a, 7.05 * a, 0}, elements, {20, -110, 0});
  add_box(scene, "zone", input::Method::sph, {0, 2 * a, 0}, {5 * a, 4 * a, 0}, particles, {0, 0, 0});
  add_box(scene, "rest", input::Method::fem, {0, 0, 0}, {5 * a, 2 * a, 0}, a, {0, 0, 0});
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  scene.contacts.push_back({"hit", "striker", "zone", .15, .1});
  return scene;
}

input::Scene with_parts(input::Scene scene, const std::string &who, double steps)
{
  scene.subcycling.who   = who;
  scene.subcycling.steps = steps;
  return scene;
}

struct Rebound
{
  double contact = 0, velocity = 0; ///< over 2 L/c_L and the speed of arrival
  double error = 0, drift = 0;      ///< largest interface_work and drift, of the initial kinetic energy
  int    most  = 0;                 ///< parts of a step
};

Rebound rebound(const input::Scene &scene)
{
  const auto  &m     = scene.materials.front();
  const double c     = std::sqrt((m.eos.bulk_modulus + 4 * m.shear_modulus / 3) / m.density);
  const double exact = 2 * length / c;
  Driver<1>    bar(scene);
  auto         row = bar.model.ledger();
  const double kinetic = row.kinetic, total = row.total, mass = row.mass;
  Rebound      out;
  double       touch = -1, leave = 0;
  while (bar.time < 1.4 * exact)
  {
    const double before = bar.time;
    bar.step();
    EXPECT_EQ(bar.model.review(), "");
    if (bar.model.wall_forces()[0] > .01 * m.density * c * speed)
    {
      touch = touch < 0 ? before : touch;
      leave = bar.time;
    }
    row       = bar.model.ledger();
    out.most  = std::max(out.most, static_cast<int>(bar.model.parts()));
    out.error = std::max(out.error, std::abs(row.interface_work) / kinetic);
    out.drift = std::max(out.drift, std::abs(row.total - row.interface_work - total) / kinetic);
  }
  out.contact  = (leave - touch) / exact;
  out.velocity = row.momentum[0] / (mass * speed);
  return out;
}

void expect_same(const input::Scene &one, const input::Scene &other, int steps)
{
  Driver<2> a(one), b(other);
  for (int n = 0; n < steps; ++n)
  {
    a.step();
    b.step();
    ASSERT_EQ(b.model.parts(), 1u);
  }
  EXPECT_GT(a.model.contact_force(), 0);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.model.ledger().values(), b.model.ledger().values());
  for (int body = 0; body < 3; ++body)
  {
    EXPECT_EQ(a.model.sample(body).x, b.model.sample(body).x);
    EXPECT_EQ(a.model.sample(body).v, b.model.sample(body).v);
  }
}
} // namespace

// Where the finer solver needs no more steps than the other, the way through
// parts is the plain one.
TEST(Subcycling, OnePartIsThePlainStepToTheBit)
{
  const auto small_particles = free_impact(.5e-3, 2e-3);
  expect_same(small_particles, with_parts(small_particles, "elements", 4), 60);
  auto small_elements = free_impact(2e-3, .5e-3);
  small_elements.interfaces.clear(); // with it the mesh would keep a larger distance from its bound
  expect_same(small_elements, with_parts(small_elements, "particles", 4), 60);
}

// Each pair of forces acts over the same kick.
TEST(Subcycling, KeepsMomentumToRoundingEitherWay)
{
  for (const auto &scene : {with_parts(free_impact(.5e-3, 2e-3), "particles", 2), with_parts(free_impact(.5e-3, 2e-3), "particles", 8),
                            with_parts(free_impact(2e-3, .5e-3), "elements", 2), with_parts(free_impact(2e-3, .5e-3), "elements", 8)})
  {
    Driver<2>   run(scene);
    const auto  before = run.model.ledger();
    std::size_t most   = 0;
    bool        touched = false;
    for (int n = 0; n < 80; ++n)
    {
      run.step();
      most    = std::max(most, run.model.parts());
      touched = touched || run.model.contact_force() > 0;
      EXPECT_LE((run.model.ledger().momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
    }
    EXPECT_TRUE(touched);
    EXPECT_GE(most, 2u);
    const auto row = run.model.ledger();
    EXPECT_LE(std::abs(row.total + row.contact_loss - row.interface_work - before.total), 1e-12 * before.kinetic);
  }
}

// Particles a quarter of the elements, so their steps are about a seventh.
TEST(Subcycling, ManyStepsOfParticlesLeaveTheReboundAsItIs)
{
  const auto scene = split_bar(.125e-3, .5e-3);
  const auto plain = rebound(scene);
  for (const double steps : {2., 4., 8.})
  {
    const auto parts = rebound(with_parts(scene, "particles", steps));
    EXPECT_GE(parts.most, std::min(steps, 6.));
    EXPECT_NEAR(parts.contact, plain.contact, .005);
    EXPECT_NEAR(parts.velocity, plain.velocity, .005);
    EXPECT_LE(parts.error, .005);
    EXPECT_LE(parts.drift, 1e-12);
  }
}

// A tail of elements a fifth of the others, so that tied particles are the coarse side.
TEST(Subcycling, ManyStepsOfElementsLeaveTheReboundAsItIs)
{
  auto scene = split_bar(.5e-3, .5e-3);
  scene.bodies[1].shape.upper[0] = .9 * length;
  add_box(scene, "tail", input::Method::fem, {.9 * length, 0, 0}, {length, 0, 0}, .1e-3, {-speed, 0, 0});
  input::Interface tie;
  tie.name   = "tie";
  tie.slave  = "tail";
  tie.master = "rest";
  scene.interfaces.push_back(tie);
  const auto plain = rebound(scene);
  for (const double steps : {2., 4., 8.})
  {
    const auto parts = rebound(with_parts(scene, "elements", steps));
    EXPECT_GE(parts.most, 2);
    EXPECT_NEAR(parts.contact, plain.contact, .005);
    EXPECT_NEAR(parts.velocity, plain.velocity, .005);
    EXPECT_LE(parts.error, .005);
    EXPECT_LE(parts.drift, 1e-12);
  }
}

// Equal bars that meet exchange their velocities (the wave equation).
TEST(Subcycling, BarsThatMeetExchangeTheirVelocitiesEitherWay)
{
  for (const std::string who : {"particles", "elements"})
  {
    auto         scene = steel_scene(input::Dimension::uniaxial);
    const double fine = .1e-3, coarse = .5e-3;
    add_box(scene, "left", input::Method::sph, {0, 0, 0}, {.05, 0, 0}, who == "particles" ? fine : coarse, {speed, 0, 0});
    add_box(scene, "right", input::Method::fem, {.0501, 0, 0}, {.1001, 0, 0}, who == "particles" ? coarse : fine, {0, 0, 0});
    scene.contacts.push_back({"hit", "left", "right", 0, .1});
    double plain = 0;
    for (const double steps : {1., 2., 4., 8.})
    {
      Driver<1>   run(steps > 1 ? with_parts(scene, who, steps) : scene);
      const auto  before = run.model.ledger();
      std::size_t most   = 0;
      while (run.time < 40e-6)
      {
        run.step();
        EXPECT_EQ(run.model.review(), "");
        most = std::max(most, run.model.parts());
      }
      const auto   row    = run.model.ledger();
      const auto   right  = run.model.sample(1);
      double       impulse = 0;
      for (std::size_t k = 0; k < right.mass.size(); ++k)
        impulse += right.mass[k] * right.v[0][k];
      const double passed = impulse / before.momentum[0];
      if (steps == 1)
        plain = passed;
      EXPECT_NEAR(passed, plain, .005);
      EXPECT_GE(most, std::min(static_cast<std::size_t>(steps), std::size_t(3)));
      EXPECT_LE(std::abs(row.momentum[0] - before.momentum[0]), 1e-12 * before.momentum[0]);
      EXPECT_LE(std::abs(row.interface_work), .005 * before.kinetic);
    }
  }
}

TEST(Subcycling, GoesOnAfterACheckpointToTheBit)
{
  for (const auto &scene : {with_parts(free_impact(.5e-3, 2e-3), "particles", 4), with_parts(free_impact(2e-3, .5e-3), "elements", 4)})
  {
    Driver<2>                whole(scene), resumed(scene), again(scene);
    hand_made::MemoryArchive archive;
    for (int n = 0; n < 40; ++n)
      whole.step();
    ASSERT_GT(whole.model.parts(), 1u);
    whole.model.save(archive);
    resumed.model.load(archive);
    resumed.time = whole.time;
    resumed.last = whole.last;
    // A step that was rejected: back to the mark.
    whole.model.snapshot();
    const double time = whole.time, last = whole.last;
    whole.step();
    whole.model.restore();
    whole.time = time;
    whole.last = last;
    for (int n = 0; n < 20; ++n)
    {
      whole.step();
      resumed.step();
    }
    EXPECT_EQ(whole.time, resumed.time);
    EXPECT_EQ(whole.model.ledger().values(), resumed.model.ledger().values());
    for (int body = 0; body < 3; ++body)
      EXPECT_EQ(whole.model.sample(body).x, resumed.model.sample(body).x);
  }
}

TEST(Subcycling, EndsWhenItsErrorPassesTheLimit)
{
  auto scene                    = with_parts(split_bar(.25e-3, .5e-3), "particles", 4);
  scene.subcycling.energy_limit = 1e-9;
  Driver<1> bar(scene);
  int       warnings = 0, n = 0;
  for (; n < 2000 && warnings == 0; ++n)
  {
    bar.step();
    warnings += !bar.model.review().empty();
  }
  ASSERT_EQ(warnings, 1);
  const double whole = bar.last;
  for (int k = 0; k < 20; ++k)
  {
    bar.step();
    EXPECT_EQ(bar.model.review(), "");
    EXPECT_EQ(bar.model.parts(), 1u);
  }
  EXPECT_LT(bar.last, .7 * whole);
}

// who = auto: by the bounds of the first state.
TEST(Subcycling, AutoIsWhoeverHasTheSmallerBound)
{
  const auto settled = [](double elements, double particles, bool wait = true) {
    input::Subcycling given;
    given.who = "auto";
    return Subcycling::settled(given, elements, particles, wait);
  };
  EXPECT_EQ(settled(1, 3.5).who, "elements");
  EXPECT_EQ(settled(1, 3.5).steps, 3);
  EXPECT_EQ(settled(3.5, 1).who, "particles");
  EXPECT_EQ(settled(100, 1).steps, 8);
  EXPECT_EQ(settled(1, 1.9).who, "none");
  EXPECT_EQ(settled(3.5, 1, false).who, "none");
  EXPECT_EQ(settled(1, 3.5, false).who, "elements");

  auto scene           = split_bar(.125e-3, .5e-3);
  const auto plain     = rebound(scene);
  scene.subcycling.who = "auto";
  const auto parts     = rebound(scene);
  EXPECT_EQ(Model<1>(scene).subcycling().who(), "particles");
  EXPECT_GE(parts.most, 4);
  EXPECT_NEAR(parts.velocity, plain.velocity, .005); // as with the named ones
  EXPECT_LE(parts.drift, 1e-12);
  auto alone = scene;
  alone.bodies.erase(alone.bodies.begin());
  alone.interfaces.clear();
  EXPECT_EQ(Model<1>(alone).subcycling().who(), "none");
}

namespace
{
/// A block of small elements hits one of large ones, all by their own steps; a
/// zone of particles is tied to the large ones, where `zone`.
input::Scene uneven_impact(const std::string &ratio, bool zone)
{
  auto         scene = steel_scene(input::Dimension::plane_strain);
  const double a = 2e-3;
  add_box(scene, "striker", input::Method::fem, {a, 4.02 * a, 0}, {3 * a, 5.02 * a, 0}, a / 6, {20, -110, 0});
  add_box(scene, "rest", input::Method::fem, {0, 2 * a, 0}, {4 * a, 4 * a, 0}, a, {0, 0, 0});
  scene.contacts.push_back({"hit", "striker", "rest", .15, .1});
  if (zone)
  {
    add_box(scene, "zone", input::Method::sph, {0, a, 0}, {4 * a, 2 * a, 0}, a / 2, {0, 0, 0});
    scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  }
  scene.fem.local_steps = ratio;
  return scene;
}
} // namespace

// Contact and seams push as elements of the coarsest class do: over the whole step.
TEST(LocalSteps, BooksCloseAcrossContactAndSeams)
{
  for (const bool zone : {false, true})
  {
    Driver<2>  run(uneven_impact("8", zone));
    const auto before  = run.model.ledger();
    bool       touched = false;
    ASSERT_GE(run.model.local_plan().elements.size(), 3u);
    for (int n = 0; n < 60; ++n)
    {
      run.step();
      touched |= run.model.contact_force() > 0;
      const auto row = run.model.ledger();
      ASSERT_LE((row.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
      ASSERT_LE(std::abs(row.total + row.contact_loss - row.interface_work - before.total), 1e-12 * before.kinetic);
    }
    EXPECT_TRUE(touched);
    EXPECT_NE(run.model.ledger().interface_work, 0);
  }
}

// The same blow with one step for all: what the struck block has in the end. The
// stiffness of contact goes with 1/step^2; both get that of the longer step.
TEST(LocalSteps, PassOnTheSameMomentum)
{
  const double longer = Model<2>(uneven_impact("8", false)).stable_dt().dt / Model<2>(uneven_impact("none", false)).stable_dt().dt;
  EXPECT_GT(longer, 3);
  double passed[2];
  for (const bool local : {false, true})
  {
    auto scene = uneven_impact(local ? "8" : "none", false);
    scene.subcycling.energy_limit = .05;
    if (!local)
      scene.contacts[0].stiffness /= longer * longer;
    Driver<2> run(scene);
    while (run.time < 6e-6) // a wave goes four times through the striker
      run.step();
    const auto rest = run.model.sample(1);
    passed[local]   = 0;
    for (std::size_t k = 0; k < rest.mass.size(); ++k)
      passed[local] += rest.mass[k] * rest.v[1][k];
  }
  EXPECT_NEAR(passed[1] / passed[0], 1, .02); // two elements across the struck block
}

// With "auto" contact keeps its stiffness.
TEST(LocalSteps, AutoLeavesElementsInContactAlone)
{
  EXPECT_FALSE(Model<2>(uneven_impact("auto", false)).local_plan().on);
  auto apart = uneven_impact("auto", false);
  apart.contacts.clear();
  EXPECT_TRUE(Model<2>(apart).local_plan().on);
}

TEST(LocalSteps, EndByTheirErrorOnceAndGoOnAfterACheckpoint)
{
  auto scene                    = uneven_impact("8", false);
  scene.subcycling.energy_limit = 1e-5;
  Driver<2>                whole(scene), resumed(scene);
  hand_made::MemoryArchive archive;
  for (int n = 0; n < 2; ++n)
    whole.step();
  whole.model.save(archive);
  resumed.model.load(archive);
  resumed.time = whole.time;
  resumed.last = whole.last;
  int warnings = 0, again = 0;
  for (int n = 0; n < 80; ++n)
  {
    whole.step();
    resumed.step();
    warnings += !whole.model.review().empty();
    again += !resumed.model.review().empty();
  }
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(again, 1);
  EXPECT_EQ(whole.model.local_plan().elements.size(), 1u);
  EXPECT_EQ(whole.time, resumed.time);
  EXPECT_EQ(whole.model.ledger().values(), resumed.model.ledger().values());
}

TEST(Subcycling, RefusesWhatCannotBe)
{
  auto scene = with_parts(split_bar(.25e-3, .5e-3), "particles", 2.5);
  EXPECT_THROW(Model<1>{scene}, InputError);
  scene = with_parts(split_bar(.25e-3, .5e-3), "particles", 2);
  scene.bodies.erase(scene.bodies.begin());
  scene.interfaces.clear();
  EXPECT_THROW(Model<1>{scene}, InputError);
}
} // namespace ogive::coupling
