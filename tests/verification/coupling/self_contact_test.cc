// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/memory_archive.h"
#include "tests/verification/coupling/support.h"

#include <cmath>
#include <cstdio>
#include <fstream>

/// Bodies that meet themselves: a ring crushed flat, a stack of loose blocks, the
/// pieces of a bar that tears.
namespace ogive::coupling
{
namespace
{
using input::Dimension;
using input::Method;

void make_soft(input::Scene &scene) // E 1 GPa, nu .3
{
  auto &soft            = scene.materials.front();
  soft.density          = 1000;
  soft.shear_modulus    = 1e9 / 2.6;
  soft.eos.bulk_modulus = 1e9 / 1.2;
}

/// A ring of 6 mm radius, its wall 1.2 mm, between two anvils that close at 2 x 45
/// m/s; the walls meet first in the middle, after some 120 us.
input::Scene crush(Method method, double spacing, bool touching)
{
  auto scene = scenes::steel_scene(Dimension::plane_strain);
  make_soft(scene);
  scene.sph.configuration = "reference";
  input::Body ring;
  ring.name               = "ring";
  ring.material           = "steel";
  ring.method             = method;
  ring.shape.kind         = input::ShapeKind::ring;
  ring.shape.inner_radius = 4.8e-3;
  ring.shape.radius       = 6e-3;
  ring.spacing            = spacing;
  scene.bodies.push_back(ring);
  scenes::add_box(scene, "low", Method::fem, {-10e-3, -16.05e-3, 0}, {10e-3, -6.05e-3, 0}, 1e-3, {0, 45, 0});
  scenes::add_box(scene, "high", Method::fem, {-10e-3, 6.05e-3, 0}, {10e-3, 16.05e-3, 0}, 1e-3, {0, -45, 0});
  scene.contacts.push_back({"l", "ring", "low", 0, .1});
  scene.contacts.push_back({"h", "ring", "high", 0, .1});
  if (touching)
    scene.contacts.push_back({"itself", "ring", "ring", .1, .1});
  return scene;
}

/// How far the upper half's lowest point stands over the lower half's highest one
/// within a quarter of the radius of the middle, m; < 0: they have passed through
/// each other. Halves as of the start.
double opening(const Sample &ring)
{
  double lowest = 1, highest = -1;
  for (std::size_t i = 0; i < ring.x[0].size(); ++i)
    if (std::abs(ring.x[0][i]) < 1.5e-3)
    {
      if (ring.x0[1][i] > 0)
        lowest = std::min(lowest, ring.x[1][i]);
      else
        highest = std::max(highest, ring.x[1][i]);
    }
  return lowest - highest;
}

void expect_walls_to_meet(Method method, double spacing)
{
  double least[2];
  for (const bool touching : {false, true})
  {
    scenes::Driver<2> run(crush(method, spacing, touching));
    Ledger            ledger;
    auto              row = run.model.ledger();
    ledger.enter(row);
    double &most_closed = least[touching] = 1;
    while (run.time < 150e-6)
    {
      run.step();
      row = run.model.ledger();
      ledger.enter(row);
      most_closed = std::min(most_closed, opening(run.model.sample(0)));
    }
    const double flux = 2 * 1000 * 20e-3 * 10e-3 * 45;
    EXPECT_LE(row.momentum.norm(), 1e-12 * flux);
    if (touching)
    {
      EXPECT_LE(std::abs(ledger.worst_drift()), 3e-3);
      EXPECT_EQ(run.model.lost_contacts(), 0);
      testing::Test::RecordProperty("drift", std::to_string(1e3 * ledger.worst_drift()) + "e-3");
    }
  }
  // Without, they pass through each other. With: a node that leaks is pressed in by
  // more than an element, and particles meet at their spacing, pressed by a third.
  EXPECT_LT(least[0], -1.5 * spacing);
  EXPECT_GT(least[1], method == Method::sph ? .6 * spacing : -spacing);
  testing::Test::RecordProperty("opening_um", std::to_string(1e6 * least[1]));
  testing::Test::RecordProperty("opening_without_um", std::to_string(1e6 * least[0]));
}
} // namespace

TEST(SelfContact, WallsOfACrushedRingOfElementsMeet) { expect_walls_to_meet(Method::fem, .4e-3); }
TEST(SelfContact, WallsOfACrushedRingOfParticlesMeet) { expect_walls_to_meet(Method::sph, .4e-3); }

namespace
{
/// One body of three loose blocks of 6 x 3 mm, each a lattice of 6 by 3 elements,
/// the second shifted by a third of an element, flush on each other: a mesh file.
std::string write_stack()
{
  const std::string path = testing::TempDir() + "ogive-stack.msh";
  std::ofstream     out(path);
  constexpr int     nx = 6, ny = 3, blocks = 3;
  constexpr double  edge = 1e-3;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << blocks * (nx + 1) * (ny + 1) << "\n";
  int n = 0;
  for (int b = 0; b < blocks; ++b)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        out << ++n << " " << edge * (i + (b == 1 ? 1. / 3 : 0)) << " " << edge * (j + b * ny) << " 0\n";
  out << "$EndNodes\n$Elements\n" << blocks * nx * ny + nx << "\n";
  int e = 0;
  for (int i = 1; i <= nx; ++i) // the lower side of the lowest block
    out << ++e << " 1 2 7 7 " << i << " " << i + 1 << "\n";
  for (int b = 0; b < blocks; ++b)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
      {
        const int first = b * (nx + 1) * (ny + 1) + j * (nx + 1) + i + 1;
        out << ++e << " 3 2 1 1 " << first << " " << first + 1 << " " << first + nx + 2 << " " << first + nx + 1
            << "\n";
      }
  out << "$EndElements\n";
  return path;
}

/// It stands on its lowest side under a load of 1e5 m/s^2, put on at once.
input::Scene stack()
{
  auto scene = scenes::steel_scene(Dimension::plane_strain);
  make_soft(scene);
  input::Body body;
  body.name            = "stack";
  body.material        = "steel";
  body.method          = Method::fem;
  body.shape.kind      = input::ShapeKind::mesh;
  body.shape.mesh_file = write_stack();
  body.spacing         = 1e-3;
  scene.bodies.push_back(body);
  input::Boundary foot, weight;
  foot.name = "foot";
  foot.body = "stack";
  foot.face = "7";
  foot.kind = input::BoundaryKind::fixed;
  weight.name         = "weight";
  weight.body         = "stack";
  weight.kind         = input::BoundaryKind::body_force;
  weight.acceleration = Vec3(0, -1e5, 0);
  scene.boundaries    = {foot, weight};
  scene.contacts.push_back({"blocks", "stack", "stack", .3, .1});
  return scene;
}
} // namespace

// Loose blocks of one body on each other swing about their rest for 1 ms, 30 periods of
// the column: they neither sink (a node that leaks would take its block down by an
// element, 1 mm) nor walk, and the books keep.
TEST(SelfContact, StackOfFragmentsStands)
{
  scenes::Driver<2> run(stack());
  Ledger            ledger;
  auto              row = run.model.ledger();
  ledger.enter(row);
  const auto first   = run.model.sample(0);
  double     lowest = 0, aside = 0, late = 0;
  while (run.time < 1e-3)
  {
    run.step();
    row = run.model.ledger();
    ledger.enter(row);
    const auto   now = run.model.sample(0);
    const double down = now.x[1].back() - first.x[1].back();
    lowest = std::min(lowest, down);
    for (std::size_t i = 0; i < now.x[0].size(); ++i)
      aside = std::max(aside, std::abs(now.x[0][i] - first.x[0][i]));
    if (run.time > .8e-3)
      late = std::min(late, down);
  }
  // Twice the static squeeze rho g L^2/(2 E/(1 - nu^2)) of the column, at least.
  EXPECT_LT(lowest, -2 * 3.6e-6);
  EXPECT_GT(lowest, -100e-6);
  EXPECT_GT(late, 1.1 * lowest);
  EXPECT_LT(aside, 100e-6);
  EXPECT_EQ(run.model.lost_contacts(), 0);
  EXPECT_LE(std::abs(ledger.worst_drift()), 1e-3);
  testing::Test::RecordProperty("drift", std::to_string(1e3 * ledger.worst_drift()) + "e-3");
  testing::Test::RecordProperty("lowest_um", std::to_string(1e6 * lowest));
}

namespace
{
template <int dim>
void expect_restart(const input::Scene &scene, double until, double after)
{
  scenes::Driver<dim> whole(scene), resumed(scene);
  while (whole.time < until)
    whole.step();
  io::MemoryArchive archive;
  whole.model.save(archive);
  resumed.model.load(archive);
  resumed.time = whole.time;
  resumed.last = whole.last;
  const double stored = whole.model.ledger().contact;
  EXPECT_GT(stored, 0);
  int n = 0;
  while (whole.time < until + after)
  {
    whole.step();
    const auto time = resumed.time, last = resumed.last;
    resumed.model.snapshot();
    resumed.step();
    if (++n % 5 != 0)
      continue;
    resumed.model.restore(); // a step taken back
    resumed.time = time;
    resumed.last = last;
    resumed.step();
  }
  EXPECT_EQ(whole.time, resumed.time);
  EXPECT_EQ(whole.model.ledger().values(), resumed.model.ledger().values());
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    EXPECT_EQ(whole.model.sample(static_cast<int>(body)).x, resumed.model.sample(static_cast<int>(body)).x);
}
} // namespace

namespace
{
/// A soft bar of particles, 16 x 3 mm, drawn apart at 2 x 150 m/s between rigid walls
/// 24 mm apart: it tears without damage, its ends come back from the walls and
/// meet again.
input::Scene torn_bar()
{
  auto scene = scenes::steel_scene(Dimension::plane_strain);
  make_soft(scene);
  auto &soft                      = scene.materials.front();
  soft.strength.law               = "linear-hardening";
  soft.strength.yield_stress      = 2e6;
  soft.strength.hardening_modulus = 0;
  scenes::add_box(scene, "bar", Method::sph, {-8e-3, -1.5e-3, 0}, {8e-3, 1.5e-3, 0}, .5e-3, Vec3::Zero());
  scene.bodies.back().velocity_field       = "stretch";
  scene.bodies.back().velocity_field_speed = 150;
  for (const double side : {-1., 1.})
  {
    input::RigidWall wall;
    wall.name   = side < 0 ? "left" : "right";
    wall.point  = Vec3(12e-3 * side, 0, 0);
    wall.normal = Vec3(-side, 0, 0);
    scene.walls.push_back(wall);
  }
  scene.contacts.push_back({"pieces", "bar", "bar", .2, .1});
  return scene;
}
} // namespace

// Torn without damage, pieces stay pieces: where they come back to each other after
// 130 us they meet by contact, with friction, and are not welded.
TEST(SelfContact, PiecesOfATornBarMeet)
{
  scenes::Driver<2> run(torn_bar());
  Ledger            ledger;
  auto              row = run.model.ledger();
  ledger.enter(row);
  double most = 0, first = 0, flux = 0;
  const auto sample = run.model.sample(0);
  for (std::size_t i = 0; i < sample.mass.size(); ++i)
    flux += sample.mass[i] * std::abs(sample.v[0][i]);
  while (run.time < 200e-6)
  {
    run.step();
    row = run.model.ledger();
    ledger.enter(row);
    if (row.contact > 0 && first == 0)
      first = run.time;
    most = std::max(most, row.contact);
  }
  EXPECT_GT(first, 100e-6);
  EXPECT_GT(most, .01 * row.kinetic);
  EXPECT_GT(row.friction, 0);
  EXPECT_LE((row.momentum - row.external_impulse).norm(), 1e-12 * flux);
  EXPECT_LE(std::abs(ledger.worst_drift()), 1e-3);
  testing::Test::RecordProperty("drift", std::to_string(1e3 * ledger.worst_drift()) + "e-3");
}
TEST(SelfContact, PiecesOfATornBarRestartToTheBit) { expect_restart<2>(torn_bar(), 136e-6, 10e-6); }

TEST(SelfContact, StackRestartsToTheBit) { expect_restart<2>(stack(), 20e-6, 30e-6); }
TEST(SelfContact, CrushedRingOfParticlesRestartsToTheBit)
{
  expect_restart<2>(crush(Method::sph, .4e-3, true), 120e-6, 5e-6);
}
} // namespace ogive::coupling
