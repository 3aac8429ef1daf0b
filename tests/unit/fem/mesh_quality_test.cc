// SPDX-License-Identifier: LGPL-2.1-or-later
// The figures of `ogive check` about meshes, on cells with closed forms.
#include "fem/mesh_quality.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
const auto metal = make(copper());

template <int dim>
BodyMesh<dim> block(const Vec3 &size, double spacing)
{
  input::Scene s;
  s.dimension = dim == 3 ? input::Dimension::three_d : input::Dimension::plane_strain;
  return make_mesh<dim>(box(Vec3::Zero(), size, spacing), s, 0, metal);
}
} // namespace

// A row of squares of edge h whose last is sheared by h/2 at the top: at that
// corner edges h and sqrt(5)/2 h with area h^2, Jacobian 2/sqrt 5 as at each
// corner of the parallelogram; aspect sqrt(5)/2.
TEST(MeshQuality, ShearedSquare)
{
  const double h    = 1e-3;
  auto         mesh = block<2>({4 * h, h, 0}, h);
  ASSERT_EQ(mesh.n_elements(), 4u);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.x[0][a] > 2.5 * h && mesh.x[1][a] > .5 * h)
      mesh.x[0][a] += .5 * h;
  const MeshQuality q = measure_quality(mesh, "row", {});
  EXPECT_NEAR(q.jacobian.value, 2 / std::sqrt(5.), 1e-12);
  EXPECT_NEAR(q.aspect.value, 1.5, 1e-12); // the cell before it: top edge 3/2 h
  EXPECT_NEAR(q.shortest, h, 1e-15);
  EXPECT_NEAR(q.longest, 1.5 * h, 1e-15);
  EXPECT_NEAR(q.jacobian.where[0], 3.25 * h + .5 * h, .6 * h);
  EXPECT_TRUE(q.warnings.empty());
  EXPECT_EQ(q.faces.at("y-"), 4u);
  EXPECT_EQ(q.faces.at("x+"), 1u);
}

// A unit cube with one corner drawn in to (s, s, s), s = 3/4. Its three edges are
// (s, s-1, s-1) and turns of it: length squared 3 s^2 - 4 s + 2 = .6875, triple
// product 3 s - 2 = .25. At its neighbours the Jacobian is s over that length.
TEST(MeshQuality, DentedBrick)
{
  auto mesh = block<3>({1, 1, 1}, 1);
  ASSERT_EQ(mesh.n_elements(), 1u);
  EXPECT_NEAR(measure_quality(mesh, "cube", {}).jacobian.value, 1, 1e-12);
  const double s = .75;
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.x[0][a] + mesh.x[1][a] + mesh.x[2][a] > 2.5)
      for (int i = 0; i < 3; ++i)
        mesh.x[i][a] = s;
  const MeshQuality q = measure_quality(mesh, "dented", {});
  EXPECT_NEAR(q.jacobian.value, .25 / std::pow(.6875, 1.5), 1e-12);
  EXPECT_NEAR(q.aspect.value, 1 / std::sqrt(.6875), 1e-12);
}

TEST(MeshQuality, FlatAndLongElementsAreWarnedOf)
{
  auto mesh = block<2>({24e-3, 1e-3, 0}, 1e-3);
  EXPECT_TRUE(measure_quality(mesh, "strip", {}).warnings.empty());
  auto longer = mesh;
  for (double &x : longer.x[0])
    x *= 11;
  EXPECT_EQ(measure_quality(longer, "strip", {}).warnings.size(), 1u);
  auto flat = mesh;
  for (std::size_t a = 0; a < flat.n_nodes(); ++a) // tops pushed aside by six edges
    flat.x[0][a] += 6 * flat.x[1][a];
  EXPECT_EQ(measure_quality(flat, "strip", {}).warnings.size(), 1u); // 1/sqrt 37 = .164
}

// A bar in steps: nine elements of edge h, then one of h/4. The least bound is
// that of the thin one alone; the bound of each kind is the solver's for a mesh
// of such elements only.
TEST(MeshQuality, StepsByElement)
{
  const double h    = 1e-3;
  auto         mesh = block<3>({10 * h, h, h}, h);
  ASSERT_EQ(mesh.n_elements(), 10u);
  for (double &x : mesh.x[0])
    if (x > 9.5 * h)
      x = 9.25 * h;
  const MeshQuality q = measure_quality(mesh, "bar", {});
  const auto        bound = [](BodyMesh<3> m) {
    Parameters p;
    p.options.step_factor = 1;
    return solver_of(std::move(m), p)->stable_dt().dt;
  };
  EXPECT_NEAR(q.step.value / bound(mesh), 1, 1e-12);
  EXPECT_NEAR(q.step_median / bound(block<3>({3 * h, h, h}, h)), 1, 1e-9);
  EXPECT_DOUBLE_EQ(q.step_twentieth, q.step.value);
  EXPECT_NEAR(q.step.where[0], 9.125 * h, 1e-9);
  // the bound falls with the shortest edge, about as 1/4 here
  EXPECT_GT(q.step_median, 2 * q.step.value);
  EXPECT_DOUBLE_EQ(q.share_near, .1);
}

// Each formulation has its own bounds; the least of them is the solver's.
TEST(MeshQuality, LeastStepIsTheSolversForEachFormulation)
{
  const std::pair<const char *, int> elements[] = {{"one-point", 1}, {"b-bar", 1}, {"full", 1}, {"spectral", 2}};
  for (const auto &[element, degree] : elements)
  {
    auto       mesh = wild_block<3>(metal, false, 0, .2, element, degree);
    Parameters p;
    p.options.step_factor = 1;
    const MeshQuality q   = measure_quality(mesh, "wild", p.options);
    EXPECT_NEAR(q.step.value / solver_of(std::move(mesh), p)->stable_dt().dt, 1, 1e-12) << element;
    EXPECT_EQ(q.elements, 4u * 5 * 3) << element;
    EXPECT_LT(q.jacobian.value, 1) << element;
  }
}
