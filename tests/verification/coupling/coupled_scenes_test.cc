// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/unit/coupling/hand_made.h"
#include "tests/verification/coupling/support.h"

#include <gtest/gtest.h>

namespace ogive::coupling
{
namespace
{
using scenes::add_box;
using scenes::Driver;
using scenes::steel_scene;

double sound_speed(const input::Scene &scene)
{
  const auto &m = scene.materials.front();
  return std::sqrt((m.eos.bulk_modulus + 4 * m.shear_modulus / 3) / m.density);
}

/// A striker of elements hits a block whose struck half is particles tied to
/// elements; nothing holds them.
input::Scene free_impact()
{
  auto         scene = steel_scene(input::Dimension::three_d);
  const double a = 2e-3;
  add_box(scene, "striker", input::Method::fem, {a, a, 4.1 * a}, {4 * a, 3 * a, 7.1 * a}, a, {20, -15, -110});
  add_box(scene, "zone", input::Method::sph, {0, 0, 2 * a}, {5 * a, 4 * a, 4 * a}, .5 * a, {0, 0, 0});
  add_box(scene, "rest", input::Method::fem, {0, 0, 0}, {5 * a, 4 * a, 2 * a}, a, {0, 0, 0});
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  scene.contacts.push_back({"hit", "striker", "zone", .15, .1});
  return scene;
}
} // namespace

// Split half-way into particles and elements, the bar is still a bar: contact
// for 2 L/c_L and rebound at the speed of arrival (St Venant), within the 2 %
// that the tied interface is held to. The step wave is a front to the viscosity
// of the particles: at .5 mm that alone takes 2.4 % of the rebound.
TEST(SplitBar, ContactTimeReboundAndBooks)
{
  auto         scene = steel_scene(input::Dimension::uniaxial);
  const double length = .1, v0 = 12, dx = .25e-3;
  add_box(scene, "zone", input::Method::sph, {0, 0, 0}, {.5 * length, 0, 0}, dx, {-v0, 0, 0});
  add_box(scene, "rest", input::Method::fem, {.5 * length, 0, 0}, {length, 0, 0}, dx, {-v0, 0, 0});
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  scene.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitX(), Vec3::Zero(), 0});
  Driver<1>    bar(scene);
  const double exact = 2 * length / sound_speed(scene);
  Ledger       ledger;
  auto         row   = bar.model.ledger();
  ledger.enter(row);
  const double mass  = row.mass;
  double       touch = -1, leave = 0;
  while (bar.time < 1.4 * exact)
  {
    const double before = bar.time;
    bar.step();
    if (bar.model.wall_forces()[0] > .01 * 7850 * sound_speed(scene) * v0)
    {
      touch = touch < 0 ? before : touch;
      leave = bar.time;
    }
    row = bar.model.ledger();
    ledger.enter(row);
  }
  EXPECT_NEAR((leave - touch) / exact, 1, .02);
  EXPECT_NEAR(row.momentum[0] / (mass * v0), 1, .02);
  EXPECT_NEAR(row.mass, 7850 * length, 1e-9 * row.mass);
  EXPECT_LE(std::abs(ledger.worst_drift()), 1e-3);
  EXPECT_LE(std::abs(row.interface_work), 1e-12 * .5 * mass * v0 * v0);
  RecordProperty("contact_time", std::to_string((leave - touch) / exact));
  RecordProperty("rebound", std::to_string(row.momentum[0] / (mass * v0)));
  RecordProperty("drift", std::to_string(ledger.worst_drift()));
}

TEST(FreeImpact, KeepsMomentumToRoundingAndItsBooks)
{
  Driver<3> run(free_impact());
  Ledger    ledger;
  auto      row = run.model.ledger();
  ledger.enter(row);
  const Vec3 momentum = row.momentum, angular = row.angular_momentum;
  bool       touched = false;
  for (int n = 0; n < 120; ++n)
  {
    run.step();
    touched = touched || run.model.contact_force() > 0;
  }
  row = run.model.ledger();
  ledger.enter(row);
  EXPECT_TRUE(touched);
  EXPECT_GT(row.viscosity_heat + row.elastic, .01 * row.kinetic);
  EXPECT_LE((row.momentum - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LE(std::abs(ledger.worst_drift()), .01) << ledger.fault(.01);
  RecordProperty("momentum", std::to_string(1e15 * (row.momentum - momentum).norm() / momentum.norm()));
  RecordProperty("angular", std::to_string(1e9 * (row.angular_momentum - angular).norm() / angular.norm()));
  RecordProperty("drift", std::to_string(ledger.worst_drift()));
}

TEST(FreeImpact, RestartsToTheBitThroughContact)
{
  const auto               scene = free_impact();
  Driver<3>                whole(scene), resumed(scene);
  hand_made::MemoryArchive archive;
  for (int n = 0; n < 30; ++n)
    whole.step();
  ASSERT_GT(whole.model.contact_force(), 0);
  whole.model.save(archive);
  resumed.model.load(archive);
  resumed.time = whole.time;
  resumed.last = whole.last;
  for (int n = 0; n < 30; ++n)
  {
    whole.step();
    resumed.step();
  }
  EXPECT_EQ(whole.time, resumed.time);
  EXPECT_EQ(whole.model.ledger().values(), resumed.model.ledger().values());
  for (int body = 0; body < 3; ++body)
    EXPECT_EQ(whole.model.sample(body).x, resumed.model.sample(body).x);
}
} // namespace ogive::coupling
