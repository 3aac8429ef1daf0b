// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_geometry.h"

#include "hand_made.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::coupling
{
namespace
{
using Corners = std::array<Point<3>, 4>;

Point<3> random_point(std::mt19937 &random, double range)
{
  std::uniform_real_distribution<double> u(-range, range);
  return {u(random), u(random), u(random)};
}

Corners warped_quad(std::mt19937 &random)
{
  Corners c{Point<3>(-1, -1, 0), Point<3>(1, -1, 0), Point<3>(1, 1, 0), Point<3>(-1, 1, 0)};
  for (auto &p : c)
    p = hand_made::tilt<3>() * (.013 * (p + random_point(random, .3)));
  return c;
}
} // namespace

// Oracle: the least distance over a fine set of points of the four triangles.
TEST(Foot, IsTheNearestPointOfAWarpedQuad)
{
  std::mt19937 random(11);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Corners  c        = warped_quad(random);
    const Point<3> centroid = .25 * (c[0] + c[1] + c[2] + c[3]);
    const Point<3> p        = random_point(random, .03);
    const auto     foot     = foot_on_facet<3>(p, c, 1);
    double         least    = 1e9;
    constexpr int  n        = 60;
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
        {
          const double   wi = double(i) / n, wj = double(j) / n;
          const Point<3> q = wi * c[k] + wj * c[(k + 1) % 4] + (1 - wi - wj) * centroid;
          least            = std::min(least, (p - q).norm());
        }
    const double distance = std::sqrt(foot.distance2);
    EXPECT_LE(distance, least * (1 + 1e-12));
    EXPECT_GE(distance, least - .026 / n); // no farther off than the samples are apart
  }
}

TEST(Foot, WeightsSumToOneAndGiveTheFoot)
{
  std::mt19937 random(12);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const Corners c    = warped_quad(random);
    const auto    foot = foot_on_facet<3>(random_point(random, .03), c, 1);
    double        sum  = 0;
    Point<3>      q    = Point<3>::Zero();
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_GE(foot.weight[k], -1e-14);
      sum += foot.weight[k];
      q += foot.weight[k] * c[k];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LE((q - foot.where).norm(), 1e-14 * .02);
  }
}

// The signed distance of a box is known everywhere, edges and corners included.
TEST(Foot, SignedDistanceToABoxFromItsFacets)
{
  const Point<3>       half(.7, .4, .9);
  hand_made::Arrays<3> mesh;
  hand_made::add_box(mesh, half, 3, 1., 0);
  std::mt19937 random(13);
  for (int trial = 0; trial < 3000; ++trial)
  {
    const Point<3> p = random_point(random, 1.2);
    Stand<3>       stand;
    for (const auto &facet : mesh.facets)
    {
      Corners c;
      for (int k = 0; k < 4; ++k)
        c[k] = mesh.at(mesh.x, facet.node[k]);
      const auto foot = foot_on_facet<3>(p, c, 1);
      if (!stand.found || better_foot<3>(p, foot, stand.foot))
        stand.foot = foot;
      stand.found = true;
    }
    finish_stand<3>(p, .1, stand);
    const Point<3> beyond   = p.cwiseAbs() - half;
    const double   expected = beyond.cwiseMax(0.).norm() + std::min(0., beyond.maxCoeff());
    EXPECT_NEAR(stand.distance, expected, 1e-13) << p.transpose();
    // The direction is the gradient of the distance: one step along it shows.
    EXPECT_NEAR(stand.direction.norm(), 1, 1e-12);
    EXPECT_LE((p - stand.distance * stand.direction - stand.foot.where).norm(), 1e-12);
  }
}

TEST(Foot, OutsideOfASegmentIsOnItsRight)
{
  // From (0,0) to (0,2): right of the way is +x.
  const std::array<Point<2>, 2> corner{Point<2>(0, 0), Point<2>(0, 2)};
  Stand<2>                      stand;
  stand.foot = foot_on_facet<2>({.25, .5}, corner, 1);
  finish_stand<2>({.25, .5}, 1, stand);
  EXPECT_DOUBLE_EQ(stand.distance, .25);
  EXPECT_DOUBLE_EQ(stand.foot.weight[1], .25);
  stand.foot = foot_on_facet<2>({-.5, 2.5}, corner, 1); // past the end, behind
  finish_stand<2>({-.5, 2.5}, 1, stand);
  EXPECT_DOUBLE_EQ(stand.distance, -std::sqrt(.5));
}

TEST(Foot, CollapsedFacetsHaveANearestPointStill)
{
  const Point<3> a(1, 2, 3), b(1.5, 2, 3);
  const auto     line = foot_on_facet<3>({1.25, 2.5, 3}, {a, a, b, b}, 1);
  EXPECT_NEAR(std::sqrt(line.distance2), .5, 1e-14);
  const auto dot = foot_on_facet<3>({1, 2, 4}, {a, a, a, a}, 1);
  EXPECT_NEAR(std::sqrt(dot.distance2), 1, 1e-14);
}
} // namespace ogive::coupling
