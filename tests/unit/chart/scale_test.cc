// SPDX-License-Identifier: LGPL-2.1-or-later
// Ticks by hand: steps of 1, 2, 5 and decades.
#include "apps/chart/scale.h"
#include "apps/chart/text.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace ogive::chart;

namespace
{
std::vector<std::string> labels(const Scale &s)
{
  std::vector<std::string> all;
  for (const Tick &t : s.ticks)
    if (!t.label.empty())
      all.push_back(t.label);
  return all;
}
using Labels = std::vector<std::string>;
} // namespace

TEST(Scale, LinearTicksAreRound)
{
  EXPECT_EQ(labels(linear_scale(.3, 9.7)), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(linear_scale(-.031, .052)), (Labels{"-0.04", "-0.02", "0.00", "0.02", "0.04", "0.06"}));
  EXPECT_EQ(labels(linear_scale(1210, 1390)), (Labels{"1200", "1250", "1300", "1350", "1400"}));
  const Scale s = linear_scale(1210, 1390);
  EXPECT_DOUBLE_EQ(s.at(1200), 0);
  EXPECT_DOUBLE_EQ(s.at(1250), .25);
  EXPECT_DOUBLE_EQ(s.at(1400), 1);
}

TEST(Scale, LogarithmicTicksAreDecades)
{
  EXPECT_EQ(labels(log_scale(.013, 87)), (Labels{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(labels(log_scale(3e-7, 4e-3)), (Labels{"10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"}));
  // few decades: 2 and 5 are named too
  EXPECT_EQ(labels(log_scale(50, 400)), (Labels{"50", "100", "200", "500"}));
  const Scale s = log_scale(50, 400);
  EXPECT_DOUBLE_EQ(s.at(50), 0);
  EXPECT_NEAR(s.at(100), std::log(2) / std::log(10), 1e-15);
}

TEST(Scale, ContainsItsDataAndIsNeverEmpty)
{
  for (const double low : {1e-12, 3.7e-5, .2, 1., 6.02e23})
    for (const double ratio : {1., 1.0001, 3., 1e4, 1e11})
    {
      const Scale log = log_scale(low, low * ratio), linear = linear_scale(low, low * ratio);
      for (const Scale *s : {&log, &linear})
      {
        EXPECT_LT(s->low, s->high);
        EXPECT_LE(s->low, low * (1 + 1e-9));
        EXPECT_GE(s->high, low * ratio * (1 - 1e-9));
        EXPECT_GE(s->ticks.size(), 2u);
        EXPECT_LE(labels(*s).size(), 12u);
      }
    }
  EXPECT_LT(linear_scale(0, 0).low, linear_scale(0, 0).high);
}

TEST(Scale, ValuesAreShownInReadableUnits)
{
  EXPECT_EQ(shown(.02142, "m"), "21.42 mm");
  EXPECT_EQ(shown(3.4569e-5, "s"), "34.57 µs");
  EXPECT_EQ(shown(4e8, "Pa"), "400 MPa");
  EXPECT_EQ(shown(227, "m/s"), "227 m/s");
  EXPECT_EQ(shown(.0001234, "1"), "0.0001234");
  EXPECT_EQ(percent(-.0123), "-1.23 %");
}
