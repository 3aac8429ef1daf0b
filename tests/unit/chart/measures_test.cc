// SPDX-License-Identifier: LGPL-2.1-or-later
// Spreads, errors, verdicts and charts from outcomes written by hand.
#include "apps/chart/map.h"
#include "apps/chart/pictures.h"
#include "tests/unit/chart/example.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::chart;
using namespace ogive::chart::test;

namespace
{
/// Nine rows: tip = 20 mm + row mm against a reference of 25 mm.
struct Example
{
  Example()
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      Outcome o;
      o.status    = Status::done;
      o.core_s    = 2. * static_cast<double>(i + 1);
      o.steps     = 100;
      o.particles = 30;
      o.elements  = 4;
      o.quantities.push_back({"tip", "m", "exact", .020 + .001 * static_cast<double>(i), .025});
      o.checks.push_back({"energy_drift", -1e-3});
      outcomes.push_back(o);
    }
  }
  Results results() const { return {study, rows, outcomes}; }

  Study                study = two_cases();
  std::vector<Row>     rows  = expand(study).rows;
  std::vector<Outcome> outcomes;
};

ChartSpec spec(const Study &s, const std::string &x, const std::string &y)
{
  ChartSpec c;
  c.x      = parse_measure(x, s, {});
  c.y      = parse_measure(y, s, {});
  c.series = {"method"};
  return c;
}
} // namespace

TEST(Measures, SpreadIsGreatestLessLeast)
{
  Example    e;
  const auto groups = groups_along(e.results(), rows_of(e.results(), "bar"), "alpha");
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[1], (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_NEAR(*spread_of(e.results(), groups[1], "tip").value(), .002, 1e-15);
  EXPECT_EQ(groups_along(e.results(), rows_of(e.results(), "bar"), "method").size(), 3u);

  // one row alone spreads nothing, which must not pass for insensitivity
  EXPECT_FALSE(spread_of(e.results(), std::vector<std::size_t>{3}, "tip").value());
  // a group that lacks a row has no spread: it would look too good
  e.outcomes[4].status = Status::failed;
  const Spread s       = spread_of(e.results(), groups[1], "tip");
  EXPECT_FALSE(s.value());
  EXPECT_EQ(s.with_value, 2u);
}

TEST(Measures, EachGivesItsNumber)
{
  const Example e;
  const Results r   = e.results();
  const auto    get = [&](const char *m) { return *measure(r, 5, parse_measure(m, e.study, {})); };
  EXPECT_EQ(get("axis alpha"), 2.5);
  EXPECT_EQ(get("core seconds"), 12);
  EXPECT_EQ(get("work"), 3400); // 100 steps of 34
  EXPECT_NEAR(get("value of tip"), .025, 1e-15);
  EXPECT_EQ(get("size of energy_drift"), 1e-3);
  EXPECT_NEAR(*measure(r, 0, parse_measure("error of tip", e.study, {})), .2, 1e-12);
}

TEST(Measures, TheCasesOwnReferenceGoesFirst)
{
  Example e;
  e.study.cases[0].quantities[0].reference = .040;
  EXPECT_NEAR(*error_of(e.study.cases[0], e.outcomes[0], "tip"), -.5, 1e-12);
  EXPECT_NEAR(*error_of(e.study.cases[1], e.outcomes[0], "tip"), -.2, 1e-12);
  EXPECT_FALSE(error_of(e.study.cases[0], e.outcomes[0], "energy_drift"));
}

TEST(Pictures, SeriesPointsAndLines)
{
  Example    e;
  const Plot plot = make_plot(e.results(), spec(e.study, "axis alpha", "value of tip"), "bar");
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[1].name, "sph");
  ASSERT_EQ(plot.series[1].points.size(), 3u);
  EXPECT_EQ(plot.series[1].points[0].x, .5);
  EXPECT_NEAR(plot.series[1].points[0].y, 23, 1e-12);
  EXPECT_EQ(plot.y_label, "tip (mm)");
  EXPECT_TRUE(plot.series[1].line);
  EXPECT_TRUE(plot.notes.empty());

  // points that differ in two things are not joined
  ChartSpec all = spec(e.study, "work", "value of tip");
  all.series    = {};
  EXPECT_FALSE(make_plot(e.results(), all, "bar").series.front().line);
}

TEST(Pictures, WhatIsNotShownIsNamed)
{
  Example e;
  e.outcomes[1].status                    = Status::failed;
  e.outcomes[2].quantities[0].value       = .025; // its error is 0
  ChartSpec c                             = spec(e.study, "core seconds", "error of tip");
  c.y_log                                 = true;
  const Plot plot                         = make_plot(e.results(), c, "bar");
  EXPECT_EQ(plot.series[0].points.size(), 1u);
  ASSERT_EQ(plot.notes.size(), 2u);
  EXPECT_EQ(plot.notes[0], "Not shown, failed: bar+fem+1");
  EXPECT_EQ(plot.notes[1], "Not shown, not positive on a logarithmic axis: bar+fem+2.5, bar+sph+2.5");
  const std::string svg = draw(plot);
  EXPECT_NE(svg.find("Not shown, failed: bar+fem+1"), std::string::npos);
}

TEST(Pictures, ASpreadCollapsesItsAxis)
{
  const Example e;
  ChartSpec     c = spec(e.study, "core seconds", "spread of tip over alpha");
  const Plot    p = make_plot(e.results(), c, "bar");
  ASSERT_EQ(p.series[1].points.size(), 1u);
  EXPECT_EQ(p.series[1].points[0].x, 10); // mean of 8, 10, 12
  EXPECT_NEAR(p.series[1].points[0].y, 2, 1e-12);
}

TEST(Maps, ABoundDecides)
{
  Example e;
  e.study.cases[0].quantities[0].at_most = .0235;
  e.outcomes[0].status                   = Status::failed;
  e.outcomes[0].reason                   = "the step fell";
  MapSpec m;
  m.cases   = {"bar", "rod"};
  m.columns = {"method", "alpha"};
  const SurvivalMap map = make_map(e.results(), m);
  using State           = SurvivalMap::State;
  // columns by level: the rod's, without a method, come first
  ASSERT_EQ(map.columns.size(), 9u);
  EXPECT_EQ(map.columns[3], (std::vector<std::string>{"fem", "alpha 0.5"}));
  EXPECT_EQ(map.columns[0].front(), "method as in the scene");
  EXPECT_EQ(map.lines[0].cells[0].state, State::left_out);
  EXPECT_EQ(map.lines[0].cells[3].why, "failed: the step fell");
  EXPECT_EQ(map.lines[0].cells[6].state, State::survived); // 23 mm
  EXPECT_EQ(map.lines[0].cells[7].state, State::failed);   // 24 mm
  EXPECT_EQ(map.lines[0].cells[7].metric, "24 mm");
  EXPECT_EQ(map.lines[1].cells[0].state, State::survived); // without a bound the end is enough

  m.columns                = {"method"};
  const auto        coarse = make_map(e.results(), m).lines[0].cells;
  EXPECT_EQ(coarse[2].state, State::failed);
  EXPECT_EQ(coarse[2].failed, 2u); // 24 and 25 of 23, 24, 25 mm
  EXPECT_NE(markdown(make_map(e.results(), m)).find("**failed 2 of 3**, 23 .. 25 mm"), std::string::npos);
}

TEST(Maps, WhatDoesNotApplyIsNeverSurvived)
{
  Example e;
  e.study.cases[0].axes[0].without_meaning["fem"] = "the bar is of particles";
  e.rows                                          = expand(e.study).rows;
  ASSERT_EQ(e.rows.size(), 6u); // bar+sph and rod, three each
  e.outcomes.resize(6);
  MapSpec m;
  m.cases               = {"bar"};
  m.columns             = {"method"};
  const SurvivalMap map = make_map(e.results(), m);
  // no row of this case has the level, so nothing else may put a column there
  ASSERT_EQ(map.lines[0].cells.size(), 1u);
  EXPECT_EQ(map.columns[0].front(), "sph");

  // another case keeps the column
  e.study.cases[1].axes.insert(e.study.cases[1].axes.begin(), {"method", {}, {}, {}, {}});
  e.rows = expand(e.study).rows;
  e.outcomes.resize(e.rows.size(), e.outcomes.front());
  m.cases              = {"bar", "rod"};
  const SurvivalMap both = make_map(e.results(), m);
  ASSERT_EQ(both.lines[0].cells.size(), 2u);
  EXPECT_EQ(both.lines[0].cells[0].state, SurvivalMap::State::without_meaning);
  EXPECT_EQ(both.lines[0].cells[1].state, SurvivalMap::State::survived);
  EXPECT_EQ(both.lines[1].cells[0].state, SurvivalMap::State::survived);
  EXPECT_NE(markdown(both).find("- bar, fem: the bar is of particles"), std::string::npos);
  const std::string svg = draw(both);
  EXPECT_NE(svg.find(">does not apply<"), std::string::npos);
  EXPECT_NE(svg.find("<title>the bar is of particles</title>"), std::string::npos);
}

TEST(Maps, SayWhatASurvivorKeepsAndWhoSaysSo)
{
  Example  e;
  Case    &bar                     = e.study.cases[0];
  bar.group                        = "bending";
  bar.quantities[0].at_most        = .0245;
  bar.quantities[0].bound_source   = "a book";
  Judged drift;
  static_cast<Measured &>(drift)   = bar.known[1];
  drift.at_least                   = 0; // every row has -1e-3
  drift.bound_source               = "another";
  bar.quantities.push_back(drift);
  MapSpec m;
  m.cases                = {"bar", "rod"};
  m.columns              = {"method", "alpha"};
  const SurvivalMap  map = make_map(e.results(), m);
  const auto        &bars = map.lines[0];
  EXPECT_EQ(bars.bounds, "tip ≤ 24.5 mm, energy_drift ≥ 0");
  EXPECT_EQ(bars.source, "a book; another");
  EXPECT_EQ(map.lines[1].bounds, "runs to its end");
  // the metric, tip, does not show why the first failed; it does for the last
  EXPECT_EQ(bars.cells[3].metric, "20 mm");
  EXPECT_EQ(bars.cells[3].detail, "energy_drift -0.001");
  EXPECT_EQ(bars.cells[8].metric, "25 mm");
  EXPECT_EQ(bars.cells[8].detail, "");
  const std::string svg = draw(map);
  for (const char *words : {">bending<", "[1] a book; another", "survived: the run ends and keeps every bound",
                            "failed: it ends early or breaks a bound", ">energy drift<"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("does not apply"), std::string::npos); // no such cell, so not in the legend
  EXPECT_NE(markdown(map).find("| bending: bar | tip | tip ≤ 24.5 mm, energy_drift ≥ 0 |"), std::string::npos);
}

TEST(Maps, ARunThatEndsEarlySaysSo)
{
  Example e;
  e.outcomes[0].status = Status::failed;
  e.outcomes[1].status = Status::too_long;
  MapSpec m;
  m.cases     = {"bar"};
  m.columns   = {"method", "alpha"};
  const auto cells = make_map(e.results(), m).lines[0].cells;
  EXPECT_EQ(cells[0].detail, "ended early");
  EXPECT_EQ(cells[1].detail, "too long");
  EXPECT_EQ(cells[2].detail, "");
}

// Ten lines of one group and one of another: the heads stand above both groups.
TEST(Maps, HeadsStandAgainInALongPicture)
{
  SurvivalMap map;
  map.columns = {{"this column"}};
  const auto heads = [&] {
    const std::string svg = draw(map);
    std::size_t       n   = 0;
    for (std::size_t at = svg.find(">this column<"); at != std::string::npos; at = svg.find(">this column<", at + 1))
      ++n;
    return n;
  };
  map.lines.assign(10, {"line", "", "early", "runs to its end", "", {SurvivalMap::Cell{}}});
  EXPECT_EQ(heads(), 1u);
  map.lines.push_back({"line", "", "late", "runs to its end", "", {SurvivalMap::Cell{}}});
  EXPECT_EQ(heads(), 2u);
}
