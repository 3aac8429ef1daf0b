// SPDX-License-Identifier: LGPL-2.1-or-later
// The matrix is the product of the axes of each case, less what the study leaves
// out; all counts by hand.
#include "tests/unit/chart/example.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::chart;
using namespace ogive::chart::test;
using Names = std::vector<std::string>;

namespace
{
Names texts(const Row &row)
{
  Names t;
  for (const Override &o : row.overrides)
    t.push_back(o.text());
  return t;
}
} // namespace

TEST(Rows, AreTheProductOfTheAxesThatACaseUses)
{
  const Matrix m = expand(two_cases());
  EXPECT_EQ(row_names(m), (Names{"bar+fem+0.5", "bar+fem+1", "bar+fem+2.5", "bar+sph+0.5", "bar+sph+1", "bar+sph+2.5",
                                 "rod+0.5", "rod+1", "rod+2.5"}));
  EXPECT_EQ(m.skipped, 0u);
  EXPECT_EQ(texts(m.rows[4]), (Names{"Bodies/bar/method=sph", "SPH/alpha=1"}));
  EXPECT_EQ(texts(m.rows[8]), (Names{"SPH/alpha=2.5"}));
}

TEST(Rows, OnlyWithAndExceptWithLeaveCombinationsOut)
{
  Study s = two_cases();
  // fem knows no alpha: one of its three is enough
  s.axes[1].levels[0].except_with = parse_condition("method=fem", s, {});
  s.axes[1].levels[2].only_with   = parse_condition("method=sph, case=bar", s, {});
  const Matrix m                  = expand(s);
  // rod uses no method: it matches no exception and is not asked by only with,
  // but it is not the case bar
  EXPECT_EQ(row_names(m), (Names{"bar+fem+1", "bar+sph+0.5", "bar+sph+1", "bar+sph+2.5", "rod+0.5", "rod+1"}));
  EXPECT_EQ(m.skipped, 3u);
}

TEST(Rows, TheMostParticularOverrideWins)
{
  Study s                               = two_cases();
  s.overrides.items                     = parse_overrides("end time=1 s; SPH/beta=3", {});
  s.cases[0].overrides.items            = parse_overrides("end time=2 s", {});
  s.axes[1].levels[0].overrides.items   = parse_overrides("SPH/alpha=.51", {});
  s.cases[0].axes[1].at["2.5"]          = {"", parse_overrides("SPH/alpha=2.6", {})};
  const Matrix m                        = expand(s);
  EXPECT_EQ(texts(m.rows[0]), (Names{"SPH/beta=3", "end time=2 s", "Bodies/bar/method=fem", "SPH/alpha=.51"}));
  EXPECT_EQ(texts(m.rows[1]), (Names{"SPH/beta=3", "end time=2 s", "Bodies/bar/method=fem", "SPH/alpha=1"}));
  EXPECT_EQ(texts(m.rows[2]), (Names{"SPH/beta=3", "end time=2 s", "Bodies/bar/method=fem", "SPH/alpha=2.6"}));

  s.cases[0].axes[1].overrides.items = parse_overrides("SPH/alpha={}; SPH/h over dx=1.{}", {});
  EXPECT_EQ(texts(expand(s).rows[1]).back(), "SPH/h over dx=1.1");
}

TEST(Rows, ALevelLikeAnotherFollowsItInEveryCase)
{
  Study s                        = two_cases();
  s.cases[0].axes[0].at["fem"]   = {"", parse_overrides("Bodies/bar/method=fem; end time=2 s", {})};
  Level &bare                    = s.axes[0].levels.emplace_back();
  bare.name = bare.title = "bare";
  bare.like                      = "fem";
  bare.overrides.items           = parse_overrides("FEM/hourglass coefficient=0; end time=3 s", {});
  const Matrix m                 = expand(s);
  EXPECT_EQ(m.rows[6].name, "bar+bare+0.5");
  EXPECT_EQ(texts(m.rows[6]),
            (Names{"Bodies/bar/method=fem", "FEM/hourglass coefficient=0", "end time=3 s", "SPH/alpha=0.5"}));

  // what does not apply to the one does not to the other, unless the case says what to set
  s.cases[0].axes[0].without_meaning["fem"] = "no mesh";
  EXPECT_EQ(row_names(expand(s)), (Names{"bar+sph+0.5", "bar+sph+1", "bar+sph+2.5", "rod+0.5", "rod+1", "rod+2.5"}));
  s.cases[0].axes[0].at["bare"] = {"", parse_overrides("Bodies/bar/method=fem", {})};
  EXPECT_EQ(expand(s).rows.size(), 9u);
}

TEST(Rows, TwoAxesMayNotSetOneEntry)
{
  Study s                             = two_cases();
  s.axes[0].levels[1].overrides.items = parse_overrides("SPH/alpha=7", {"study.prm", 12, "Axes/method/sph/overrides"});
  try
  {
    expand(s);
    FAIL() << "nothing was thrown";
  }
  catch (const InputError &e)
  {
    EXPECT_NE(std::string(e.what()).find("SPH/alpha"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("bar+sph+0.5"), std::string::npos) << e.what();
  }
}

TEST(Rows, ACaseWithoutVariantsIsRefused)
{
  Study s = two_cases();
  for (Level &l : s.axes[1].levels)
    l.only_with = parse_condition("case=bar", s, {});
  EXPECT_THROW(expand(s), InputError);
}

TEST(Rows, ACaseMayUseSomeLevels)
{
  Study s                   = two_cases();
  s.cases[0].axes[1].levels = {"2.5"};
  s.cases[1].axes.clear();
  EXPECT_EQ(row_names(expand(s)), (Names{"bar+fem+2.5", "bar+sph+2.5", "rod"}));
}
