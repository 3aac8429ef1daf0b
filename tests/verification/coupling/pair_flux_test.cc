// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/composed_material.h"
#include "fem/mesh.h"
#include "sph/fill.h"
#include "tests/verification/coupling/support.h"

#include <gtest/gtest.h>

#include <functional>
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

  /// `keep`: particles; `place`: moves a node of the mesh.
  template <class F>
  Pair(
    const input::Scene &scene, F &&velocity,
    const std::function<bool(const std::array<double, dim> &)> &keep  = [](const auto &) { return true; },
    const std::function<void(std::array<double, dim> &)>       &place = [](auto &) {})
  {
    const std::shared_ptr<const materials::Material> material = materials::make_material(scene.materials.front());
    auto cloud = sph::fill<dim>(scene.bodies[0], scene, 0, material);
    std::size_t kept  = 0;
    for (std::size_t i = 0; i < cloud.x.size(); ++i)
      if (keep(cloud.x[i]))
      {
        cloud.x[kept]    = cloud.x[i];
        cloud.mass[kept] = cloud.mass[i];
        cloud.v[kept++]  = velocity(cloud.x[i]);
      }
    cloud.x.resize(kept);
    cloud.v.resize(kept);
    cloud.mass.resize(kept);
    auto grid = fem::make_mesh<dim>(scene.bodies[1], scene, 1, material);
    for (std::size_t a = 0; a < grid.n_nodes(); ++a)
    {
      std::array<double, dim> x;
      for (int i = 0; i < dim; ++i)
        x[i] = grid.x[i][a];
      place(x);
      for (int i = 0; i < dim; ++i)
        grid.x[i][a] = x[i];
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

template <int dim>
std::array<double, dim> affine(const Eigen::Matrix3d &gradient, const std::array<double, dim> &x)
{
  std::array<double, dim> v{};
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b)
      v[a] += gradient(a, b) * x[b];
  return v;
}

/// Largest force on nodes and on particles, away from free surfaces by `margin`,
/// that one step of uniform strain rate has left, over the stress times the area
/// of a facet or of a particle.
struct Residue
{
  double nodes = 0, particles = 0;
};

template <int dim>
Residue patch(Pair<dim> pair, double particle_edge, double node_edge, const std::function<bool(const Point<dim> &)> &inside)
{
  pair.step();
  std::array<std::vector<double>, dim> before[2];
  const auto faces = [&] { return std::array<Surface<dim>, 2>{pair.mesh->surface(), pair.particles->surface()}; };
  auto       now   = faces();
  const auto sample = pair.particles->sample(0);
  double     stress = 0;
  for (const auto &component : sample.sigma)
    stress = std::max(stress, std::abs(component[0]));
  for (int p = 0; p < 2; ++p)
    for (int a = 0; a < dim; ++a)
      before[p][a].assign(now[p].v[a].begin(), now[p].v[a].end());
  const double was = pair.last;
  pair.step();
  now = faces();
  const double kick = .5 * (was + pair.last);
  Residue      residue;
  for (int p = 0; p < 2; ++p)
    for (std::size_t i = 0; i < now[p].n; ++i)
    {
      Point<dim> x, f;
      for (int a = 0; a < dim; ++a)
      {
        x[a] = now[p].x[a][i];
        f[a] = now[p].mass[i] * (now[p].v[a][i] - before[p][a][i]) / kick;
      }
      if (now[p].body[i] < 0 || !inside(x))
        continue;
      const double size = f.norm() / (stress * std::pow(p == 0 ? node_edge : particle_edge, dim - 1));
      double      &to   = p == 0 ? residue.nodes : residue.particles;
      to                = std::max(to, size);
    }
  return residue;
}

/// Gradients of rates of strain without a trace, 1/s. (Compression shows the
/// lag of a step in the density that particles weigh each other by: a share of
/// the strain of one step.) One step strains by 1e-7, and rounding of the places
/// is 1e-9 of that: no figure below is finer than 1e-7.
constexpr double finest = 1e-6;

template <int dim>
std::vector<Eigen::Matrix3d> components()
{
  std::vector<Eigen::Matrix3d> all;
  for (int a = 0; a < dim; ++a)
    for (int b = a; b < dim; ++b)
    {
      all.push_back(Eigen::Matrix3d::Zero());
      all.back()(a, b) = 1;
      if (a == b)
        all.back()((a + 1) % dim, (a + 1) % dim) = -1;
    }
  return all;
}

/// A seam that leans by `tilt` along y and `turn` along z; particles stand on
/// their lattice, elements are sheared.
template <int dim>
void expect_patch(int ratio, double tilt, double turn = 0)
{
  auto scene = split_block(dim == 2 ? input::Dimension::plane_strain : input::Dimension::three_d, ratio,
                           Vec3(16 * dx, 24 * dx, dim == 3 ? 16 * dx : 0));
  scene.interfaces[0].damping     = 0; // its stress is that of a strain rate
  scene.bodies[0].shape.lower.x() = -24 * dx;
  scene.bodies[0].shape.upper.x() = 12 * dx;
  const double mid  = 12 * dx, middle = 8 * dx;
  const auto   seam = [&](const std::array<double, dim> &x) {
    return tilt * (x[1] - mid) + (dim == 3 ? turn * (x[dim - 1] - middle) : 0.);
  };
  const auto inside = [&](const Point<dim> &x) {
    return std::abs(x[0]) < 9 * dx && std::abs(x[1] - mid) < 5 * dx && (dim == 2 || std::abs(x[dim - 1] - middle) < 2 * dx);
  };
  for (const auto &g : components<dim>())
  {
    SCOPED_TRACE("ratio " + std::to_string(ratio) + ", tilt " + std::to_string(tilt));
    const auto r = patch<dim>(
      Pair<dim>(
        scene, [&](const auto &x) { return affine<dim>(g, x); },
        [&](const auto &x) { return x[0] < seam(x) - 1e-6 * dx; }, [&](auto &x) { x[0] += seam(x); }),
      dx, ratio * dx, inside);
    EXPECT_LT(r.nodes, finest);
    EXPECT_LT(r.particles, finest);
  }
}
} // namespace

// A uniform stress leaves no force on particles and nodes, along lattices and
// across them. Without the areas that go along the edges of the seam the nodes
// of tilted ones see 1e-2.
TEST(PairFlux, PatchInThePlane)
{
  for (const int ratio : {1, 2, 4})
    for (const double tilt : {0., .25, .6, 1.})
      expect_patch<2>(ratio, tilt);
}
TEST(PairFlux, PatchInSpace)
{
  expect_patch<3>(1, 0);
  expect_patch<3>(2, .3, .2);
}

TEST(PairFlux, PatchAroundACircle)
{
  for (const int ratio : {1, 2})
  {
    auto scene = steel_scene(input::Dimension::plane_strain);
    add_box(scene, "zone", input::Method::sph, Vec3::Zero(), Vec3::Zero(), dx, Vec3::Zero());
    scene.bodies[0].shape.kind   = input::ShapeKind::disc;
    scene.bodies[0].shape.radius = 12 * dx;
    add_box(scene, "rest", input::Method::fem, Vec3::Zero(), Vec3::Zero(), ratio * dx, Vec3::Zero());
    scene.bodies[1].shape.kind         = input::ShapeKind::ring;
    scene.bodies[1].shape.inner_radius = 12 * dx;
    scene.bodies[1].shape.radius       = 24 * dx;
    scene.interfaces.push_back({"seam", "pair-flux", "zone", "rest"});
    scene.interfaces[0].damping = 0;
    for (const auto &g : components<2>())
    {
      const auto r = patch<2>(Pair<2>(scene, [&](const auto &x) { return affine<2>(g, x); }), dx, ratio * dx,
                              [](const Point<2> &x) { return x.norm() < 20 * dx; });
      EXPECT_LT(r.nodes, finest) << ratio;
      EXPECT_LT(r.particles, finest) << ratio;
    }
  }
}

// v_r = r, v_z = -2z: uniform without a trace. Seams across the axis and around it.
TEST(PairFlux, PatchInAxialSymmetry)
{
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  g(0, 0)           = 1;
  g(1, 1)           = -2;
  for (const bool across : {true, false})
    for (const int ratio : {1, 2})
    {
      auto scene = steel_scene(input::Dimension::axisymmetric);
      add_box(scene, "zone", input::Method::sph, Vec3::Zero(), Vec3::Zero(), dx, Vec3::Zero());
      add_box(scene, "rest", input::Method::fem, Vec3::Zero(), Vec3::Zero(), ratio * dx, Vec3::Zero());
      auto &zone = scene.bodies[0].shape, &rest = scene.bodies[1].shape;
      zone.kind  = input::ShapeKind::disc;
      rest.kind  = across ? input::ShapeKind::disc : input::ShapeKind::ring;
      zone.axis = rest.axis = Vec3::UnitY();
      zone.radius           = 12 * dx;
      rest.radius           = across ? 12 * dx : 28 * dx;
      rest.inner_radius     = across ? 0 : 12 * dx;
      zone.length           = across ? 16 * dx : 24 * dx;
      rest.length           = zone.length;
      zone.base             = across ? Vec3(0, -zone.length, 0) : Vec3(0, -12 * dx, 0);
      rest.base             = across ? Vec3(0, 0, 0) : zone.base;
      scene.interfaces.push_back({"seam", "pair-flux", "zone", "rest"});
      scene.interfaces[0].damping = 0;
      const auto r = patch<2>(Pair<2>(scene, [&](const auto &x) { return affine<2>(g, x); }), dx, ratio * dx,
                              [&](const Point<2> &x) {
                                return across ? x[0] < 6 * dx && std::abs(x[1]) < 9 * dx :
                                                x[0] < 20 * dx && std::abs(x[1]) < 5 * dx;
                              });
      EXPECT_LT(r.nodes, finest) << across << " " << ratio;
      EXPECT_LT(r.particles, 1e-4) << across << " " << ratio; // what the factor of the axis leaves, seam or not
    }
}

namespace
{
/// Energy of random motion, of particles and elements alike, over what it was:
/// kinetic and elastic, at the end, and at half of the steps; and what the seam
/// made of energy.
struct Noise
{
  double half = 0, end = 0, made = 0, momentum = 0;
};

template <int dim>
Noise shake(input::Scene scene, int steps)
{
  std::mt19937 random(7);
  Pair<dim>    run(scene, [&](const auto &) {
    std::array<double, dim> v;
    for (double &c : v)
      c = random() * 0x1p-31 - 1;
    return v;
  });
  const LedgerRow first  = run.ledger();
  const auto      energy = [&] { return (run.ledger().kinetic + run.ledger().elastic) / first.kinetic; };
  Noise           noise;
  for (int n = 0; n < steps; ++n)
  {
    if (n == steps / 2)
      noise.half = energy();
    run.step();
  }
  noise.end      = energy();
  noise.made     = run.ledger().interface_work / first.kinetic;
  noise.momentum = (run.ledger().momentum - first.momentum).norm() / std::sqrt(2 * first.mass * first.kinetic);
  return noise;
}
} // namespace

// Undamped the seam feeds on noise: without the damping of the elements the
// energy passes a hundred times what it was within 2000 steps.
TEST(PairFlux, NoiseDecays)
{
  for (const int ratio : {1, 2, 4})
  {
    const Noise n = shake<2>(split_block(input::Dimension::plane_strain, ratio, Vec3(16 * dx, 12 * dx, 0)), 2000);
    EXPECT_LT(n.end, .5 * n.half + .05) << ratio;
    EXPECT_LT(n.half, .2) << ratio;
    EXPECT_LT(std::abs(n.made), .1) << ratio;
    EXPECT_LT(n.momentum, 1e-13) << ratio;
  }
  auto undamped = split_block(input::Dimension::plane_strain, 2, Vec3(16 * dx, 12 * dx, 0));
  undamped.interfaces[0].damping = 0;
  EXPECT_GT(shake<2>(undamped, 2000).made, 1);
}
TEST(PairFlux, NoiseDecaysInSpace)
{
  const Noise n = shake<3>(split_block(input::Dimension::three_d, 2, Vec3(16 * dx, 12 * dx, 12 * dx)), 600);
  EXPECT_LT(n.end, n.half);
  EXPECT_LT(n.half, .2);
  EXPECT_LT(std::abs(n.made), .1);
  EXPECT_LT(n.momentum, 1e-13);
}

// A whole turn of a block with a seam within: it stretches under its own inertia
// and is otherwise as it was.
TEST(PairFlux, TurnsWithItsBlock)
{
  for (const int ratio : {1, 2})
  {
    const auto   scene = split_block(input::Dimension::plane_strain, ratio, Vec3(8 * dx, 16 * dx, 0));
    const double rate  = 2e4; // rad/s: 160 m/s at the ends, a stress of some 1e-3 of E
    Pair<2>      run(scene, [&](const auto &x) { return std::array<double, 2>{-rate * (x[1] - 8 * dx), rate * x[0]}; });
    const LedgerRow first = run.ledger();
    while (rate * run.time < 6.3)
      run.step();
    const LedgerRow last = run.ledger();
    EXPECT_NEAR(last.angular_momentum.z() / first.angular_momentum.z(), 1, 1e-5) << ratio;
    EXPECT_NEAR(last.kinetic / first.kinetic, 1, 2e-3) << ratio; // the block has stretched
    EXPECT_NEAR(last.total / first.total, 1, 2e-4) << ratio;
  }
}
} // namespace ogive::coupling
