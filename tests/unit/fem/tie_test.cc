// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of elements tied where their meshes do not match.
#include "core/base/error.h"
#include "core/io/memory_archive.h"
#include "fem/tie.h"
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
constexpr double H = 1e-3; // edge of the master, m

/// Slave of edge `fine` on top of a master of edge H, 3 H wide, `gap` apart; body
/// 0 is the master.
template <int dim>
std::vector<BodyMesh<dim>> pair_of(double fine = .75 * H, double gap = 0, bool axisymmetric = false)
{
  const double               x0 = axisymmetric ? 0 : H;
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(block<dim>({x0, 0, 0}, {x0 + 3 * H, 2 * H, 3 * H}, H, axisymmetric, 0));
  meshes.push_back(
      block<dim>({x0, 2 * H + gap, 0}, {x0 + 3 * H, 2 * H + gap + 3 * fine, 3 * H}, fine, axisymmetric, 1));
  return meshes;
}

Parameters tied(Parameters p = {})
{
  p.ties = {{"seam", 1, 0, .1}};
  return p;
}

template <int dim>
void move(std::vector<BodyMesh<dim>> &meshes, const std::function<Vec3(const Vec3 &)> &velocity)
{
  for (auto &mesh : meshes)
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    {
      Vec3 x = Vec3::Zero();
      for (int i = 0; i < dim; ++i)
        x[i] = mesh.x[i][a];
      const Vec3 v = velocity(x);
      for (int i = 0; i < dim; ++i)
        mesh.v[i][a] = v[i];
    }
}

// A point over a skewed quadrilateral: its foot is the one from which the line to
// the point stands upright, and beyond an edge the foot stays on the edge.
TEST(Tie, NearestPointOfAFacet)
{
  auto mesh = block<3>({0, 0, 0}, {H, H, H}, H);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.x[2][a] == H && mesh.x[0][a] == H)
      mesh.x[1][a] = mesh.x[1][a] > 0 ? 1.4 * H : -.2 * H;
  const auto            top = *std::find_if(mesh.facets.begin(), mesh.facets.end(),
                                            [&](const auto &f) { return mesh.boundary_names[f.boundary] == "z+"; });
  std::array<double, 4> weight;
  const auto            foot = [&](const std::array<double, 3> &p)
  {
    Vec3         x   = Vec3::Zero();
    const double gap = nearest_on_facet<3>(mesh, top, p, weight);
    for (int k = 0; k < 4; ++k)
      x += weight[k] * Vec3(mesh.x[0][top.node[k]], mesh.x[1][top.node[k]], mesh.x[2][top.node[k]]);
    EXPECT_NEAR(gap, (x - Vec3(p[0], p[1], p[2])).norm(), 1e-18);
    return x;
  };
  EXPECT_NEAR((foot({.7 * H, 1.1 * H, 1.3 * H}) - Vec3(.7 * H, 1.1 * H, H)).norm(), 0, 1e-12 * H);
  EXPECT_NEAR((foot({1.5 * H, .3 * H, H}) - Vec3(H, .3 * H, H)).norm(), 0, 1e-9 * H);
  EXPECT_NEAR((foot({1.5 * H, 2 * H, H}) - Vec3(H, 1.4 * H, H)).norm(), 0, 1e-9 * H);
}

// Strain passes a seam of 4 on 3 elements exactly: an affine motion gives both
// bodies one stress.
template <int dim>
void expect_patch(bool axisymmetric)
{
  auto         meshes  = pair_of<dim>(.75 * H, 0, axisymmetric);
  const double g[3][3] = {{900, 400, -300}, {-200, -700, 500}, {100, -600, 800}};
  move<dim>(meshes,
            [&](const Vec3 &x)
            {
              Vec3 v = Vec3::Zero();
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  if (!axisymmetric || i == j)
                    v[i] += g[i][j] * x[j];
              return v;
            });
  auto solver = solver_with<dim>(std::move(meshes), tied());
  ASSERT_TRUE(solver->step({0, 1e-9, 1e-5}).ok);
  for (int body = 0; body < 2; ++body)
  {
    const Sample s = solver->sample(body);
    for (int c = 0; c < 6; ++c)
      for (const double stress : s.sigma[c])
        EXPECT_NEAR(stress, solver->sample(0).sigma[c][0], 1e-12 * 117e9 * 1e-2);
  }
}
TEST(Tie, PatchLine)
{
  expect_patch<1>(false);
}
TEST(Tie, PatchPlaneStrain)
{
  expect_patch<2>(false);
}
TEST(Tie, PatchAxisymmetric)
{
  expect_patch<2>(true);
}
TEST(Tie, PatchHex)
{
  expect_patch<3>(false);
}

// The uniform traction comes to the masters lumped at the slaves: the kink of a
// master's hat inside a slave interval of length h costs at most h^2/(4 H) of H,
// so a seam that does not match pulls at its nodes by up to (h/H)^2/4 of sigma H;
// one whose slaves halve the master's edges by nothing.
double unbalanced(double fine)
{
  auto meshes = pair_of<2>(fine);
  move<2>(meshes, [](const Vec3 &x) { return Vec3(0, 700 * x.y(), 0); });
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  auto solver                                      = solver_with<2>(std::move(meshes), tied(p));
  EXPECT_TRUE(solver->step({0, 1e-9, 1e-5}).ok);
  const Sample s    = solver->sample(0);
  const double kick = 1e-9;
  EXPECT_TRUE(solver->step({1e-5, kick, kick}).ok);
  const Sample t     = solver->sample(0);
  const auto   nodes = solver->surface();
  double       worst = 0;
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    if (s.x0[1][a] == 2 * H && s.x0[0][a] > 1.01 * H && s.x0[0][a] < 3.99 * H)
      worst = std::max(worst, nodes.mass[a] * std::abs(t.v[1][a] - s.v[1][a]) / kick);
  return worst / (std::abs(s.sigma[1][0]) * H);
}
TEST(Tie, UniformTractionAtASeam)
{
  const double nested = unbalanced(.5 * H), rough = unbalanced(.75 * H), fine = unbalanced(3. / 7 * H);
  std::printf("unbalanced force over sigma H: h/H 3/4 %.4f, 1/2 %.1e, 3/7 %.4f\n", rough, nested, fine);
  EXPECT_LT(nested, 1e-10);
  EXPECT_LT(rough, .75 * .75 / 4);
  EXPECT_GT(rough, 1e-3);
  EXPECT_LT(fine, 9. / 49 / 4);
}

// Violent motion of tied, shaken bodies, a gap closed at the start included.
template <int dim>
void expect_conservation(bool axisymmetric)
{
  auto meshes = pair_of<dim>(.75 * H, .03 * H, axisymmetric);
  for (auto &mesh : meshes)
    shake(mesh, .05 * H, 30);
  auto          solver = solver_with<dim>(std::move(meshes), tied());
  const Balance b0     = solver->balance();
  const Books   worst  = books_over(*solver, 300);
  EXPECT_LT(worst.energy, 1e-12 * b0.kinetic);
  EXPECT_LT(axisymmetric ? 0. : worst.momentum, 1e-13 * b0.mass * 30);
  EXPECT_LT(solver->balance().kinetic, .9 * b0.kinetic);
}
TEST(Tie, ConservesLine)
{
  expect_conservation<1>(false);
}
TEST(Tie, ConservesPlaneStrain)
{
  expect_conservation<2>(false);
}
TEST(Tie, ConservesAxisymmetric)
{
  expect_conservation<2>(true);
}
TEST(Tie, ConservesHex)
{
  expect_conservation<3>(false);
}

TEST(Tie, SpinKeepsAngularMomentum)
{
  auto meshes = pair_of<3>(.75 * H, .05 * H);
  move<3>(meshes, [](const Vec3 &x) { return Vec3(Vec3(2e4, -3e4, 1e4).cross(x - Vec3(2 * H, 2 * H, H))); });
  auto      solver = solver_with<3>(std::move(meshes), tied());
  Driver<3> driver{*solver};
  ASSERT_TRUE(driver.once().ok);
  const Vec3 L0 = solver->balance().angular_momentum;
  for (int k = 0; k < 1000; ++k)
    ASSERT_TRUE(driver.once().ok);
  EXPECT_NEAR((solver->balance().angular_momentum - L0).norm() / L0.norm(), 0, 1e-12);
}

TEST(Tie, NoiseStaysBounded)
{
  auto meshes = pair_of<3>(.4 * H);
  for (auto &mesh : meshes)
    shake(mesh, 0, 1e-3);
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  auto          solver                             = solver_with<3>(std::move(meshes), tied(p));
  const Balance b0                                 = solver->balance();
  Driver<3>     driver{*solver};
  for (int k = 0; k < 10000; ++k)
    ASSERT_TRUE(driver.once().ok);
  const Balance b = solver->balance();
  EXPECT_LT(b.kinetic + b.elastic + b.hourglass_fem, 1.02 * b0.kinetic);
}

// Gravity on both bodies: each node falls alike, slaves and their masters too.
TEST(Tie, BodiesFallTogether)
{
  Parameters p = tied();
  p.boundaries = {boundary("", input::BoundaryKind::body_force),
                  boundary("", input::BoundaryKind::body_force)};
  for (auto &b : p.boundaries)
    b.acceleration = {0, -1e7, 0};
  p.boundary_bodies = {0, 1};
  auto      solver  = solver_with<2>(pair_of<2>(), p);
  Driver<2> driver{*solver};
  driver.fixed_dt = .05e-6;
  for (int k = 0; k < 100; ++k)
    ASSERT_TRUE(driver.once().ok);
  const double fall = -1e7 * (driver.time - .5 * driver.last);
  for (int body = 0; body < 2; ++body)
  {
    const Sample s = solver->sample(body);
    for (const double v : s.v[1])
      EXPECT_NEAR(v / fall, 1, 1e-10);
  }
  EXPECT_NEAR(solver->balance().kinetic / solver->balance().external_work, 1, 1e-10);
}

// What a tie covers is no surface any more; the report says what was done.
// The seam stays part of the surface: what strikes across it must be closed.
TEST(Tie, ReportsTheSeamAndKeepsTheSurfaceClosed)
{
  auto       meshes = pair_of<3>(.75 * H, .05 * H);
  const auto loose  = solver_with<3>(pair_of<3>(.75 * H, .05 * H))->surface().facets.size();
  auto       solver = solver_with<3>(std::move(meshes), tied());
  ASSERT_EQ(solver->ties().size(), 1u);
  EXPECT_EQ(solver->ties()[0].nodes, 25u);
  EXPECT_NEAR(solver->ties()[0].largest_gap, .05 * H, 1e-12 * H);
  EXPECT_EQ(loose, solver->surface().facets.size());
}

// "all" of a tied body's surface leaves out the seam; its covered face has nothing
// for a boundary to act on.
TEST(Tie, BoundariesActOnTheFreeSurface)
{
  Parameters p             = tied();
  p.boundaries             = {boundary("all", input::BoundaryKind::pressure)};
  p.boundaries[0].pressure = 1e6;
  auto      solver         = solver_with<2>(pair_of<2>(), p);
  Driver<2> driver{*solver};
  driver.fixed_dt = 1e-9;
  ASSERT_TRUE(driver.once().ok);
  // pressed from below alone, over 3 H
  EXPECT_NEAR(solver->balance().momentum.y() / (1e6 * 3 * H * .5e-9), 1, 1e-9);
  EXPECT_NEAR(solver->balance().momentum.x(), 0, 1e-12 * 1e6 * 3 * H * .5e-9);
  p.boundaries[0].face = "y+";
  EXPECT_THROW(solver_with<2>(pair_of<2>(), p), InputError);
}

// Half the run, save, load into a fresh solver, the other half: the same bits.
TEST(Tie, RestartIsBitwise)
{
  const auto fresh = []
  {
    auto meshes = pair_of<3>();
    for (auto &mesh : meshes)
      shake(mesh, .05 * H, 30);
    Parameters p = tied();
    p.boundaries = {boundary("y-", input::BoundaryKind::absorbing)};
    return solver_with<3>(std::move(meshes), p);
  };
  const auto first = fresh(), second = fresh();
  Driver<3>  a{*first}, b{*second};
  a.fixed_dt = b.fixed_dt = .05e-6;
  for (int k = 0; k < 30; ++k)
    ASSERT_TRUE(a.once().ok);
  io::MemoryArchive archive;
  first->save(archive, "fem");
  second->load(archive, "fem");
  b.time = a.time;
  b.last = a.last;
  for (int k = 0; k < 30; ++k)
  {
    ASSERT_TRUE(a.once().ok);
    ASSERT_TRUE(b.once().ok);
  }
  for (int body = 0; body < 2; ++body)
  {
    EXPECT_EQ(first->sample(body).v, second->sample(body).v);
    EXPECT_EQ(first->sample(body).mass, second->sample(body).mass);
  }
  EXPECT_EQ(first->balance().absorbed, second->balance().absorbed);
  EXPECT_GT(first->balance().absorbed, 0);
}

TEST(Tie, RefusesWhatItCannotTie)
{
  EXPECT_THROW(solver_with<2>(pair_of<2>(.75 * H, .2 * H), tied()), InputError);
  Parameters both = tied();
  both.ties.push_back({"back", 0, 1, .1});
  EXPECT_THROW(solver_with<2>(pair_of<2>(H), both), InputError);
}
} // namespace
