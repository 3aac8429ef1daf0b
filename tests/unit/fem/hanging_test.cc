// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes whose edges double with distance, and the nodes that hang in them.
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <set>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
constexpr double h = .5e-3; // finest edge, m

/// A box of edges h, 2 h and 4 h about a point on its lower face.
template <int dim>
BodyMesh<dim> graded_box(bool axisymmetric = false, double distortion = 0, double speed = 0)
{
  input::Scene scene;
  scene.dimension       = dimension_of(dim, axisymmetric);
  const double x0       = axisymmetric ? 0 : -8 * h;
  input::Body  body     = box({x0, -8 * h, -4 * h}, {x0 + 16 * h, 8 * h, 4 * h}, h);
  body.coarsen          = 2;
  body.coarsen_distance = 3 * h;
  body.coarsen_from     = {0, -8 * h, 0};
  auto mesh             = make_mesh<dim>(body, scene, 0, make(copper()));
  shake(mesh, distortion, speed);
  straighten(mesh);
  return mesh;
}

template <int dim>
std::vector<double> edges(const BodyMesh<dim> &mesh)
{
  std::vector<double> all;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    all.push_back(mesh.x[0][mesh.cells[c * mesh.corners + 1]] - mesh.x[0][mesh.cells[c * mesh.corners]]);
  return all;
}

// Edges are h, 2 h and 4 h, the finest near the point; volume and names are those
// of the box; a hanging node stands between its masters.
template <int dim>
void expect_graded(bool axisymmetric, double volume)
{
  const auto mesh = graded_box<dim>(axisymmetric);
  EXPECT_NEAR(mesh.volume() / volume, 1, 1e-12);
  std::set<int> seen;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
  {
    const double size = edges(mesh)[c] / h;
    seen.insert(static_cast<int>(std::lround(size)));
    EXPECT_NEAR(size, std::lround(size), 1e-9);
    double near = 0;
    for (int i = 0; i < dim; ++i)
    {
      double low = 1e300, high = -1e300;
      for (int a = 0; a < mesh.corners; ++a)
      {
        low  = std::min(low, mesh.x[i][mesh.cells[c * mesh.corners + a]]);
        high = std::max(high, mesh.x[i][mesh.cells[c * mesh.corners + a]]);
      }
      const double at = i == 1 ? -8 * h : 0, off = std::max({0., low - at, at - high});
      near += off * off;
    }
    EXPECT_LE(size, near < 2.99 * h * 2.99 * h ? 1.001 : 4.001);
  }
  EXPECT_EQ(seen, (std::set<int>{1, 2, 4}));
  EXPECT_EQ(mesh.hanging.empty(), dim == 1);
  for (const auto &hanging : mesh.hanging)
    EXPECT_TRUE(hanging.n == 2 || (dim == 3 && hanging.n == 4));
  const std::set<std::string> names(mesh.boundary_names.begin(), mesh.boundary_names.end());
  EXPECT_EQ(names.contains("x+"), true);
  EXPECT_EQ(names.contains("x-"), !axisymmetric);
  EXPECT_EQ(names.contains("symmetry-axis"), axisymmetric);
}
TEST(Coarsen, Line)
{
  input::Scene scene;
  scene.dimension  = input::Dimension::uniaxial;
  input::Body body = box({0, 0, 0}, {12 * h, 0, 0}, h);
  body.coarsen = 1, body.coarsen_distance = 4 * h;
  const auto mesh = make_mesh<1>(body, scene, 0, make(copper()));
  EXPECT_EQ(mesh.n_cells(), 8u);
  EXPECT_NEAR(mesh.volume() / (12 * h), 1, 1e-14);
}
TEST(Coarsen, PlaneStrain)
{
  expect_graded<2>(false, 256 * h * h);
}
TEST(Coarsen, Axisymmetric)
{
  expect_graded<2>(true, M_PI * 256 * h * h * 16 * h);
}
TEST(Coarsen, Hex)
{
  expect_graded<3>(false, 2048 * h * h * h);
}

// Refined rims lie on the true circle: away from hanging nodes, which stay on
// chords, the nodes of the side have its radius.
TEST(Coarsen, CylinderIsRoundNearTheFoot)
{
  input::Scene scene;
  scene.symmetry               = {{0}, {1}};
  input::Body body             = box(Vec3::Zero(), Vec3::Zero(), h);
  body.shape.kind              = input::ShapeKind::cylinder;
  body.shape.radius            = 8 * h;
  body.shape.length            = 32 * h;
  body.coarsen                 = 1;
  body.coarsen_distance        = 12 * h;
  const auto              mesh = make_mesh<3>(body, scene, 0, make(copper()));
  std::set<std::uint32_t> hanging;
  for (const auto &n : mesh.hanging)
    hanging.insert(n.node);
  std::size_t rim = 0;
  for (const auto &facet : mesh.facets)
    if (mesh.boundary_names[facet.boundary] == "side")
      for (const std::uint32_t a : facet.node)
        if (!hanging.contains(a))
        {
          EXPECT_NEAR(std::hypot(mesh.x[0][a], mesh.x[1][a]), 8 * h, 1e-12 * h);
          rim += mesh.x[2][a] == 0;
        }
  EXPECT_EQ(rim, 16u); // 9 nodes on the quarter, all but the ends of two facets
  EXPECT_GT(mesh.hanging.size(), 0u);
}

// Every shape but those with a nose can be coarsened: the mesh is not folded
// (make_mesh refuses that), it hangs somewhere, and its volume is that of the shape
// less the chords of its facets, 2 h long and so 1/3 (h/R)^2 short at most.
template <int dim>
void expect_shape(input::ShapeKind kind, input::Dimension dimension, double volume)
{
  input::Scene scene;
  scene.dimension         = dimension;
  const double R          = 8 * h;
  input::Body body        = box(Vec3::Zero(), Vec3::Zero(), h);
  body.shape.kind         = kind;
  body.shape.radius       = R;
  body.shape.inner_radius = .5 * R;
  body.shape.length       = R;
  body.shape.axis         = dim == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  body.coarsen            = 1;
  body.coarsen_distance   = .6 * R;
  body.coarsen_from       = dim == 2 ? Vec3(0, R, 0) : Vec3(0, 0, R);
  const auto mesh         = make_mesh<dim>(body, scene, 0, make(copper()));
  EXPECT_GT(mesh.hanging.size(), 0u);
  EXPECT_LE(mesh.volume(), volume * (1 + 1e-12));
  EXPECT_GT(mesh.volume(), volume * (1 - 4. / 64));
}
TEST(Coarsen, AllShapes)
{
  using input::Dimension, input::ShapeKind;
  const double R = 8 * h, ball = 4. / 3 * M_PI * R * R * R, disc = M_PI * R * R;
  expect_shape<3>(ShapeKind::sphere, Dimension::three_d, ball);
  expect_shape<3>(ShapeKind::shell, Dimension::three_d, 7. / 8 * ball);
  expect_shape<3>(ShapeKind::cylinder, Dimension::three_d, disc * R);
  expect_shape<3>(ShapeKind::disc, Dimension::three_d, disc * R);
  expect_shape<3>(ShapeKind::ring, Dimension::three_d, .75 * disc * R);
  expect_shape<2>(ShapeKind::disc, Dimension::plane_strain, disc);
  expect_shape<2>(ShapeKind::ring, Dimension::plane_strain, .75 * disc);
  expect_shape<2>(ShapeKind::sphere, Dimension::axisymmetric, ball);
  expect_shape<2>(ShapeKind::shell, Dimension::axisymmetric, 7. / 8 * ball);
  expect_shape<2>(ShapeKind::ring, Dimension::axisymmetric, .75 * disc * R);
}

// A plate of 100 mm radius and 12 mm thickness, edges of 1 mm within 20 mm of the
// axis, 2 mm to 40 mm, 4 mm to the rim: the count is area over edge^2 times the
// elements through the thickness, ring by ring.
TEST(Coarsen, SavesElementsOnAPlate)
{
  input::Scene scene;
  scene.symmetry    = {{0}, {1}};
  input::Body body  = box(Vec3::Zero(), Vec3::Zero(), 1e-3);
  body.shape.kind   = input::ShapeKind::disc;
  body.shape.radius = .1;
  body.shape.length = .012;
  const auto even   = make_mesh<3>(body, scene, 0, make(copper()));
  body.coarsen = 2, body.coarsen_distance = .02, body.coarsen_along = Vec3::UnitZ();
  const auto   graded   = make_mesh<3>(body, scene, 0, make(copper()));
  const double quarter  = M_PI / 4;
  const double estimate = quarter * (12 * 400 + 6 * 1200 / 4. + 3 * 8400 / 16.);
  std::printf("plate: %zu elements even, %zu graded\n", even.n_cells(), graded.n_cells());
  EXPECT_NEAR(even.n_cells() / (quarter * 12e4), 1, .1);
  EXPECT_NEAR(graded.n_cells() / estimate, 1, .5);                 // cells at a border are fine as a whole
  EXPECT_NEAR(graded.volume() / (quarter * 1e-2 * .012), 1, 2e-3); // the rim has chords of 4 mm
}

// Affine velocities give every element the same stress across hanging nodes, and
// the uniform stress puts no force on the free nodes inside.
template <int dim>
void expect_patch(bool axisymmetric)
{
  auto         mesh    = graded_box<dim>(axisymmetric, .15 * h);
  const double g[3][3] = {{900, 400, -300}, {-200, -700, 500}, {100, -600, 800}};
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    for (int i = 0; i < dim; ++i)
    {
      mesh.v[i][a] = 0;
      for (int j = 0; j < dim; ++j)
        if (!axisymmetric || i == j)
          mesh.v[i][a] += g[i][j] * mesh.x[j][a];
    }
  std::vector<bool> inside(mesh.n_nodes(), true);
  for (const auto &facet : mesh.facets)
    for (const std::uint32_t a : facet.node)
      inside[a] = mesh.boundary_names[facet.boundary] == "symmetry-axis" && inside[a];
  for (const auto &hanging : mesh.hanging) // these go where their masters go
    inside[hanging.node] = false;
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  const auto material                              = mesh.material;
  auto       solver                                = solver_with(std::move(mesh), p);
  ASSERT_TRUE(solver->step({0, 1e-9, 1e-5}).ok);
  const Sample s = solver->sample(0);
  for (int c = 0; c < 6; ++c)
    for (const double stress : s.sigma[c])
      EXPECT_NEAR(stress, s.sigma[c][0], 1e-12 * 117e9 * 1e-2);
  EXPECT_GT(std::abs(s.sigma[0][0]), 1e5);
  const double kick = 1e-9;
  ASSERT_TRUE(solver->step({1e-5, kick, kick}).ok);
  const Sample t     = solver->sample(0);
  double       inner = 0, outer = 0;
  for (std::size_t a = 0; a < t.mass.size(); ++a)
    for (int i = 0; i < dim; ++i)
      (inside[a] ? inner : outer) = std::max(inside[a] ? inner : outer, std::abs(t.v[i][a] - s.v[i][a]));
  EXPECT_GT(outer, 1e-3);
  EXPECT_LT(inner, 1e-11 * outer);
}
TEST(Hanging, PatchPlaneStrain)
{
  expect_patch<2>(false);
}
TEST(Hanging, PatchAxisymmetric)
{
  expect_patch<2>(true);
}
TEST(Hanging, PatchHex)
{
  expect_patch<3>(false);
}

// Violent motion: energy and momentum to rounding; slaves stay on their places.
template <int dim>
void expect_conservation(bool axisymmetric)
{
  auto          mesh    = graded_box<dim>(axisymmetric, .15 * h, 30);
  const auto    hanging = mesh.hanging;
  auto          solver  = solver_with(std::move(mesh));
  const Balance b0      = solver->balance();
  const Books   worst   = books_over(*solver, 300);
  EXPECT_LT(worst.energy, 1e-12 * b0.kinetic);
  EXPECT_LT(axisymmetric ? 0. : worst.momentum, 1e-13 * b0.mass * 30);
  EXPECT_LT(solver->balance().kinetic, .9 * b0.kinetic);
  const Sample s    = solver->sample(0);
  double       mass = 0;
  for (const double m : s.mass)
    mass += m;
  EXPECT_NEAR(mass / b0.mass, 1, 1e-12);
  for (const auto &n : hanging)
    for (int i = 0; i < dim; ++i)
    {
      double middle = 0;
      for (std::size_t k = 0; k < n.n; ++k)
        middle += s.x[i][n.master[k]] / n.n;
      EXPECT_NEAR(s.x[i][n.node], middle, 1e-15);
    }
}
TEST(Hanging, ConservesPlaneStrain)
{
  expect_conservation<2>(false);
}
TEST(Hanging, ConservesAxisymmetric)
{
  expect_conservation<2>(true);
}
TEST(Hanging, ConservesHex)
{
  expect_conservation<3>(false);
}

// Masters carry what walls and driven faces ask of slaves: hanging nodes of the
// struck face stay on the right side of the wall, those of a driven face move with it.
TEST(Hanging, WallsAndDrivenFaces)
{
  auto       mesh    = graded_box<3>();
  const auto hanging = mesh.hanging;
  for (double &v : mesh.v[1])
    v = -20;
  Parameters p;
  p.walls                  = {{"wall", Vec3(0, -8 * h, 0), Vec3(.3, 1, .1).normalized(), Vec3::Zero(), .2}};
  p.walls[0].point         = {-8 * h, -8 * h, -4 * h}; // the corner that touches first
  p.boundaries             = {boundary("z+", input::BoundaryKind::velocity)};
  p.boundaries[0].velocity = {0, 0, 5};
  p.boundaries[0].fix[0] = p.boundaries[0].fix[1] = false;
  auto          solver                            = solver_with(std::move(mesh), p);
  const Balance b0                                = solver->balance();
  const Books   worst                             = books_over(*solver, 300);
  EXPECT_LT(worst.energy, 1e-12 * b0.kinetic * 300);
  EXPECT_LT(worst.momentum, 1e-12 * b0.mass * 20);
  EXPECT_GT(solver->balance().friction_heat, 0);
  const Sample s = solver->sample(0);
  for (const auto &n : hanging)
  {
    Vec3 x;
    for (int i = 0; i < 3; ++i)
      x[i] = s.x[i][n.node];
    EXPECT_GT((x - p.walls[0].point).dot(p.walls[0].normal.normalized()), -1e-15);
    if (s.x0[2][n.node] == 4 * h)
    {
      EXPECT_NEAR(s.v[2][n.node], 5, 1e-13);
    }
  }
}

TEST(Hanging, SpinningBlockKeepsItsAngularMomentum)
{
  auto mesh = graded_box<3>(false, .15 * h);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const Vec3 v = Vec3(2e4, -3e4, 1e4).cross(Vec3(mesh.x[0][a], mesh.x[1][a], mesh.x[2][a]));
    for (int i = 0; i < 3; ++i)
      mesh.v[i][a] = v[i];
  }
  auto      solver = solver_with(std::move(mesh));
  Driver<3> driver{*solver};
  ASSERT_TRUE(driver.once().ok);
  const Vec3 L0 = solver->balance().angular_momentum;
  for (int k = 0; k < 1000; ++k)
    ASSERT_TRUE(driver.once().ok);
  EXPECT_NEAR((solver->balance().angular_momentum - L0).norm() / L0.norm(), 0, 1e-12);
}

// Noise without any damping at .9 of the elements' bound: the energy stays what
// it was, which a frequency above the bound would not let it.
template <int dim>
void expect_bounded(int steps)
{
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  auto          solver                             = solver_with(graded_box<dim>(false, .15 * h, 1e-3), p);
  const Balance b0                                 = solver->balance();
  Driver<dim>   driver{*solver};
  for (int k = 0; k < steps; ++k)
    ASSERT_TRUE(driver.once().ok);
  const Balance b = solver->balance();
  EXPECT_LT(b.kinetic + b.elastic + b.hourglass_fem, 1.02 * b0.kinetic);
  EXPECT_GT(b.kinetic + b.elastic + b.hourglass_fem, .5 * b0.kinetic);
}
TEST(Hanging, NoiseStaysBoundedPlaneStrain)
{
  expect_bounded<2>(20000);
}
TEST(Hanging, NoiseStaysBoundedHex)
{
  expect_bounded<3>(5000);
}
} // namespace
