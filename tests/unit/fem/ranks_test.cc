// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements on several ranks against the same elements on one: positions, velocities,
// masses, surface and books to 1e-9 after some hundred steps, since sums over the ranks
// differ by rounding only.
#include "fem/mesh_file.h"
#include "tests/unit/fem/twins.h"

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
constexpr double H = 1e-3;

template <int dim>
void expect_twins(BodyMesh<dim> mesh, Parameters p = {}, int steps = 60)
{
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(std::move(mesh));
  Twins<dim> twins(meshes, std::move(p));
  twins.steps(steps);
  twins.expect_equal();
}

Parameters with(const std::string &partition)
{
  Parameters p;
  p.parallel.partition = partition;
  return p;
}

TEST(Ranked, BlocksInEachDimension)
{
  const auto flowing = make(copper_linear_hardening());
  expect_twins<1>(wild_block<1>(flowing));
  expect_twins<2>(wild_block<2>(flowing));
  expect_twins<2>(wild_block<2>(flowing, true));
  expect_twins<3>(wild_block<3>(flowing), {}, 200);
}

TEST(Ranked, SharedByTheForest)
{
  const auto flowing = make(copper_linear_hardening());
  expect_twins<1>(wild_block<1>(flowing), with("p4est"));
  expect_twins<2>(wild_block<2>(flowing), with("p4est"));
  expect_twins<3>(wild_block<3>(flowing), with("p4est"));
  expect_twins<3>(wild_block<3>(make(copper()), false, 10, .05, "spectral", 2), with("p4est"), 30);
}

TEST(Ranked, ElementsWithSeveralPoints)
{
  const auto solid = make(copper());
  for (const std::string element : {"full", "b-bar"})
  {
    expect_twins<2>(wild_block<2>(solid, false, 10, .1, element));
    expect_twins<2>(wild_block<2>(solid, true, 10, .1, element));
    expect_twins<3>(wild_block<3>(solid, false, 10, .1, element), {}, 30);
  }
  expect_twins<1>(wild_block<1>(solid, false, 10, .05, "spectral", 3));
  expect_twins<2>(wild_block<2>(solid, false, 10, .05, "spectral", 2));
  expect_twins<3>(wild_block<3>(solid, false, 10, .05, "spectral", 2), {}, 30);
}

/// Sums over the ranks within a step.
TEST(Ranked, RingsWeighedByArea)
{
  expect_twins<2>(wild_block<2>(make(copper_linear_hardening()), true, 20, .1, "area-weighted"));
}
TEST(Ranked, CorrectedViscosity)
{
  Parameters p;
  p.options.correction = "pairwise";
  expect_twins<2>(wild_block<2>(make(copper_linear_hardening())), p);
  expect_twins<2>(wild_block<2>(make(copper_linear_hardening()), true), p);
  expect_twins<3>(wild_block<3>(make(copper_linear_hardening())), p);
}

TEST(Ranked, MassScaling)
{
  const auto mesh = wild_block<3>(make(copper()), false, 10);
  Parameters p;
  p.options.mass_scaling_step = 1.2e-7;
  Twins<3> twins({mesh}, p);
  ASSERT_EQ(twins.alone->added_masses().size(), 1u);
  ASSERT_EQ(twins.together->added_masses().size(), 1u);
  EXPECT_NEAR(twins.together->added_masses()[0].mass / twins.alone->added_masses()[0].mass, 1, 1e-12);
  twins.steps(60);
  twins.expect_equal();
}

TEST(Ranked, CriticalStepByPowerIteration)
{
  const auto mesh = wild_block<3>(make(copper()), false, 10);
  Parameters p;
  p.options.step_bound = "power-iteration";
  Twins<3> twins({mesh}, p);
  // 1e-6 a step is where the iteration stops; rounding alters when it does.
  EXPECT_NEAR(twins.together->critical_dt().dt / twins.alone->critical_dt().dt, 1, 1e-6);
  const double dt = .7 * twins.alone->stable_dt().dt;
  for (int k = 0; k < 30; ++k)
    for (auto *solver : {twins.alone.get(), twins.together.get()})
      ASSERT_TRUE(solver->step({k * dt, k == 0 ? .5 * dt : dt, dt}).ok);
  twins.expect_equal();
}

template <int dim>
void expect_hanging(bool axisymmetric, Parameters p = {})
{
  constexpr double h = .5e-3;
  input::Scene     scene;
  scene.dimension       = dimension_of(dim, axisymmetric);
  const double x0       = axisymmetric ? 0 : -8 * h;
  input::Body  body     = box({x0, -8 * h, -4 * h}, {x0 + 16 * h, 8 * h, 4 * h}, h);
  body.coarsen          = 2;
  body.coarsen_distance = 3 * h;
  body.coarsen_from     = {0, -8 * h, 0};
  auto mesh             = make_mesh<dim>(body, scene, 0, make(copper()));
  shake(mesh, .05 * h, 5);
  straighten(mesh);
  ASSERT_FALSE(mesh.hanging.empty());
  expect_twins<dim>(std::move(mesh), std::move(p), 60);
}
TEST(Ranked, HangingNodes)
{
  expect_hanging<2>(false);
  expect_hanging<2>(true);
  expect_hanging<3>(false);
  expect_hanging<2>(false, with("p4est"));
  Parameters p;
  p.symmetry   = {{1}};
  p.boundaries = {boundary("all", input::BoundaryKind::absorbing)};
  expect_hanging<2>(false, p);
}

/// A fine body tied to a coarse one that is pressed from below.
template <int dim>
void expect_tied(bool axisymmetric)
{
  const double               x0 = axisymmetric ? 0 : H, fine = .75 * H;
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(block<dim>({x0, 0, 0}, {x0 + 3 * H, 2 * H, 3 * H}, H, axisymmetric, 0));
  meshes.push_back(block<dim>({x0, 2 * H, 0}, {x0 + 3 * H, 2 * H + 3 * fine, 3 * H}, fine, axisymmetric, 1));
  for (auto &mesh : meshes)
    shake(mesh, 0, 5);
  Parameters p;
  p.ties                   = {{"seam", 1, 0, .1}};
  p.boundaries             = {boundary("y-", input::BoundaryKind::pressure)};
  p.boundaries[0].pressure = 50e6;
  p.boundaries.push_back(boundary("", input::BoundaryKind::body_force));
  p.boundaries[1].acceleration = {0, -1e5, 0};
  Twins<dim> twins(meshes, p);
  twins.steps(80);
  twins.expect_equal();
  EXPECT_GT(twins.alone->balance().external_work, 0);
}
TEST(Ranked, TiedBodies)
{
  expect_tied<2>(false);
  expect_tied<2>(true);
  expect_tied<3>(false);
}

/// A fast block against two walls, rough and moving, with one face driven.
TEST(Ranked, WallsAndDrivenFaces)
{
  auto mesh = block<3>({0, 0, 0}, {5 * H, 4 * H, 4 * H}, H, false, 0, copper_linear_hardening());
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    mesh.v[0][a] = 30;
    mesh.v[1][a] = -60;
  }
  Parameters       p;
  input::RigidWall floor;
  floor.name               = "floor";
  floor.normal             = {.1, 1, 0};
  floor.friction           = .2;
  input::RigidWall side    = floor;
  side.name                = "side";
  side.normal              = {-1, 0, 0};
  side.point               = {5.2 * H, 0, 0};
  side.velocity            = {-5, 0, 0};
  p.walls                  = {floor, side};
  p.boundaries             = {boundary("z-", input::BoundaryKind::velocity)};
  p.boundaries[0].velocity = {0, 0, 3};
  p.boundaries[0].fix[0] = p.boundaries[0].fix[1] = false;
  Twins<3> twins({mesh}, p);
  for (int k = 0; k < 120; ++k)
  {
    twins.step();
    for (std::size_t w = 0; w < 2; ++w)
      ASSERT_NEAR(twins.alone->wall_force(w), twins.together->wall_force(w),
                  1e-6 * 60 * twins.alone->balance().mass / 1e-6);
  }
  twins.expect_equal();
  EXPECT_GT(twins.alone->balance().friction_heat, 0);
}

TEST(Ranked, AbsorbingFaces)
{
  for (const bool axisymmetric : {false, true})
  {
    auto mesh = block<2>({0, 0, 0}, {8 * H, 6 * H, 0}, H, axisymmetric);
    shake(mesh, .1 * H, 5);
    Parameters p;
    p.boundaries = {boundary("x+", input::BoundaryKind::absorbing),
                    boundary("y-", input::BoundaryKind::absorbing)};
    expect_twins<2>(mesh, p);
  }
}

/// Some ranks have nothing, and say so.
TEST(Ranked, MoreRanksThanElements)
{
  std::vector<BodyMesh<2>> meshes;
  meshes.push_back(block<2>({0, 0, 0}, {2 * H, H, 0}, H));
  meshes.push_back(block<2>({5 * H, 0, 0}, {6 * H, H, 0}, H, false, 1));
  for (auto &mesh : meshes)
    shake(mesh, .1 * H, 5);
  Twins<2> twins(meshes);
  twins.steps(100);
  twins.expect_equal();
  EXPECT_EQ(twins.ranks.sum(static_cast<std::int64_t>(twins.together->share().elements)), 3);
}

/// A plate with a hole from a mesh file.
TEST(Ranked, PlateWithAHole)
{
  input::Scene scene;
  scene.dimension = input::Dimension::plane_strain;
  input::Body body;
  body.name            = "plate";
  body.shape.mesh_file = std::string(OGIVE_SOURCE_DIR) + "/meshes/plate-41.msh";
  body.shape.kind      = input::ShapeKind::mesh;
  auto mesh            = make_mesh<2>(body, scene, 0, make(copper_linear_hardening()));
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    mesh.v[0][a] = 20 * std::sin(200 * mesh.x[1][a]);
  expect_twins<2>(mesh);
  expect_twins<2>(mesh, with("p4est"));
}
} // namespace
