// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/verification/coupling/support.h"

#include <cmath>
#include <map>

/// Scenes whose bodies several ranks share against the same on one process. Sums are
/// taken in another order, so what differs is rounding, as it grows in the time of
/// the test: bar 1e-9 of the plan. Momentum to rounding; the same run twice to the bit.
namespace ogive::coupling
{
namespace
{
using input::Dimension;
using input::Method;
using scenes::Driver;

constexpr double mm = 1e-3, bar = 1e-9;

/// Position, velocity and energy of each point of a body, by kind and id.
std::map<std::int64_t, std::array<double, 6>> points_of(const Sample &s)
{
  std::map<std::int64_t, std::array<double, 6>> all;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
    all[s.id[i]] = {s.x[0][i], s.x[1][i], s.x[2][i], s.v[0][i], s.v[1][i], s.v[2][i]};
  return all;
}

struct Scales
{
  double energy = 0, momentum = 0, length = 0, speed = 0;
};

Scales scales_of(const input::Scene &scene, const LedgerRow &row)
{
  Scales s;
  s.energy   = row.kinetic;
  s.momentum = std::sqrt(2 * row.kinetic * row.mass);
  s.speed    = std::sqrt(2 * row.kinetic / row.mass);
  for (const auto &body : scene.bodies)
    s.length = std::max({s.length, body.shape.upper.cwiseAbs().maxCoeff(), body.shape.lower.cwiseAbs().maxCoeff()});
  return s;
}

void expect_near(const LedgerRow &a, const LedgerRow &b, const Scales &scale)
{
  const double pairs[][2] = {{a.kinetic, b.kinetic},
                             {a.elastic, b.elastic},
                             {a.plastic_work, b.plastic_work},
                             {a.viscosity_heat, b.viscosity_heat},
                             {a.hourglass_fem, b.hourglass_fem},
                             {a.hourglass_sph, b.hourglass_sph},
                             {a.contact, b.contact},
                             {a.contact_loss, b.contact_loss},
                             {a.friction, b.friction},
                             {a.interface_work, b.interface_work},
                             {a.conversion_heat, b.conversion_heat},
                             {a.wall_loss, b.wall_loss},
                             {a.total, b.total},
                             {a.mesh_books, b.mesh_books},
                             {a.particle_books, b.particle_books}};
  for (std::size_t k = 0; k < std::size(pairs); ++k)
    EXPECT_NEAR(pairs[k][0], pairs[k][1], bar * scale.energy) << k;
  EXPECT_LE(std::abs(a.mass - b.mass), 1e-13 * b.mass);
  EXPECT_LE((a.momentum - b.momentum).norm(), 1e-12 * scale.momentum);
}

void expect_near(const Sample &a, const Sample &b, const Scales &scale)
{
  const auto p = points_of(a), q = points_of(b);
  ASSERT_EQ(p.size(), q.size());
  double away = 0, slower = 0;
  for (auto i = p.begin(), j = q.begin(); i != p.end(); ++i, ++j)
  {
    ASSERT_EQ(i->first, j->first);
    for (int k = 0; k < 3; ++k)
    {
      away   = std::max(away, std::abs(i->second[k] - j->second[k]));
      slower = std::max(slower, std::abs(i->second[3 + k] - j->second[3 + k]));
    }
  }
  EXPECT_LE(away, bar * scale.length);
  EXPECT_LE(slower, bar * scale.speed * 10); // of single points
}

/// Steps it alone and twice on all ranks. `convert`: the step before which elements
/// that must turn into particles do.
template <int dim>
void expect_alike(const input::Scene &scene, int steps, int convert = -1)
{
  const Ranks ranks = Ranks::world();
  ASSERT_FALSE(ranks.alone());
  Driver<dim>  alone(scene), shared(scene, ranks), again(scene, ranks);
  const auto   first = alone.model.ledger();
  const Scales scale = scales_of(scene, first);
  expect_near(shared.model.ledger(), first, scale);
  double touched = 0;
  for (int n = 0; n < steps; ++n)
  {
    if (n == convert)
    {
      const auto events = alone.model.convert(n, alone.time), same = shared.model.convert(n, shared.time);
      again.model.convert(n, again.time);
      ASSERT_EQ(events.size(), same.size());
      ASSERT_FALSE(events.empty());
      for (std::size_t k = 0; k < events.size(); ++k)
      {
        EXPECT_EQ(events[k].particles, same[k].particles);
        EXPECT_NEAR(events[k].heat, same[k].heat, bar * scale.energy);
      }
    }
    const double dt = alone.model.stable_dt().dt, common = shared.model.stable_dt().dt;
    ASSERT_NEAR(common, dt, bar * dt) << "step " << n << ": " << shared.model.stable_dt().culprit.entity << " "
                                      << shared.model.stable_dt().culprit.id << ", alone "
                                      << alone.model.stable_dt().culprit.entity << " " << alone.model.stable_dt().culprit.id;
    alone.step(dt);
    shared.step(dt);
    again.step(dt);
    touched = std::max(touched, alone.model.contact_force());
    EXPECT_NEAR(shared.model.contact_force(), alone.model.contact_force(), 10 * bar * touched) << n;
    if (n % 10 == 9)
      expect_near(shared.model.ledger(), alone.model.ledger(), scale);
    if (testing::Test::HasFailure())
      FAIL() << "step " << n;
  }
  const auto row = shared.model.ledger();
  if (scene.walls.empty() && scene.symmetry.empty())
  {
    EXPECT_LE((row.momentum - first.momentum).norm(), 1e-12 * scale.momentum);
  }
  EXPECT_TRUE(scene.contacts.empty() || touched > 0);
  EXPECT_EQ(row.values(), again.model.ledger().values());
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
  {
    expect_near(shared.model.mesh_sample(b), alone.model.mesh_sample(b), scale);
    expect_near(shared.model.particle_sample(b), alone.model.particle_sample(b), scale);
    const Sample p = shared.model.sample(b), q = again.model.sample(b);
    EXPECT_EQ(p.x, q.x);
    EXPECT_EQ(p.v, q.v);
    EXPECT_EQ(p.energy, q.energy);
  }
  EXPECT_EQ(shared.model.particles(), alone.model.particles());
  EXPECT_EQ(shared.model.particle_updates(), alone.model.particle_updates());
  EXPECT_EQ(shared.model.element_updates(), alone.model.element_updates());
}

/// A block comes down on a larger one at an angle.
input::Scene blocks(Method low, Method high, Dimension dimension)
{
  auto       scene = scenes::steel_scene(dimension);
  const bool flat  = dimension == Dimension::plane_strain;
  const auto at    = [&](double x, double y, double up) { return flat ? Vec3(x, up, 0) : Vec3(x, y, up); };
  scenes::add_box(scene, "low", low, at(-6 * mm, -4 * mm, -5 * mm), at(6 * mm, 4 * mm, 0), mm, Vec3::Zero());
  scenes::add_box(scene, "high", high, at(-2.3 * mm, -1.7 * mm, .05 * mm), at(2.7 * mm, 2.3 * mm, 4.05 * mm),
                  high == Method::fem ? .8 * mm : mm, at(40, 10, -90));
  scene.contacts.push_back({"touch", "low", "high", .2, .1});
  return scene;
}

/// Two parts of a block that flies apart from itself, joined by `method`.
input::Scene joined(const std::string &method)
{
  auto         scene = scenes::steel_scene(Dimension::plane_strain);
  const double reach = method == "blended" ? 6 * mm : 0;
  scenes::add_box(scene, "zone", Method::sph, {-10 * mm, -5 * mm, 0}, {reach, 5 * mm, 0}, mm, {30, 5, 0});
  scenes::add_box(scene, "rest", Method::fem, {0, -5 * mm, 0}, {12 * mm, 5 * mm, 0}, mm, {-10, 5, 0});
  scene.interfaces.push_back({"seam", method, "zone", "rest"});
  return scene;
}
} // namespace

TEST(OnRanks, ElementsOnElements) { expect_alike<2>(blocks(Method::fem, Method::fem, Dimension::plane_strain), 120); }
TEST(OnRanks, ParticlesOnElements) { expect_alike<2>(blocks(Method::fem, Method::sph, Dimension::plane_strain), 120); }
TEST(OnRanks, ElementsOnParticles) { expect_alike<2>(blocks(Method::sph, Method::fem, Dimension::plane_strain), 120); }
TEST(OnRanks, ParticlesOnParticles) { expect_alike<2>(blocks(Method::sph, Method::sph, Dimension::plane_strain), 120); }
TEST(OnRanks, ElementsOnParticlesInSpace) { expect_alike<3>(blocks(Method::sph, Method::fem, Dimension::three_d), 60); }

TEST(OnRanks, TiedParts) { expect_alike<2>(joined("tied"), 120); }
TEST(OnRanks, PartsWithPairFlux) { expect_alike<2>(joined("pair-flux"), 120); }
TEST(OnRanks, BlendedParts) { expect_alike<2>(joined("blended"), 80); }

// A striker on a body that turns into particles where it is struck.
TEST(OnRanks, ElementsTurnIntoParticles)
{
  auto scene = blocks(Method::automatic, Method::fem, Dimension::plane_strain);
  auto &when = scene.bodies[0].conversion;
  when.zone_radius = 2.2 * mm;
  when.zone_centre = Vec3(0, 0, 0);
  when.strain = when.damage = when.volume = 0;
  when.step = 1.4e-7; // of squeezed elements
  when.strain = 1e-3;
  expect_alike<2>(scene, 120, 60);
}

// A ring of particles that may meet itself between two anvils.
TEST(OnRanks, BodyThatMeetsItself)
{
  auto        scene = scenes::steel_scene(Dimension::plane_strain);
  input::Body ring;
  ring.name               = "ring";
  ring.material           = "steel";
  ring.method             = Method::sph;
  ring.shape.kind         = input::ShapeKind::ring;
  ring.shape.inner_radius = 4.8 * mm;
  ring.shape.radius       = 6 * mm;
  ring.spacing            = .4 * mm;
  scene.bodies.push_back(ring);
  scenes::add_box(scene, "low", Method::fem, {-10 * mm, -10.05 * mm, 0}, {10 * mm, -6.05 * mm, 0}, mm, {0, 45, 0});
  scene.contacts.push_back({"l", "ring", "low", .1, .1});
  scene.contacts.push_back({"itself", "ring", "ring", .1, .1});
  expect_alike<2>(scene, 80);
}

// Several steps of small elements in one of particles, tied to others.
TEST(OnRanks, StepsInParts)
{
  auto         scene = scenes::steel_scene(Dimension::plane_strain);
  const double a     = 2 * mm;
  scenes::add_box(scene, "striker", Method::fem, {a, 4.02 * a, 0}, {4 * a, 7.02 * a, 0}, .5 * mm, {20, -110, 0});
  scenes::add_box(scene, "zone", Method::sph, {0, 2 * a, 0}, {5 * a, 4 * a, 0}, mm, {0, 0, 0});
  scenes::add_box(scene, "rest", Method::fem, {0, 0, 0}, {5 * a, 2 * a, 0}, a, {0, 0, 0});
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  scene.contacts.push_back({"hit", "striker", "zone", .15, .1});
  scene.subcycling.who   = "elements";
  scene.subcycling.steps = 4;
  expect_alike<2>(scene, 60);
}
} // namespace ogive::coupling
