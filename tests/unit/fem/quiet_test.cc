// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/archive.h"
#include "fem/solver.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>

/// Elements that nothing has reached are left out, and nobody can tell by the
/// result: the final state is the same bit for bit, in every way to step.
namespace ogive::fem
{
using namespace test;
namespace
{
/// Fowler, Noll and Vo's hash (1a, 64 bits) of what a run ends with.
struct Hash
{
  std::uint64_t value = 14695981039346656037ull;
  void          add(double x)
  {
    for (std::uint64_t bits = std::bit_cast<std::uint64_t>(x), k = 0; k < 8; ++k, bits >>= 8)
      value = (value ^ (bits & 255)) * 1099511628211ull;
  }
};

template <int dim>
std::uint64_t hash_of(Solver<dim> &s, std::size_t bodies)
{
  Hash               h;
  const Surface<dim> now = s.surface();
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < now.n; ++a)
    {
      h.add(now.x[i][a]);
      h.add(now.v[i][a]);
    }
  for (std::size_t b = 0; b < bodies; ++b)
  {
    const Sample sample = s.sample(static_cast<int>(b));
    for (const auto &component : sample.sigma)
      for (const double value : component)
        h.add(value);
    for (const auto *field : {&sample.density, &sample.energy, &sample.plastic_strain, &sample.temperature})
      for (const double value : *field)
        h.add(value);
  }
  const Balance b = s.balance();
  for (const double value : {b.kinetic, b.elastic, b.plastic_work, b.bulk_viscosity_heat, b.hourglass_fem, b.external_work})
    h.add(value);
  const StepLimit limit = s.stable_dt();
  h.add(limit.dt);
  h.add(static_cast<double>(limit.culprit.id));
  return h.value;
}

/// Copper that flows, with the equation of state of solids.
materials::Parameters metal()
{
  auto p                 = copper_linear_hardening();
  p.strength.yield_stress = 90e6;
  p.eos.law              = "mie-grueneisen";
  p.eos.bulk_sound_speed = 3940;
  p.eos.slope            = 1.49;
  p.eos.gamma            = 2;
  return p;
}

/// A bar along the last axis, across which elements are numbered; its first
/// `moving` layers run at speed.
template <int dim>
BodyMesh<dim> bar(int length, double speed, int moving, bool axisymmetric = false, int body = 0, double from = 0)
{
  const double h = 1e-3;
  input::Scene scene;
  scene.dimension = axisymmetric ? input::Dimension::axisymmetric : input::Dimension::three_d;
  const Vec3 lower = axisymmetric ? Vec3(0, from, 0) : Vec3(-1e-3, 2e-3, from);
  const Vec3 size  = axisymmetric ? Vec3(4 * h, length * h, 1) : Vec3(4 * h, 4 * h, length * h);
  auto       mesh  = make_mesh<dim>(box(lower, lower + size, h), scene, body, make(metal()));
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    if (moving > 0 && mesh.x[dim - 1][a] < lower[dim - 1] + (moving + .5) * h)
      mesh.v[dim - 1][a] = speed;
  return mesh;
}

/// A checkpoint in memory.
class Memory : public ArchiveWriter, public ArchiveReader
{
public:
  using ArchiveWriter::write;
  void write(const std::string &name, std::span<const double> v) override { doubles_[name].assign(v.begin(), v.end()); }
  void write(const std::string &name, std::span<const std::int64_t> v) override
  {
    integers_[name].assign(v.begin(), v.end());
  }
  std::vector<double>       doubles(const std::string &name) const override { return doubles_.at(name); }
  std::vector<std::int64_t> integers(const std::string &name) const override { return integers_.at(name); }

private:
  std::map<std::string, std::vector<double>>       doubles_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};

template <int dim>
using Make = std::function<std::vector<BodyMesh<dim>>()>;
template <int dim>
using Course = std::function<void(Solver<dim> &)>;

template <int dim>
void run(Solver<dim> &s, int steps, const std::function<void(double)> &push = {})
{
  Driver<dim> driver{s};
  driver.fixed_dt = .5 * s.stable_dt().dt;
  for (int k = 0; k < steps; ++k)
  {
    if (push)
      push(driver.time);
    ASSERT_TRUE(driver.once().ok);
  }
}

/// The same run with the skip on and off; at least a share of it skipped.
template <int dim>
void expect_same(Parameters p, const Make<dim> &meshes, const Course<dim> &run, double share)
{
  std::uint64_t hash[2];
  for (const bool on : {false, true})
  {
    p.options.quiescent_skip = on ? "on" : "off";
    auto              all    = meshes();
    const std::size_t bodies = all.size();
    Solver<dim>       s(p, std::move(all));
    run(s);
    hash[on] = hash_of(s, bodies);
    if (on)
      EXPECT_GT(double(s.skipped()), share * double(s.updates()));
    else
      EXPECT_EQ(s.skipped(), 0u);
  }
  EXPECT_EQ(hash[0], hash[1]);
}

template <int dim>
Make<dim> one(BodyMesh<dim> mesh)
{
  return [mesh] { return std::vector<BodyMesh<dim>>{mesh}; };
}
} // namespace

// A step carries motion by one element. After 80 steps half of the 160 layers have
// moved; on average a quarter of them, and what shares a block of packs, 8 layers.
TEST(QuiescentSkip, BarHitAtOneEnd)
{
  expect_same<3>({}, one(bar<3>(160, 30, 3)), [](auto &s) { run(s, 80); }, .4);
}

TEST(QuiescentSkip, AxisymmetricBar)
{
  Parameters p;
  p.axisymmetric = true;
  expect_same<2>(p, one(bar<2>(160, 30, 3, true)), [](auto &s) { run(s, 80); }, .2);
}

TEST(QuiescentSkip, ViscousHourglassAndMassScaling)
{
  Parameters p;
  p.options.hourglass         = "viscous";
  p.options.mass_scaling_step = 1.5e-7;
  expect_same<3>(p, one(bar<3>(160, 30, 3)), [](auto &s) { run(s, 60); }, .3);
}

// A bar flies against a wall: all of it moves, and nothing is left out but the other.
TEST(QuiescentSkip, RigidWallAndABodyAtRest)
{
  Parameters       p;
  input::RigidWall wall;
  wall.name   = "wall";
  wall.point  = Vec3::Zero();
  wall.normal = Vec3::UnitZ();
  p.walls.push_back(wall);
  expect_same<3>(
    p, [] { return std::vector<BodyMesh<3>>{bar<3>(48, -40, 48), bar<3>(48, 0, 0, false, 1, .1)}; },
    [](auto &s) { run(s, 60); }, .4);
}

// Tied bars: the wave crosses to the one that slept.
TEST(QuiescentSkip, TiedBars)
{
  Parameters p;
  p.ties.push_back({"joint", 1, 0, .1});
  expect_same<3>(
    p, [] { return std::vector<BodyMesh<3>>{bar<3>(48, 30, 3), bar<3>(80, 0, 0, false, 1, 48e-3)}; },
    [](auto &s) { run(s, 90); }, .2);
}

// What a coupling layer pushes, like contact does, wakes the end that it pushes.
TEST(QuiescentSkip, PushedFromOutside)
{
  const Course<3> pushed = [](Solver<3> &s) {
    run<3>(s, 100, [&s](double) {
      Surface<3> now = s.surface();
      for (const std::uint32_t a : now.contact_points)
        if (now.x[2][a] > 159.5e-3)
          now.force[2][a] -= 50;
    });
  };
  expect_same<3>({}, one(bar<3>(160, 0, 0)), pushed, .4);
}

// The same in parts of steps.
TEST(QuiescentSkip, StepsInParts)
{
  const Course<3> parts = [](Solver<3> &s) {
    s.allow_parts();
    const double dt   = .5 * s.stable_dt().dt;
    const auto   push = [&s] {
      Surface<3> now = s.surface();
      for (const std::uint32_t a : now.contact_points)
        if (now.x[2][a] > 159.5e-3)
          now.force[2][a] -= 50;
    };
    for (int k = 0; k < 60; ++k)
    {
      const TimeStep whole{k * dt, dt, dt}, part{k * dt, .5 * dt, .5 * dt};
      push();
      ASSERT_TRUE(s.begin(whole, part).ok);
      push();
      ASSERT_TRUE(s.go_on(part).ok);
      ASSERT_TRUE(s.finish(whole).ok);
    }
  };
  expect_same<3>({}, one(bar<3>(160, 0, 0)), parts, .4);
}

// A checkpoint in the middle, read by a solver that has seen nothing yet.
TEST(QuiescentSkip, RestartInTheMiddle)
{
  const auto mesh = bar<3>(160, 30, 3);
  for (const char *skip : {"on", "off"})
  {
    Parameters p;
    p.options.quiescent_skip = skip;
    std::uint64_t hash[2];
    for (const bool restarted : {false, true})
    {
      auto s = solver_of<3>(mesh, p);
      run(*s, 40);
      if (restarted)
      {
        Memory checkpoint;
        s->save(checkpoint, "fem");
        s = solver_of<3>(mesh, p);
        s->load(checkpoint, "fem");
      }
      Driver<3> driver{*s};
      driver.fixed_dt = driver.last = 4e-8;
      for (int k = 0; k < 20; ++k)
        ASSERT_TRUE(driver.once().ok);
      hash[restarted] = hash_of(*s, 1);
    }
    EXPECT_EQ(hash[0], hash[1]) << skip;
  }
}

// Elements die at one end while the other sleeps.
TEST(QuiescentSkip, Erosion)
{
  auto mesh           = bar<3>(160, 60, 3);
  mesh.erosion.on     = true;
  mesh.erosion.strain = .005;
  const Course<3> dies   = [](Solver<3> &s) {
    run(s, 80);
    EXPECT_LT(s.cells(0).element.size(), s.size());
  };
  expect_same<3>({}, one(mesh), dies, .3);
}

// Steps taken back, and a sleeping element taken out like one that turns into particles.
TEST(QuiescentSkip, TakenBackAndTakenOut)
{
  auto mesh     = bar<3>(160, 30, 3);
  mesh.converts = true;
  const Course<3> back = [](Solver<3> &s) {
    run(s, 20);
    s.snapshot();
    run(s, 40);
    s.restore();
    run(s, 10);
    const std::uint32_t last = static_cast<std::uint32_t>(s.size()) - 1;
    EXPECT_EQ(s.take_out(std::span(&last, 1)).size(), 1u);
    run(s, 10);
  };
  expect_same<3>({}, one(mesh), back, .3);
}
} // namespace ogive::fem
