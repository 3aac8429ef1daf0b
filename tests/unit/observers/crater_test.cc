// SPDX-License-Identifier: LGPL-2.1-or-later
// Craters and debris clouds made by hand.
#include "tests/unit/observers/synthetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ogive::coupling
{
namespace
{
using namespace synthetic;

void put(Sample &s, const Vec3 &x, const Vec3 &x0, double speed)
{
  for (int a = 0; a < 3; ++a)
  {
    s.x[a].push_back(x[a]);
    s.x0[a].push_back(x0[a]);
    s.v[a].push_back(a == 0 ? speed : 0.);
  }
  s.mass.push_back(1);
  s.radius.push_back(.05);
}

/// A plate of 1 m across x (direction), points on rings about x of radius 2 (and
/// of 3, farther out), all at rest.
Sample plate()
{
  Sample s;
  for (const double r : {2., 3.})
    for (int k = 0; k < 64; ++k)
    {
      const double t = 2 * std::numbers::pi * (k + .5) / 64;
      for (const double x : {-.45, .45})
        put(s, {x, r * std::cos(t), r * std::sin(t)}, {x, r * std::cos(t), r * std::sin(t)}, 0);
    }
  return s;
}
} // namespace

// The hole reaches to half a cell within the inner ring: 2 (2 - .05).
TEST(CraterDiameter, IsThatOfTheHole)
{
  const auto o = observer("crater_diameter", scene("linear", "elastic"), 10);
  Sample     s = plate();
  EXPECT_NEAR(seen(*o, 1, s), 3.9, 1e-12);
  put(s, {0, .1, 0}, {0, .1, 0}, 20); // a fast one in the hole is debris
  put(s, {5, .1, 0}, {0, .1, 0}, 0);  // so is one that has left the plate
  EXPECT_NEAR(seen(*o, 1, s), 3.9, 1e-12);
  put(s, {0, 1, 0}, {0, 1, 0}, 0); // one of 32 sectors begins at 1
  EXPECT_NEAR(seen(*o, 1, s), 2 * (31 * 1.95 + .95) / 32, 1e-12);
}

// 200 points, the foremost at 4 and the outermost at 1.5 from the axis, but for
// the last hundredth (two points), and what is slow or has not passed.
TEST(CloudShape, IsLengthOverWidth)
{
  const auto o = observer("cloud_shape", scene("linear", "elastic"), 10);
  Sample     s;
  EXPECT_TRUE(std::isnan(seen(*o, 1, s)));
  for (int k = 0; k < 198; ++k)
    put(s, {4. * (k + 1) / 198, 1.5 * (k + 1) / 198, 0}, Vec3::Zero(), 20);
  put(s, {9, 0, 0}, Vec3::Zero(), 20);
  put(s, {1, 7, 0}, Vec3::Zero(), 20);
  put(s, {20, 20, 0}, Vec3::Zero(), 5);
  put(s, {-1, 20, 0}, Vec3::Zero(), 20);
  EXPECT_NEAR(seen(*o, 1, s), 4 * (197. / 198) / (2 * 1.5 * 197. / 198), 1e-12);
}
} // namespace ogive::coupling
