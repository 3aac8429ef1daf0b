// SPDX-License-Identifier: LGPL-2.1-or-later
// Particles on several ranks: what one process computes alone, all compute
// together. The bound is that of the plan, 1e-9 over a smooth run; where sums of
// other order meet a threshold that decides, runs are kept short.
#include "ranked.h"

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.7e-3;

Parameters plain()
{
  Parameters p;
  p.parallel.interval = 1e9; // cuts are made anew in tests of that
  return p;
}

TEST(RankedParticles, SpinInAPlane)
{
  compare<2>(plain(), {spinning<2>(spacing, Vec3(19, 13, 0), 2e4)}, 150);
}

TEST(RankedParticles, SpinInSpace)
{
  compare<3>(plain(), {spinning<3>(spacing, Vec3(8, 6, 5), 4e4)}, 60);
}

TEST(RankedParticles, BarInOneDimension)
{
  auto bar = box<1>(Vec3::Zero(), spacing * Vec3(60, 0, 0), spacing, copper());
  for (std::size_t i = 0; i < bar.x.size(); ++i)
    bar.v[i][0] = 300 * bar.x[i][0] / (60 * spacing) + 20 * std::sin(bar.x[i][0] / (3 * spacing));
  compare<1>(plain(), {bar}, 150);
}

TEST(RankedParticles, RingsThatLandOnAWall)
{
  input::Scene scene;
  scene.dimension = input::Dimension::axisymmetric;
  input::Body body;
  body.name        = "rings";
  body.spacing     = spacing;
  body.shape.lower = Vec3(0, .5 * spacing, 0);
  body.shape.upper = spacing * Vec3(9, 20.5, 0);
  auto rings       = fill<2>(body, scene, 0, material(8930, 130e9, 48e9, 4e8));
  for (auto &v : rings.v)
    v[1] = -190;
  auto p         = plain();
  p.axisymmetric = true;
  p.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitY(), Vec3::Zero(), .1});
  compare<2>(p, {rings}, 120);
}

/// Two bodies, one on a moving wall with friction and next to a plane of
/// symmetry, with flow and damage. Where particles land and let go one by one a
/// change of 1e-14 in place makes up to 1 m/s of itself, of a run that is alone as
/// well, so what is held to rounding here is that the books close; their entries are
/// those of the run alone within 1e-3 of the energy, what such a landing weighs.
template <int dim>
void land(const Parameters &options, int steps)
{
  materials::Parameters m = material(8930, 130e9, 48e9, 3e8)->parameters();
  m.damage.law            = "plastic-strain";
  m.damage.failure_strain = .5;
  auto p                  = options;
  p.symmetry              = {{0}};
  p.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitY(), Vec3(0, 30, 0), .1});
  const Vec3 cells = dim == 2 ? Vec3(15, 9, 0) : Vec3(7, 6, 5), up = Vec3(0, 3 + cells[1], 0);
  std::vector<BodyParticles<dim>> bodies;
  for (int k = 0; k < 2; ++k)
  {
    bodies.push_back(box<dim>(spacing * k * up, spacing * (cells + k * up), spacing, materials::make_material(m), 0, 1, {{0}}));
    bodies[k].body = k;
    for (std::size_t i = 0; i < bodies[k].x.size(); ++i)
    {
      bodies[k].v[i][0] = 200 * (1 - 2 * k) * bodies[k].x[i][0] / (15 * spacing);
      bodies[k].v[i][1] = -120 + 60 * std::sin(900 * bodies[k].x[i][0]);
    }
  }
  Course<dim>   alone(p, bodies, Ranks()), shared(p, bodies, Ranks::world());
  const Balance before = shared.solver.balance();
  alone.advance(steps);
  shared.advance(steps);
  const Balance a = alone.solver.balance(), b = shared.solver.balance();
  EXPECT_LE((b.momentum - before.momentum - b.external_impulse).norm(), 1e-12 * std::sqrt(2 * b.mass * before.kinetic));
  EXPECT_NEAR(total(b) + b.wall_loss + b.friction_heat, total(before) + b.external_work, 1e-11 * before.kinetic);
  EXPECT_GT(b.wall_loss, .001 * before.kinetic);
  EXPECT_GT(b.friction_heat, 0);
  for (const auto amount : {&Balance::kinetic, &Balance::elastic, &Balance::plastic_work, &Balance::viscosity_heat,
                            &Balance::external_work, &Balance::wall_loss, &Balance::friction_heat})
    EXPECT_NEAR(a.*amount, b.*amount, 1e-3 * before.kinetic);
}

TEST(RankedParticles, WallWithFrictionAndSymmetryInAPlane)
{
  land<2>(plain(), 90);
}

TEST(RankedParticles, WallWithFrictionAndSymmetryInSpace)
{
  land<3>(plain(), 50);
}

/// One choice of methods in each: spinning blocks of two materials.
void methods(const std::function<void(input::SphOptions &)> &choose, int steps = 60)
{
  auto p = plain();
  choose(p.options);
  auto a = spinning<2>(spacing, Vec3(13, 9, 0), 3e4), b = spinning<2>(spacing, Vec3(9, 9, 0), -3e4, material(2700, 76e9, 26e9, 2e8));
  b.body = 1;
  for (auto &x : b.x)
    x[0] += 9 * spacing; // they overlap and do not feel each other
  compare<2>(p, {a, b}, steps);
}

TEST(RankedParticles, StandardFormWithoutCorrection)
{
  methods([](auto &o) {
    o.form       = "standard";
    o.correction = "none";
  });
}
TEST(RankedParticles, SummationDensity)
{
  methods([](auto &o) { o.density = "summation"; });
}
TEST(RankedParticles, ShepardCorrectionThatWorks)
{
  methods([](auto &o) {
    o.correction  = "shepard";
    o.energy_form = "working";
  });
}
TEST(RankedParticles, ShepardCorrectionAveraged)
{
  methods([](auto &o) {
    o.correction  = "shepard";
    o.energy_form = "averaged";
  });
}
TEST(RankedParticles, SupportThatIsChosen)
{
  methods([](auto &o) { o.support_rule = "monotonicity"; }, 40);
}
TEST(RankedParticles, ArtificialStressAndMemoryOfTheSwitch)
{
  methods([](auto &o) {
    o.artificial_stress = .2;
    o.viscosity_switch  = "cullen-dehnen";
  });
}
TEST(RankedParticles, OwenViscosityAndTheGradientOfTheDivergence)
{
  methods([](auto &o) {
    o.viscosity        = "owen";
    o.viscosity_switch = "divergence-gradient";
  });
}
TEST(RankedParticles, SharpSplitWithTheQuinticKernel)
{
  methods([](auto &o) {
    o.kernel      = "quintic";
    o.h_over_dx   = 1.1;
    o.shock_split = "sharp";
  });
}

TEST(RankedParticles, ReferenceConfiguration)
{
  auto p                  = plain();
  p.options.configuration = "reference";
  p.symmetry              = {{0}};
  auto b = box<2>(Vec3::Zero(), spacing * Vec3(15, 11, 0), spacing, copper(), 0, 1, {{0}});
  for (std::size_t i = 0; i < b.x.size(); ++i)
  {
    b.v[i][0] = 60 * std::sin(b.x[i][0] / (5 * spacing));
    b.v[i][1] = 90 * std::cos(b.x[i][1] / (4 * spacing));
  }
  compare<2>(p, {b}, 120, 1e-9, false);
}

/// Held and driven faces: the box of a face is that of all ranks' particles.
TEST(RankedParticles, HeldFaces)
{
  auto p       = plain();
  auto b       = box<2>(Vec3::Zero(), spacing * Vec3(21, 9, 0), spacing, copper());
  input::Boundary held, driven;
  held.name   = "held";
  held.face   = "x-";
  held.kind   = input::BoundaryKind::fixed;
  driven.name = "driven";
  driven.face = "x+";
  driven.kind = input::BoundaryKind::velocity;
  driven.fix[0] = driven.fix[1] = true;
  driven.velocity   = Vec3(25, 300, 0);
  p.boundaries      = {held, driven};
  p.boundary_bodies = {0, 0};
  compare<2>(p, {b}, 60, 1e-9, false);
}

/// Fewer particles than ranks: some have none.
TEST(RankedParticles, RanksWithoutParticles)
{
  auto b = box<2>(Vec3::Zero(), spacing * Vec3(3, 1, 0), spacing, copper());
  b.v[0][0] = 20;
  compare<2>(plain(), {b}, 100, 1e-9, false);
}

/// Momentum and energy to rounding, with cuts made anew; the angular momentum,
/// which the corrected form keeps to its own error, as alone.
TEST(RankedParticles, ConservesToRounding)
{
  const Ranks ranks = Ranks::world();
  Parameters  p;
  p.parallel.interval  = 7;
  p.parallel.imbalance = 1;
  const std::vector<BodyParticles<2>> bodies{spinning<2>(spacing, Vec3(19, 13, 0), 2e4)};
  Course<2>     alone(p, bodies, Ranks()), shared(p, bodies, ranks);
  const Balance at_first = shared.solver.balance();
  alone.advance(150);
  shared.advance(150);
  const Balance b      = shared.solver.balance();
  const double  moment = std::sqrt(2 * b.mass * at_first.kinetic), turn = at_first.angular_momentum.norm();
  EXPECT_LE((b.momentum - at_first.momentum).norm(), 1e-13 * moment);
  EXPECT_LE((b.angular_momentum - alone.solver.balance().angular_momentum).norm(), 1e-12 * turn);
  EXPECT_NEAR(total(b), total(at_first), 1e-12 * total(at_first));
  if (!ranks.alone())
  {
    EXPECT_GT(migrated(ranks, shared.solver.diagnostics()), 0);
  }
}

/// The reference configuration has no torque at all (reference/sweeps.h), with
/// central viscosity and no correction.
TEST(RankedParticles, ConservesAngularMomentumToRounding)
{
  Parameters p;
  p.options.configuration = "reference";
  p.options.correction    = "none";
  Course<2>     shared(p, {spinning<2>(spacing, Vec3(19, 13, 0), 2e4)}, Ranks::world());
  const Balance at_first = shared.solver.balance();
  shared.advance(150);
  const Balance b = shared.solver.balance();
  EXPECT_LE((b.angular_momentum - at_first.angular_momentum).norm(), 1e-13 * at_first.angular_momentum.norm());
  EXPECT_NEAR(total(b), total(at_first), 1e-12 * total(at_first));
}

/// The same count of ranks gives the same bits again, cuts by counted work included.
TEST(RankedParticles, RepeatsToTheBit)
{
  const Ranks ranks = Ranks::world();
  Parameters  p;
  p.parallel.interval  = 10;
  p.parallel.imbalance = 1;
  const auto bodies = std::vector{spinning<2>(spacing, Vec3(19, 13, 0), 2e4)};
  Course<2>  first(p, bodies, ranks), second(p, bodies, ranks);
  first.advance(60);
  second.advance(60);
  expect_equal(first.solver.sample(0), second.solver.sample(0));
  EXPECT_EQ(first.solver.balance().elastic, second.solver.balance().elastic);
}

/// A lopsided pair of bodies: after a look the work of the ranks is even within
/// what a row of particles weighs.
TEST(RankedParticles, CutsAnewWhereWorkIsUneven)
{
  const Ranks ranks = Ranks::world();
  if (ranks.alone())
    return;
  Parameters p;
  p.options.h_over_dx  = 1.5;
  p.parallel.interval  = 20;
  p.parallel.imbalance = 1.02;
  auto dense  = spinning<2>(spacing, Vec3(30, 30, 0), 5e3);
  auto single = box<2>(spacing * Vec3(40, 0, 0), spacing * Vec3(41, 300, 0), spacing, copper());
  single.body = 1; // a chain has few pairs
  Course<2> shared(p, {dense, single}, ranks);
  shared.advance(20);
  const double before = shared.solver.diagnostics().imbalance; // as first cut, by numbers
  shared.advance(20);
  const double after = shared.solver.diagnostics().imbalance;
  EXPECT_GT(before, 1.02);
  EXPECT_LT(after, 1.1);
}
} // namespace
