// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace
{
using namespace ogive;

Progress at(double wall, double time)
{
  return {.time = time, .end_time = 8e-5, .start_time = 2e-5, .wall = wall, .step = 1234, .limiter = "element 7 of body \"bar\"", .energy_drift = -.00125};
}

TEST(Log, ShowsProgressOnATerminal)
{
  std::ostringstream out;
  Log                log(out, true);
  log.progress(at(30, 4e-5));
  // 30 s for a third of the remaining 6e-5 s: 60 s to go.
  for (const char *part : {" 50.0 %", "4e-05 s", "step 1234", "-0.12 %", "left 1 min 00 s", "element 7 of body \"bar\""})
    EXPECT_NE(out.str().find(part), std::string::npos) << part << " in: " << out.str();
  EXPECT_EQ(out.str().front(), '\r');
}

TEST(Log, IsQuietElsewhere)
{
  std::ostringstream out;
  Log                log(out, false);
  log.progress(at(30, 4e-5));
  log.finish();
  EXPECT_EQ(out.str(), "");
}

TEST(Log, SparesTheTerminal)
{
  std::ostringstream out;
  Log                log(out, true);
  for (int i = 0; i <= 1000; ++i)
    log.progress(at(.001 * i, 2.1e-5 + 1e-9 * i));
  const std::string text = out.str();
  // One second at five lines a second, and the first.
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 6);
  EXPECT_GE(std::count(text.begin(), text.end(), '\r'), 5);
}

TEST(Log, KeepsEachWarningOnce)
{
  std::ostringstream out;
  Log                log(out, true);
  log.progress(at(1, 3e-5));
  log.warn("strain rate beyond the data");
  log.warn("strain rate beyond the data");
  log.warn("temperature beyond the data");
  ASSERT_EQ(log.warnings().size(), 2u);
  EXPECT_EQ(log.warnings()[1], "temperature beyond the data");
  EXPECT_NE(out.str().find("\nwarning: strain rate beyond the data\nwarning: temperature"), std::string::npos);
}

TEST(Describe, NamesBodyPlaceAndCause)
{
  const Culprit     c{.entity = "particle", .body = 0, .id = 12, .where = {.25, 0, -1e-3}, .why = "density not finite"};
  const std::vector<std::string> bodies{"bar"};
  EXPECT_EQ(describe(c, bodies), "particle 12 of body \"bar\" at (0.25, 0, -0.001) m: density not finite");
  EXPECT_EQ(describe(c), "particle 12 of body 0 at (0.25, 0, -0.001) m: density not finite");
}
} // namespace
