// SPDX-License-Identifier: LGPL-2.1-or-later
// Generated meshes: volumes against the exact shapes, faces complete and
// outward, symmetric parts.
#include "core/base/error.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
input::Body round(input::ShapeKind kind, double radius, double inner, double length, double spacing)
{
  input::Body b        = box(Vec3::Zero(), Vec3::Zero(), spacing);
  b.shape.kind         = kind;
  b.shape.radius       = radius;
  b.shape.inner_radius = inner;
  b.shape.length       = length;
  return b;
}

template <int dim>
std::set<std::string> names(const BodyMesh<dim> &m)
{
  return {m.boundary_names.begin(), m.boundary_names.end()};
}

input::Scene scene(input::Dimension d, std::vector<int> planes = {})
{
  input::Scene s;
  s.dimension = d;
  for (const int axis : planes)
    s.symmetry.push_back({axis});
  return s;
}

/// Volume from the facets alone, (1/3) sum x.n A: exact if all are present and
/// outward (bilinear facets: mean normal at the mean point, which is second order).
double volume_by_facets(const BodyMesh<3> &m)
{
  double v = 0;
  for (const auto &f : m.facets)
  {
    Vec3 p[4], c = Vec3::Zero();
    for (int a = 0; a < 4; ++a)
    {
      p[a] = {m.x[0][f.node[a]], m.x[1][f.node[a]], m.x[2][f.node[a]]};
      c += p[a] / 4;
    }
    v += c.dot(.5 * (p[2] - p[0]).cross(p[3] - p[1])) / 3;
  }
  return v;
}

const auto metal = make(copper());

TEST(Mesh, CylinderVolumeConvergesAtSecondOrder)
{
  const double exact = M_PI * 9e-6 * .02;
  double       error[2];
  int          k = 0;
  for (const double h : {1e-3, .5e-3})
  {
    auto body         = round(input::ShapeKind::cylinder, 3e-3, 0, .02, h);
    body.shape.axis   = Vec3::UnitX();
    const auto m      = make_mesh<3>(body, scene(input::Dimension::three_d), 0, metal);
    error[k++]        = 1 - m.volume() / exact;
    EXPECT_EQ(names(m), (std::set<std::string>{"bottom", "top", "side"}));
    EXPECT_NEAR(volume_by_facets(m) / m.volume(), 1, 1e-12);
  }
  EXPECT_GT(error[0], 0); // inscribed
  EXPECT_LT(error[0], .03);
  EXPECT_NEAR(error[0] / error[1], 4, 1.2);
}

TEST(Mesh, NosesHaveTheirVolume)
{
  const double R = 4e-3, n = 6e-3, L = 12e-3;
  // Half ellipsoid 2/3, cone 1/3 of pi R^2 n; tangent ogive by quadrature of
  // pi y(z)^2 with y = sqrt(rho^2 - z^2) + R - rho, rho = (R^2 + n^2)/(2 R).
  const double rho  = (R * R + n * n) / (2 * R);
  double       nose = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double z = n * (i + .5) / 20000, y = std::sqrt(rho * rho - z * z) + R - rho;
    nose += M_PI * y * y * n / 20000;
  }
  const std::map<input::Nose, double> volume = {{input::Nose::hemispherical, M_PI * R * R * n * 2 / 3},
                                                {input::Nose::conical, M_PI * R * R * n / 3},
                                                {input::Nose::ogive, nose}};
  for (const auto &[kind, v] : volume)
  {
    auto body              = round(input::ShapeKind::cylinder, R, 0, L, .25e-3);
    body.shape.nose        = kind;
    body.shape.nose_length = n;
    body.shape.axis        = -Vec3::UnitY();
    const auto m           = make_mesh<2>(body, scene(input::Dimension::axisymmetric), 0, metal);
    EXPECT_NEAR(m.volume() / (M_PI * R * R * L + v), 1, .01) << static_cast<int>(kind);
  }
}

TEST(Mesh, QuarterAndOctantAreTheirShareOfTheWhole)
{
  const auto whole   = scene(input::Dimension::three_d);
  const auto quarter = scene(input::Dimension::three_d, {0, 1});
  const auto octant  = scene(input::Dimension::three_d, {0, 1, 2});
  auto       ring    = round(input::ShapeKind::ring, .02, .005, .004, .001);
  ring.spacing_far   = .003;
  const auto ring_q  = make_mesh<3>(ring, quarter, 0, metal);
  EXPECT_NEAR(4 * ring_q.volume() / make_mesh<3>(ring, whole, 0, metal).volume(), 1, 1e-12);
  EXPECT_EQ(names(ring_q),
            (std::set<std::string>{"bottom", "top", "inner", "outer", "symmetry-x", "symmetry-y"}));
  const auto ball   = round(input::ShapeKind::sphere, .01, 0, 0, .00125);
  const auto ball_o = make_mesh<3>(ball, octant, 0, metal), ball_w = make_mesh<3>(ball, whole, 0, metal);
  EXPECT_NEAR(8 * ball_o.volume() / ball_w.volume(), 1, 1e-12);
  EXPECT_NEAR(ball_w.volume() / (4. / 3 * M_PI * 1e-6), 1, .03);
  EXPECT_NEAR(volume_by_facets(ball_w) / ball_w.volume(), 1, 1e-9);
  EXPECT_EQ(names(ball_w), (std::set<std::string>{"outer"}));
  const auto shell = make_mesh<3>(round(input::ShapeKind::shell, .01, .008, 0, .001), whole, 0, metal);
  EXPECT_NEAR(shell.volume() / (4. / 3 * M_PI * (1e-6 - .512e-6)), 1, .03);
  EXPECT_EQ(names(shell), (std::set<std::string>{"inner", "outer"}));
}

TEST(Mesh, AxisymmetricSectionsAndPlaneSections)
{
  const auto rz = scene(input::Dimension::axisymmetric);
  EXPECT_NEAR(make_mesh<2>(round(input::ShapeKind::cylinder, 3e-3, 0, .02, .5e-3), rz, 0, metal).volume() /
                (M_PI * 9e-6 * .02),
              1, 1e-12); // straight: exact
  EXPECT_NEAR(make_mesh<2>(round(input::ShapeKind::sphere, .01, 0, 0, .5e-3), rz, 0, metal).volume() /
                (4. / 3 * M_PI * 1e-6),
              1, .005);
  const auto plane = scene(input::Dimension::plane_strain, {0});
  const auto ring  = make_mesh<2>(round(input::ShapeKind::ring, .04, .03, 0, .001), plane, 0, metal);
  EXPECT_NEAR(ring.volume() / (.5 * M_PI * (.0016 - .0009)), 1, .002);
  const auto disc = make_mesh<2>(round(input::ShapeKind::disc, .04, 0, 0, .002),
                                 scene(input::Dimension::plane_strain), 0, metal);
  EXPECT_NEAR(disc.volume() / (M_PI * .0016), 1, .005);
}

TEST(Mesh, GradedRingStartsFineAndEndsCoarse)
{
  auto body        = round(input::ShapeKind::ring, .25, .02, .012, .002);
  body.spacing_far = .02;
  const auto m     = make_mesh<2>(body, scene(input::Dimension::axisymmetric), 0, metal);
  std::set<double> r(m.x[0].begin(), m.x[0].end());
  EXPECT_NEAR(*std::next(r.begin()) - *r.begin(), .002, .0004);
  EXPECT_NEAR(*r.rbegin() - *std::next(r.rbegin()), .02, .004);
}

TEST(Mesh, WrongShapesAreNamed)
{
  EXPECT_THROW(make_mesh<1>(round(input::ShapeKind::sphere, 1, 0, 0, .1), scene(input::Dimension::uniaxial), 0, metal),
               InputError);
  EXPECT_THROW(make_mesh<2>(round(input::ShapeKind::sphere, 1, 0, 0, .1), scene(input::Dimension::plane_strain), 0, metal),
               InputError);
  auto away       = round(input::ShapeKind::sphere, 1, 0, 0, .25);
  away.shape.base = Vec3(.4, 0, 0);
  EXPECT_THROW(make_mesh<3>(away, scene(input::Dimension::three_d, {0}), 0, metal), InputError);
  auto file            = round(input::ShapeKind::mesh, 0, 0, 0, .1);
  file.shape.mesh_file = "no-such-mesh.msh";
  EXPECT_THROW(make_mesh<3>(file, scene(input::Dimension::three_d), 0, metal), InputError);
}
} // namespace
