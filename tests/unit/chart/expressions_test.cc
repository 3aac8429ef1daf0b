// SPDX-License-Identifier: LGPL-2.1-or-later
// What stands inside a study's entries, and what is said of slips in it.
#include "tests/unit/chart/example.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::chart;
using namespace ogive::chart::test;

namespace
{
template <class Action>
std::string complaint(const Action &action)
{
  try
  {
    action();
  }
  catch (const InputError &e)
  {
    return e.what();
  }
  return "nothing was thrown";
}

bool bar_sph(const std::string &condition)
{
  const Study s = two_cases();
  return holds(
    parse_condition(condition, s, {}),
    [](const std::string &axis) { return axis == "case" ? "bar" : axis == "method" ? "sph" : ""; }, false);
}
} // namespace

TEST(Expressions, ConditionsHoldAsWritten)
{
  EXPECT_TRUE(bar_sph(""));
  EXPECT_TRUE(bar_sph("method=sph"));
  EXPECT_FALSE(bar_sph("method=fem"));
  EXPECT_TRUE(bar_sph("method=fem|sph, case=bar"));
  EXPECT_FALSE(bar_sph("method=sph, case=rod"));
  EXPECT_TRUE(bar_sph("method=fem; case=bar"));
  EXPECT_FALSE(bar_sph("alpha=1")); // an axis that is not used
}

TEST(Expressions, SlipsAreNamedWithTheNearestName)
{
  const Study s = two_cases();
  for (const auto &[text, hint] :
       {std::pair{"methd=sph", "\"method\""}, {"method=shp", "\"sph\""}, {"case=baar", "\"bar\""}, {"method", "AXIS=LEVEL"}})
  {
    const std::string said = complaint([&, t = text] { parse_condition(t, s, {"s.prm", 7, "x"}); });
    EXPECT_EQ(said.find("s.prm:7"), 0u) << said;
    EXPECT_NE(said.find(hint), std::string::npos) << said;
  }
  EXPECT_NE(complaint([&] { parse_overrides("SPH/alpha", {}); }).find("not an override"), std::string::npos);
  EXPECT_NE(complaint([&] { parse_overrides("a=1; a=2", {}); }).find("set twice"), std::string::npos);
  EXPECT_NE(complaint([&] { parse_measure("eror of tip", s, {}); }).find("\"error\""), std::string::npos);
  EXPECT_NE(complaint([&] { parse_measure("axis alhpa", s, {}); }).find("\"alpha\""), std::string::npos);
  EXPECT_NE(complaint([&] { parse_measure("spread of tip over alhpa", s, {}); }).find("\"alpha\""), std::string::npos);
}

TEST(Expressions, OverridesKeepTheirValues)
{
  const auto o = parse_overrides("Bodies/b/velocity=0, 0, -3 m/s ; end time = 2 us", {});
  ASSERT_EQ(o.size(), 2u);
  EXPECT_EQ(o[0].text(), "Bodies/b/velocity=0, 0, -3 m/s");
  EXPECT_EQ(o[1].text(), "end time=2 us");
}

TEST(Expressions, MeasuresAreTold)
{
  const Study   s = two_cases();
  const Measure m = parse_measure("spread of tip over alpha", s, {});
  EXPECT_EQ(m.kind, Measure::Kind::spread);
  EXPECT_EQ(m.name, "tip");
  EXPECT_EQ(m.over, "alpha");
  EXPECT_EQ(parse_measure("core seconds", s, {}).kind, Measure::Kind::core_seconds);
  EXPECT_EQ(parse_measure("size of energy_drift", s, {}).kind, Measure::Kind::size);
}
