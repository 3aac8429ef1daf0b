// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/composed_material.h"
#include "fem/mesh.h"
#include "sph/fill.h"
#include "tests/verification/coupling/support.h"

#include <gtest/gtest.h>

#include <random>

/// The pair flux: what numerics of a seam must hold.
namespace ogive::coupling
{
namespace
{
using scenes::add_box;
using scenes::Driver;
using scenes::steel_scene;

constexpr double dx = 1e-3;

/// A block of which the half x < 0 is particles, the other elements of edge
/// ratio dx.
input::Scene split_block(input::Dimension dimension, int ratio, const Vec3 &size, const Vec3 &velocity = Vec3::Zero())
{
  auto scene = steel_scene(dimension);
  add_box(scene, "zone", input::Method::sph, {-size.x(), 0, 0}, {0, size.y(), size.z()}, dx, velocity);
  add_box(scene, "rest", input::Method::fem, {0, 0, 0}, size, ratio * dx, velocity);
  scene.interfaces.push_back({"seam", "pair-flux", "zone", "rest"});
  return scene;
}

/// The two solvers of a split block and the layer between, with initial
/// velocities by a function of the place.
template <int dim>
struct Pair
{
  std::unique_ptr<fem::Solver<dim>> mesh;
  std::unique_ptr<sph::Solver<dim>> particles;
  std::unique_ptr<Coupler<dim>>     coupler;
  double                            time = 0, last = 0;

  template <class F>
  Pair(const input::Scene &scene, F &&velocity)
  {
    const std::shared_ptr<const materials::Material> material = materials::make_material(scene.materials.front());
    auto cloud = sph::fill<dim>(scene.bodies[0], scene, 0, material);
    for (std::size_t i = 0; i < cloud.x.size(); ++i)
      cloud.v[i] = velocity(cloud.x[i]);
    auto grid = fem::make_mesh<dim>(scene.bodies[1], scene, 1, material);
    for (std::size_t a = 0; a < grid.n_nodes(); ++a)
    {
      std::array<double, dim> x;
      for (int i = 0; i < dim; ++i)
        x[i] = grid.x[i][a];
      const auto v = velocity(x);
      for (int i = 0; i < dim; ++i)
        grid.v[i].at(a) = v[i];
    }
    const bool turned = scene.dimension == input::Dimension::axisymmetric;
    std::vector<fem::BodyMesh<dim>> meshes;
    meshes.push_back(std::move(grid));
    std::vector<sph::BodyParticles<dim>> clouds{std::move(cloud)};
    mesh      = std::make_unique<fem::Solver<dim>>(fem::Parameters{scene.fem, turned, scene.symmetry, {}, {}, {}},
                                              std::move(meshes));
    particles = std::make_unique<sph::Solver<dim>>(sph::Parameters{scene.sph, turned, scene.symmetry, {}, {}, {}},
                                                   std::move(clouds));
    coupler   = std::make_unique<Coupler<dim>>(scene, mesh.get(), particles.get());
  }

  void step()
  {
    StepLimit limit = mesh->stable_dt();
    limit.tighten(particles->stable_dt());
    const TimeStep step{time, .5 * (last + limit.dt), limit.dt};
    coupler->gather();
    ASSERT_TRUE(mesh->step(step).ok);
    coupler->drive();
    ASSERT_TRUE(particles->step(step).ok);
    coupler->close(step);
    time += limit.dt;
    last = limit.dt;
  }
  LedgerRow ledger() const { return ledger_row(mesh->balance(), particles->balance(), coupler->balance()); }
};
} // namespace

template <int dim>
void noise(input::Dimension d, int ratio, int steps)
{
  auto scene = split_block(d, ratio, Vec3(16 * dx, 12 * dx, dim == 3 ? 12 * dx : 0));
  if (const char *a = std::getenv("DAMP"))
    scene.interfaces[0].damping = std::atof(a);
  if (const char *a = std::getenv("PV"))
    scene.interfaces[0].pair_viscosity = std::atof(a);
  if (const char *a = std::getenv("ALPHA"))
    scene.sph.alpha = std::atof(a), scene.sph.beta = 2 * std::atof(a), scene.fem.bulk_linear *= std::atof(a), scene.fem.bulk_quadratic *= std::atof(a);
  if (const char *a = std::getenv("HG"))
    scene.sph.hourglass = std::atof(a);
  if (std::getenv("TIED"))
    scene.interfaces[0].method = "tied";
  scene.bodies[0].velocity_field = "";
  std::mt19937 random(7);
  Pair<dim> run(scene, [&](const auto &) { std::array<double, dim> v; for (double &c : v) c = random() * 0x1p-31 - 1; return v; });
  auto row = run.ledger();
  const double first = row.kinetic;
  const Vec3 p0 = row.momentum, l0 = row.angular_momentum;
  int next = 10;
  for (int n = 0; n <= steps; ++n)
  {
    if (n == next || n == 1)
    {
      row = run.ledger();
      std::printf("%d ratio %d step %6d mech %.6f total %.6f iface %.5f mom %.1e ang %.1e\n", dim, ratio, n, (row.kinetic + row.elastic) / first, row.total / first, row.interface_work / first, (row.momentum - p0).norm() / std::sqrt(2 * row.mass * first), (row.angular_momentum - l0).norm() / std::sqrt(2 * row.mass * first) / (16 * dx));
      if (n > 1) next *= 2;
      if (!(std::abs(row.total) < 100 * first)) break;
    }
    run.step();
  }
}
TEST(Noise, D)
{
  const int steps = std::getenv("STEPS") ? std::atoi(std::getenv("STEPS")) : 5000;
  const int ratio = std::getenv("RATIO") ? std::atoi(std::getenv("RATIO")) : 1;
  if (std::getenv("D3")) noise<3>(input::Dimension::three_d, ratio, steps);
  else noise<2>(input::Dimension::plane_strain, ratio, steps);
}
} // namespace ogive::coupling
