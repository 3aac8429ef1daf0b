// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/patterns.h"
#include "core/input/suggest.h"

#include <gtest/gtest.h>

namespace ogive::input
{
namespace
{
TEST(Patterns, QuantityDescribesItself)
{
  EXPECT_EQ(QuantityPattern(units::pressure, bounds::positive).description(), "a pressure > 0, such as \"340 MPa\"");
  EXPECT_EQ(QuantityPattern(units::none, Bound{-1, .5, true, true}).description(), "a number > -1 and < 0.5");
}

TEST(Patterns, QuantityChecksDimensionAndBound)
{
  const QuantityPattern p(units::pressure, bounds::positive);
  EXPECT_TRUE(p.match("340 MPa"));
  EXPECT_FALSE(p.match("340"));
  EXPECT_FALSE(p.match("340 m"));
  EXPECT_FALSE(p.match("0 Pa"));
  EXPECT_FALSE(p.match("-1 Pa"));
  EXPECT_FALSE(p.match("nan Pa"));
  EXPECT_EQ(p.complaint("340 m").wrong, "\"340 m\" has the wrong unit: it is a length");
  EXPECT_EQ(p.complaint("340 mpa").suggestion, "did you mean \"MPa\"?");
  EXPECT_TRUE(p.clone()->match("1 Pa"));
}

TEST(Patterns, VectorsTakeUnitsOnEachOrOnTheLast)
{
  EXPECT_EQ(parse_vector("0 m/s, 0 m/s, -303.5 m/s", units::velocity), Vec3(0, 0, -303.5));
  EXPECT_EQ(parse_vector("1, 2, -303.5 km/s", units::velocity), Vec3(1e3, 2e3, -303.5e3));
  EXPECT_EQ(parse_vector("80.1, -3 mm", units::length), Vec3(.0801, -.003, 0));
  EXPECT_EQ(parse_vector("1e-3, 2.5e-3mm", units::length), Vec3(1e-6, 2.5e-6, 0));
  EXPECT_EQ(parse_vector("0, 0, -1", units::none), Vec3(0, 0, -1));
  const VectorPattern p(units::velocity);
  EXPECT_FALSE(p.match("0, 0, 1"));
  EXPECT_FALSE(p.match("0 m/s, 0, 1 m/s"));
  EXPECT_FALSE(p.match("0 m, 0, 1 m/s"));
  EXPECT_FALSE(p.match("1, 2, 3, 4 m/s"));
  EXPECT_FALSE(p.match("1, , 3 m/s"));
  EXPECT_FALSE(VectorPattern(units::none, true).match("0, 0, 0"));
}

TEST(Patterns, NamesAreDistinctAndPlain)
{
  EXPECT_TRUE(NamesPattern().match("plate-rest, plate_2, a.b"));
  EXPECT_FALSE(NamesPattern().match("plate, plate"));
  EXPECT_FALSE(NamesPattern().match("plate,"));
  EXPECT_FALSE(NamesPattern().match("a/b"));
  EXPECT_FALSE(NamesPattern({}, 2).match("a"));
  EXPECT_EQ(NamesPattern({"x", "y"}).complaint("z").wrong, "\"z\" is not known here");
}

TEST(Patterns, RangesAndSources)
{
  EXPECT_EQ(parse_range("293 K .. 1800 K", units::temperature), std::pair(293., 1800.));
  EXPECT_FALSE(RangePattern(units::temperature).match("293 K"));
  EXPECT_FALSE(RangePattern(units::temperature).match("293 .. 1800 K"));
  EXPECT_FALSE(RangePattern(units::none).match("4 .. 0"));
  EXPECT_TRUE(SourcePattern().match("test: Johnson and Cook 1983"));
  EXPECT_FALSE(SourcePattern().match("Johnson and Cook 1983"));
  EXPECT_FALSE(SourcePattern().match("rumour: heard of it"));
}

TEST(Suggest, FindsTheSlipAndNothingElse)
{
  const std::vector<std::string> known{"velocity", "velocity field", "spacing", "shape"};
  EXPECT_EQ(nearest("velosity", known), "velocity");
  EXPECT_EQ(nearest("spaicng", known), "spacing");
  EXPECT_EQ(nearest("Shape", known), "shape");
  EXPECT_EQ(nearest("viscosity of fluid", known), "");
  EXPECT_EQ(edit_distance("plate", "palte"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}
} // namespace
} // namespace ogive::input
