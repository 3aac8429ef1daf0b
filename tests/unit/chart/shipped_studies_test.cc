// SPDX-License-Identifier: LGPL-2.1-or-later
// What the columns of the shipped stability map are called is what they run.
#include "apps/chart/rows.h"
#include "apps/chart/study_reader.h"
#include "core/input/scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace ogive;
using namespace ogive::chart;

// A case that forgot to set the method at "elements" would show particles there.
TEST(StabilityStudy, ColumnsOfElementsHaveNoParticles)
{
  const Study s = read_study(OGIVE_SOURCE_DIR "/apps/studies/stability.prm");
  for (const Row &row : expand(s).rows)
  {
    const input::Scene scene = read_variant(s.cases[row.of_case].scene, row.overrides, row.name);
    const bool particles     = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                           [](const input::Body &b) { return b.method == input::Method::sph; });
    EXPECT_EQ(particles, level_name(s, row, "configuration").find("elements") != 0) << row.name;
  }
}

TEST(StabilityStudy, EveryBoundSaysWhereItComesFrom)
{
  const Study s = read_study(OGIVE_SOURCE_DIR "/apps/studies/stability.prm");
  for (const Case &c : s.cases)
  {
    EXPECT_FALSE(c.group.empty()) << c.name;
    EXPECT_TRUE(std::any_of(c.quantities.begin(), c.quantities.end(),
                            [](const Judged &q) { return q.bounded() && !q.bound_source.empty(); }))
      << c.name;
  }
}
