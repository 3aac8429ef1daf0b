// SPDX-License-Identifier: LGPL-2.1-or-later
// chart.csv, cell by cell.
#include "apps/chart/csv.h"
#include "tests/unit/chart/example.h"

#include <gtest/gtest.h>

using namespace ogive;
using namespace ogive::chart;
using namespace ogive::chart::test;

TEST(Csv, QuotesWhereItMust)
{
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a, \"b\""), "\"a, \"\"b\"\"\"");
}

TEST(Csv, HasALineARowWithEmptyCellsWhereThereIsNothing)
{
  Study s                   = two_cases();
  s.cases[0].axes[0].levels = {"sph"};
  s.cases[0].axes[1].levels = {"1"};
  s.cases[1].axes[0].levels = {"0.5"};
  s.cases[1].known[0].dimension = units::velocity; // another unit of the same name: a column of its own
  const auto           rows = expand(s).rows;
  std::vector<Outcome> outcomes(2);
  Outcome             &o = outcomes[0];
  o.status               = Status::done;
  o.wall_s               = .25;
  o.core_s               = .125;
  o.steps                = 7;
  o.particles            = 3;
  o.quantities.push_back({"tip", "m", "exact", .75, .5});
  o.checks.push_back({"energy_drift", -1e-3});
  outcomes[1].reason = "element 3: negative volume, at 2 us";
  EXPECT_EQ(csv({s, rows, outcomes}),
            "case,method,alpha,status,reason,wall [s],core [s],steps,particles,elements,work,mass_drift,momentum_drift,"
            "angular_momentum_drift,energy_drift,hourglass_fraction,tip [m],tip reference [m],tip relative error,"
            "tip [m/s],tip reference [m/s],tip relative error\n"
            "bar,sph,1,done,,0.25,0.125,7,3,0,21,,,,-0.001,,0.75,0.5,0.5,,,\n"
            "rod,,0.5,failed,\"element 3: negative volume, at 2 us\",0,,,,,,,,,,,,,,,,\n");
}
