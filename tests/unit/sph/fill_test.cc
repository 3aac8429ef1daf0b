// SPDX-License-Identifier: LGPL-2.1-or-later
// Masses against closed-form volumes; lattices against their definition.
#include "core/base/error.h"
#include "support.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;
using input::Nose;
using input::ShapeKind;

constexpr double rho = 7830;

template <int dim>
BodyParticles<dim> filled(const input::Shape &shape, double spacing, const std::vector<input::SymmetryPlane> &planes = {})
{
  input::Scene scene;
  scene.symmetry = planes;
  input::Body body;
  body.name    = "b";
  body.shape   = shape;
  body.spacing = spacing;
  return fill<dim>(body, scene, 3, material(rho, 160e9, 80e9));
}

template <int dim>
double mass(const BodyParticles<dim> &p)
{
  return std::accumulate(p.mass.begin(), p.mass.end(), 0.);
}

TEST(Fill, BoxIsFilledExactly)
{
  input::Shape s;
  s.lower      = Vec3(-.013, .002, -.004);
  s.upper      = Vec3(.013, .0093, .0071);
  const auto p = filled<3>(s, 1e-3, {{0}});
  EXPECT_EQ(p.x.size(), 13u * 7 * 11);
  EXPECT_NEAR(mass(p), rho * .013 * .0073 * .0111, 1e-12 * mass(p));
  EXPECT_EQ(p.body, 3);
  double least = 1;
  for (const auto &x : p.x)
    least = std::min(least, x[0]);
  EXPECT_NEAR(least, .5e-3, 1e-15); // the plane lies half way between two layers
}

TEST(Fill, RoundBodiesHaveTheirExactMass)
{
  const double pi = M_PI, r = .0071, l = .0163;
  input::Shape s;
  s.kind   = ShapeKind::cylinder;
  s.base   = Vec3(0, 0, .002);
  s.axis   = Vec3::UnitZ();
  s.radius = r;
  s.length = l;
  EXPECT_NEAR(mass(filled<3>(s, 6e-4)), rho * pi * r * r * l, 1e-12);
  EXPECT_NEAR(mass(filled<3>(s, 6e-4, {{0}, {1}})), rho * pi * r * r * l / 4, 1e-12);
  s.nose        = Nose::conical;
  s.nose_length = .01;
  EXPECT_NEAR(mass(filled<3>(s, 6e-4)), rho * pi * r * r * (l + .01 / 3), 1e-12);
  s.nose        = Nose::hemispherical;
  s.nose_length = r;
  EXPECT_NEAR(mass(filled<3>(s, 6e-4)), rho * pi * r * r * (l + 2 * r / 3), 1e-12);
  s.nose        = Nose::ogive;
  s.nose_length = 3 * r;
  {
    // Tangent ogive: with R = (r^2 + n^2)/(2r), V = pi (n R^2 - n^3/3 - (R - r) R^2 asin(n/R)).
    const double n = 3 * r, big = (r * r + n * n) / (2 * r);
    const double v = pi * (n * big * big - n * n * n / 3 - (big - r) * big * big * std::asin(n / big));
    EXPECT_NEAR(mass(filled<3>(s, 6e-4)), rho * (pi * r * r * l + v), 1e-10);
  }
  input::Shape ring;
  ring.kind         = ShapeKind::ring;
  ring.radius       = .04;
  ring.inner_radius = .03;
  ring.length       = .01;
  EXPECT_NEAR(mass(filled<2>(ring, 1e-3)), rho * pi * (.0016 - .0009), 1e-10);
  EXPECT_NEAR(mass(filled<3>(ring, 2e-3, {{0}})), .5 * rho * pi * (.0016 - .0009) * .01, 1e-10);
  input::Shape shell = ring;
  shell.kind         = ShapeKind::shell;
  EXPECT_NEAR(mass(filled<3>(shell, 2.5e-3, {{0}, {1}, {2}})), rho * pi / 6 * (6.4e-5 - 2.7e-5), 1e-10);
}

TEST(Fill, LatticeStaysInsideAndKeepsItsDistance)
{
  input::Shape s;
  s.kind       = ShapeKind::disc;
  s.base       = Vec3(.01, -.02, .005);
  s.axis       = Vec3(1, 1, 0).normalized();
  s.radius     = .006;
  s.length     = .004;
  const auto p = filled<3>(s, 5e-4);
  EXPECT_NEAR(p.x.size() * std::pow(p.spacing, 3), M_PI * .006 * .006 * .004, .02 * M_PI * .006 * .006 * .004);
  for (const auto &x : p.x)
  {
    const Vec3   d(x[0] - s.base[0], x[1] - s.base[1], x[2] - s.base[2]);
    const double along = d.dot(s.axis);
    EXPECT_GT(along, 0);
    EXPECT_LT(along, .004);
    EXPECT_LT((d - along * s.axis).norm(), .006);
  }
}

TEST(Fill, SpinKeepsTheCentreStill)
{
  input::Scene scene;
  input::Body  body;
  body.name        = "b";
  body.shape.lower = Vec3(1, 2, 3);
  body.shape.upper = Vec3(1.3, 2.2, 3.1);
  body.spacing     = .02;
  body.velocity    = Vec3(5, -7, 11);
  body.spin        = Vec3(20, 30, -40);
  const auto p     = fill<3>(body, scene, 0, copper());
  Vec3       mean  = Vec3::Zero();
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    const Vec3 v = Eigen::Map<const Vec3>(p.v[i].data());
    const Vec3 d = Eigen::Map<const Vec3>(p.x[i].data()) - Vec3(1.15, 2.1, 3.05);
    mean += v / p.x.size();
    const Vec3 w = body.spin;
    const Vec3 expected(w[1] * d[2] - w[2] * d[1], w[2] * d[0] - w[0] * d[2], w[0] * d[1] - w[1] * d[0]);
    EXPECT_LT((v - body.velocity - expected).norm(), 1e-12 * w.norm());
  }
  EXPECT_LT((mean - body.velocity).norm(), 1e-11);
}

TEST(Fill, JitterIsBoundedAndTheSameInEveryRun)
{
  input::Scene scene;
  input::Body  body;
  body.name        = "b";
  body.shape.upper = Vec3(.01, .02, .005);
  body.spacing     = 1e-3;
  const auto even  = fill<3>(body, scene, 0, copper());
  body.jitter      = .3;
  const auto once = fill<3>(body, scene, 0, copper()), again = fill<3>(body, scene, 0, copper());
  EXPECT_EQ(once.x, again.x);
  EXPECT_EQ(once.mass, even.mass);
  double most = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < even.x.size(); ++i)
    for (int a = 0; a < 3; ++a)
    {
      const double shift = (once.x[i][a] - even.x[i][a]) / body.spacing;
      most               = std::max(most, std::abs(shift));
      mean += shift / (3 * even.x.size());
      square += shift * shift / (3 * even.x.size());
    }
  EXPECT_LE(most, .3);
  // 3000 numbers spread evenly over +-.3: a mean square of .03, within four of their
  // standard errors (.3/sqrt(3 3000) and .09 sqrt(4/45/3000))
  EXPECT_NEAR(mean, 0, 4 * .3 / std::sqrt(9000.));
  EXPECT_NEAR(square, .03, 4 * .09 * std::sqrt(4. / 45 / 3000));
}

/// A section of rings fits its radius and its bore whatever the spacing, and its
/// cells know their sides.
TEST(Fill, SectionsFitTheirWall)
{
  input::Scene scene;
  scene.dimension = input::Dimension::axisymmetric;
  input::Body body;
  body.name         = "tube";
  body.spacing      = 1e-3;
  body.shape.kind   = input::ShapeKind::ring;
  body.shape.axis   = Vec3::UnitY();
  body.shape.radius = 5.3e-3;
  body.shape.length = 4.6e-3;
  for (const double bore : {0., 2.7e-3})
  {
    body.shape.inner_radius = bore;
    body.shape.kind         = bore > 0 ? input::ShapeKind::ring : input::ShapeKind::cylinder;
    const auto p = fill<2>(body, scene, 0, copper());
    double     least = 1, most = 0, total = 0;
    for (std::size_t i = 0; i < p.x.size(); ++i)
    {
      least = std::min(least, p.x[i][0]);
      most  = std::max(most, p.x[i][0]);
      total += p.mass[i];
    }
    EXPECT_NEAR(most + .5 * p.cell[0], 5.3e-3, 1e-15);
    EXPECT_NEAR(least - .5 * p.cell[0], bore, 1e-15);
    EXPECT_NEAR(p.cell[1], 4.6e-3 / 5, 1e-15);
    EXPECT_NEAR(total / (8930 * M_PI * (5.3e-3 * 5.3e-3 - bore * bore) * 4.6e-3), 1, 1e-12);
  }
}

TEST(Fill, RefusesWhatItCannotHold)
{
  input::Shape s;
  s.kind   = ShapeKind::sphere;
  s.radius = .01;
  EXPECT_THROW(filled<1>(s, 1e-3), InputError);
  s.base = Vec3(.004, 0, 0);
  EXPECT_THROW(filled<3>(s, 1e-3, {{0}}), InputError); // plane off the centre
  s.base = Vec3::Zero();
  EXPECT_THROW(filled<3>(s, 0), InputError);
  EXPECT_THROW(filled<3>(s, 1), InputError);
  s.kind = ShapeKind::mesh;
  EXPECT_THROW(filled<3>(s, 1e-3), InputError);
}

/// Contact points: two layers at free faces, none at a symmetry plane.
TEST(Surface, TwoLayersOfABox)
{
  const double dx = 1e-3;
  Parameters   q;
  q.symmetry = {{0}};
  Solver<3>   solver(q, {box<3>(Vec3::Zero(), Vec3(9, 10, 11) * dx, dx, copper(), 0, 1, q.symmetry)});
  const auto  s = solver.surface();
  std::size_t expected = 0;
  for (std::size_t i = 0; i < s.n; ++i)
  {
    const double depth =
      std::min({9 * dx - s.x[0][i], s.x[1][i], 10 * dx - s.x[1][i], s.x[2][i], 11 * dx - s.x[2][i]});
    expected += depth < 2 * dx;
  }
  EXPECT_EQ(s.contact_points.size(), expected);
  EXPECT_NEAR(s.radius[0], .5 * dx, 1e-15);
  for (const auto i : s.contact_points)
    EXPECT_TRUE(std::min({9 * dx - s.x[0][i], s.x[1][i], 10 * dx - s.x[1][i], s.x[2][i], 11 * dx - s.x[2][i]}) <
                2 * dx);
}
} // namespace
