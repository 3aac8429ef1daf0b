// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/memory_archive.h"
#include "tests/verification/coupling/support.h"

#include <cmath>

/// Contact goes on while elements of one side die.
namespace ogive::coupling
{
namespace
{
using input::Dimension;
using input::Method;

/// A striker of 4 mm radius (3-D: a box of 6 x 6 mm, elements of 1 mm) at 600 m/s
/// and a plate of 3 mm whose elements die at a plastic strain of .3, free at its rim.
/// `itself`: the plate's fragments touch each other.
input::Scene strike(Dimension dimension, Method striker, bool itself = false)
{
  auto  scene                      = scenes::steel_scene(dimension);
  auto &steel                      = scene.materials.front();
  steel.strength.law               = "linear-hardening";
  steel.strength.yield_stress      = 400e6;
  steel.strength.hardening_modulus = 500e6;
  if (dimension == Dimension::three_d)
  {
    scenes::add_box(scene, "striker", striker, {-3e-3, -3e-3, .1e-3}, {3e-3, 3e-3, 10.1e-3}, 1e-3, {0, 0, -600});
    scenes::add_box(scene, "plate", Method::fem, {-8e-3, -8e-3, -3e-3}, {8e-3, 8e-3, 0}, 1e-3, Vec3::Zero());
  }
  else
  {
    scenes::add_box(scene, "striker", striker, {0, .1e-3, 0}, {4e-3, 16.1e-3, 0}, .5e-3, {0, -600, 0});
    scenes::add_box(scene, "plate", Method::fem, {0, -3e-3, 0}, {15e-3, 0, 0}, .5e-3, Vec3::Zero());
  }
  scene.bodies.back().erosion = {true, .3, 0};
  scene.contacts.push_back({"touch", "striker", "plate", 0, .1});
  if (itself)
    scene.contacts.push_back({"fragments", "plate", "plate", .1, .1});
  return scene;
}

/// It goes through: behind the plate in the end, with what the plate left it.
/// Bar: the books of contact, as without deaths.
template <int dim>
void expect_through(Dimension dimension, Method striker, bool itself = false)
{
  scenes::Driver<dim> run(strike(dimension, striker, itself));
  Ledger              ledger;
  auto                row = run.model.ledger();
  ledger.enter(row);
  const auto   first      = row;
  double       last_force = 0, last_death = 0, deaths = 0;
  const double end = dim == 3 ? 22e-6 : 36e-6;
  while (run.time < end)
  {
    run.step();
    if (run.model.contact_force() > 0)
      last_force = run.time;
    row = run.model.ledger();
    ledger.enter(row);
    if (row.eroded_elements > deaths)
      last_death = run.time;
    deaths = row.eroded_elements;
  }
  EXPECT_GT(deaths, 20);
  EXPECT_GT(last_force, 5e-6);
  EXPECT_GT(last_death, 5e-6);
  EXPECT_LE(std::abs(row.mass - first.mass), 1e-13 * first.mass);
  EXPECT_LE((row.momentum - first.momentum).norm(), 1e-12 * first.momentum.norm());
  EXPECT_LE(std::abs(ledger.worst_drift()), 3e-3) << ledger.fault(3e-3);
  const auto sample = run.model.sample(0);
  double     speed = 0, mass = 0, tail = 0;
  for (std::size_t i = 0; i < sample.mass.size(); ++i)
  {
    speed -= sample.mass[i] * sample.v[dim - 1][i];
    mass += sample.mass[i];
    tail = std::max(tail, sample.x[dim - 1][i]);
  }
  EXPECT_LT(tail, 16.1e-3 - .6 * 600 * end);
  EXPECT_GT(speed / mass, .6 * 600);
  EXPECT_LT(speed / mass, .95 * 600);
  testing::Test::RecordProperty("drift", std::to_string(ledger.worst_drift()));
  testing::Test::RecordProperty("deaths", std::to_string(deaths));
  testing::Test::RecordProperty("speed", std::to_string(speed / mass));
}
} // namespace

TEST(ErodingPlate, MeshGoesThroughInAxialSymmetry) { expect_through<2>(Dimension::axisymmetric, Method::fem); }
TEST(ErodingPlate, ParticlesGoThroughInAxialSymmetry) { expect_through<2>(Dimension::axisymmetric, Method::sph); }
TEST(ErodingPlate, MeshGoesThroughInThreeDimensions) { expect_through<3>(Dimension::three_d, Method::fem); }
TEST(ErodingPlate, ParticlesGoThroughInThreeDimensions) { expect_through<3>(Dimension::three_d, Method::sph); }

// With the plug and what is left of the plate in contact.
TEST(ErodingPlate, PlugRubsInAxialSymmetry) { expect_through<2>(Dimension::axisymmetric, Method::fem, true); }
TEST(ErodingPlate, FragmentsTouchInThreeDimensions) { expect_through<3>(Dimension::three_d, Method::fem, true); }

// To the bit through deaths under contact: from a checkpoint, and after a step
// that was taken back together with those who had died in it.
TEST(ErodingPlate, RestartAndRejectedStepAreBitwise)
{
  const auto        scene = strike(Dimension::axisymmetric, Method::fem, true);
  scenes::Driver<2> whole(scene), resumed(scene);
  const auto        dead = [](const auto &run) { return run.model.ledger().eroded_elements; };
  while (dead(whole) < 5)
    whole.step();
  io::MemoryArchive archive;
  whole.model.save(archive);
  resumed.model.load(archive);
  resumed.time = whole.time;
  resumed.last = whole.last;
  int rejected = 0;
  for (int n = 0; n < 300; ++n)
  {
    whole.step();
    const auto   time = resumed.time, last = resumed.last;
    const double before = dead(resumed);
    resumed.model.snapshot();
    resumed.step();
    if (dead(resumed) == before)
      continue;
    ++rejected;
    resumed.model.restore();
    resumed.time = time;
    resumed.last = last;
    EXPECT_EQ(dead(resumed), before);
    resumed.step();
  }
  EXPECT_GT(rejected, 5);
  EXPECT_EQ(whole.time, resumed.time);
  EXPECT_EQ(whole.model.ledger().values(), resumed.model.ledger().values());
  for (int body = 0; body < 2; ++body)
    EXPECT_EQ(whole.model.sample(body).x, resumed.model.sample(body).x);
}
} // namespace ogive::coupling
