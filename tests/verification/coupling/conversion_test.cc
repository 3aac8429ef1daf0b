// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/memory_archive.h"
#include "tests/verification/coupling/support.h"

#include <cmath>
#include <numbers>

/// A body turns wholly into particles in flight. Conserved amounts are exact, so
/// the bars are those of the plan: mass and linear momentum to 1e-13, angular
/// momentum and total energy, conversion heat included, to 1e-12.
namespace ogive::coupling
{
namespace
{
using input::Dimension;
using input::Method;

/// A bound of the step that every element is below: all of them convert at the
/// first look.
constexpr double at_once = 1;

input::Scene block(Dimension dimension, double per_edge)
{
  auto       scene = scenes::steel_scene(dimension);
  const bool ring  = dimension == Dimension::axisymmetric;
  const bool flat  = dimension != Dimension::three_d;
  const Vec3 lower(ring ? 0 : -4e-3, -2e-3, flat ? 0 : -2e-3), upper(4e-3, 2e-3, flat ? 0 : 3e-3);
  scenes::add_box(scene, "block", Method::automatic, lower, upper, 1e-3, {ring ? 0. : 30., 20, flat ? 0. : -10.});
  auto &body = scene.bodies.front();
  if (!ring)
    body.spin = flat ? Vec3(0, 0, 5e3) : Vec3(2e3, -1e3, 4e3);
  body.conversion.per_edge = per_edge;
  return scene;
}

/// A round body: the elements of its mesh are distorted.
input::Scene drum(Dimension dimension, double per_edge)
{
  auto  scene      = block(dimension, per_edge);
  auto &shape      = scene.bodies.front().shape;
  shape.kind       = input::ShapeKind::disc;
  shape.base       = Vec3(1e-3, 2e-3, dimension == Dimension::three_d ? -1e-3 : 0);
  shape.axis       = Vec3::UnitZ();
  shape.radius     = 4e-3;
  shape.length     = 3e-3;
  return scene;
}

void expect_kept(const LedgerRow &before, const LedgerRow &after)
{
  const double momentum = std::sqrt(2 * before.mass * before.kinetic);
  EXPECT_LE(std::abs(after.mass - before.mass), 1e-13 * before.mass);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13 * momentum);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), 1e-12 * before.angular_momentum.norm());
  EXPECT_LE(std::abs(after.total - before.total), 1e-12 * before.total);
  EXPECT_EQ(after.hourglass_fem, 0);
}

/// Flies 30 steps as elements, converts, flies on; once converted, energy stays
/// as that of particles does (bar 1e-11, as of any run without contact).
template <int dim>
void expect_converts(input::Scene scene, double per_edge)
{
  SCOPED_TRACE(std::to_string(static_cast<int>(per_edge)) + " an edge");
  scene.bodies.front().conversion.step = at_once;
  scenes::Driver<dim> run(scene);
  for (int k = 0; k < 30; ++k)
    run.step();
  const auto        before   = run.model.ledger();
  const std::size_t elements = run.model.elements();
  const auto        events   = run.model.convert(30, run.time);
  const auto        after    = run.model.ledger();
  expect_kept(before, after);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].elements, static_cast<double>(elements));
  EXPECT_EQ(run.model.elements(), 0u);
  EXPECT_EQ(run.model.particles(), events[0].particles);
  EXPECT_EQ(after.conversion_heat, events[0].heat);
  EXPECT_EQ(after.eroded_elements, 0);
  EXPECT_EQ(run.model.sample(0).mass.size(), run.model.particles());
  EXPECT_TRUE(run.model.convert(31, run.time).empty()); // nothing is left
  for (int k = 0; k < 20; ++k)
    run.step();
  const auto last = run.model.ledger();
  EXPECT_LE(std::abs(last.total - before.total), 1e-11 * before.total);
  EXPECT_LE(std::abs(last.mass - before.mass), 1e-13 * before.mass);
  EXPECT_LE((last.momentum - before.momentum).norm(), 1e-12 * std::sqrt(2 * before.mass * before.kinetic));
}

/// To the bit, sample and books.
template <int dim>
void expect_equal(const Model<dim> &a, const Model<dim> &b)
{
  EXPECT_EQ(a.ledger().values(), b.ledger().values());
  const Sample p = a.sample(0), q = b.sample(0);
  EXPECT_EQ(p.x, q.x);
  EXPECT_EQ(p.v, q.v);
  EXPECT_EQ(p.energy, q.energy);
  EXPECT_EQ(p.sigma, q.sigma);
}
} // namespace

TEST(Conversion, SpinningBlockInThePlane)
{
  for (const double n : {1., 2., 3.})
    expect_converts<2>(block(Dimension::plane_strain, n), n);
}

TEST(Conversion, SpinningDrumInThePlane)
{
  for (const double n : {1., 2., 3.})
    expect_converts<2>(drum(Dimension::plane_strain, n), n);
}

TEST(Conversion, FlyingRing)
{
  for (const double n : {1., 2., 3.})
    expect_converts<2>(block(Dimension::axisymmetric, n), n);
}

TEST(Conversion, SpinningBlockInSpace)
{
  for (const double n : {1., 2., 3.})
    expect_converts<3>(block(Dimension::three_d, n), n);
}

TEST(Conversion, SpinningDrumInSpace)
{
  for (const double n : {1., 2.})
    expect_converts<3>(drum(Dimension::three_d, n), n);
}

// A zone of particles from the start: the centres of 4 x 4 elements lie within
// 2.2 mm of the origin but for their corners ((1.5, 1.5) mm is 2.12 mm away,
// (2.5, .5) 2.55): 16 of 8 x 4. No event, no heat, and a seam that is no surface.
TEST(Conversion, ZoneFromTheStart)
{
  auto scene                              = block(Dimension::plane_strain, 2);
  scene.bodies.front().conversion.zone_radius = 2.2e-3;
  Model<2> model(scene);
  EXPECT_EQ(model.elements(), 16u);
  EXPECT_EQ(model.particles(), 64u);
  EXPECT_EQ(model.ledger().conversion_heat, 0);
  auto all                                    = block(Dimension::plane_strain, 2);
  const LedgerRow zoned = model.ledger(), whole = Model<2>(all).ledger();
  EXPECT_NEAR(zoned.mass, whole.mass, 1e-13 * whole.mass);
  EXPECT_LE((zoned.angular_momentum - whole.angular_momentum).norm(), 1e-12 * whole.angular_momentum.norm());
  const Sample both = model.sample(0);
  double       mass = 0, volume = 0;
  for (const double m : both.mass)
    mass += m;
  for (const double v : both.volume)
    volume += v;
  EXPECT_NEAR(mass, whole.mass, 1e-13 * mass);
  EXPECT_NEAR(volume, 32e-6, 1e-13); // m^2
  EXPECT_EQ(both.density.size(), 16u + 64u);
  EXPECT_EQ(both.half_cell[0].size(), both.mass.size());
}

// Layers: one element (of 8 x 4, that at (-.5, -.5) mm) is the zone's only one;
// a strain nobody has converts none; elements at a fixed face stay.
TEST(Conversion, ElementsAtABoundaryStay)
{
  auto  scene          = block(Dimension::plane_strain, 1);
  auto &body           = scene.bodies.front();
  body.conversion.step = at_once;
  body.spin.setZero();
  input::Boundary clamp;
  clamp.name = "clamp";
  clamp.body = "block";
  clamp.face = "x-";
  clamp.kind = input::BoundaryKind::fixed;
  scene.boundaries.push_back(clamp);
  Model<2> model(scene);
  model.convert(1, 0);
  EXPECT_EQ(model.elements(), 4u); // the column at x-
  EXPECT_EQ(model.particles(), 28u);
}

TEST(Conversion, NothingConvertsBelowItsMeasures)
{
  Model<2> model(block(Dimension::plane_strain, 1));
  EXPECT_TRUE(model.convert(1, 0).empty());
  EXPECT_EQ(model.particles(), 0u);
}

// A step that is taken back, and a run that goes on from a checkpoint, before
// and after the event.
TEST(Conversion, RestartAndRejectedStepAreBitwise)
{
  auto scene = block(Dimension::plane_strain, 2);
  scene.bodies.front().conversion.step = at_once;
  scenes::Driver<2> whole(scene), before(scene), after(scene);
  const auto        take = [](scenes::Driver<2> &run, int n) {
    for (int k = 0; k < n; ++k)
      run.step();
  };
  const auto go_on = [&](scenes::Driver<2> &run) {
    io::MemoryArchive archive;
    whole.model.save(archive);
    run.model.load(archive);
    run.time = whole.time;
    run.last = whole.last;
  };
  take(whole, 10);
  go_on(before);
  for (auto *run : {&whole, &before})
  {
    take(*run, 3);
    EXPECT_EQ(run->model.convert(13, run->time).size(), 1u);
    take(*run, 3);
  }
  expect_equal(whole.model, before.model);
  go_on(after);
  after.model.snapshot();
  const auto time = after.time, last = after.last;
  take(after, 4);
  after.model.restore();
  after.time = time;
  after.last = last;
  take(whole, 5);
  take(after, 5);
  expect_equal(whole.model, after.model);
}
} // namespace ogive::coupling
