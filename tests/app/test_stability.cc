// SPDX-License-Identifier: LGPL-2.1-or-later
// A cut of the stability study, whose verdicts are known beforehand, from the runs
// to the map; and the scenes made for it against what is exact.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

using namespace ogive::test;

namespace
{
using Names = std::vector<std::string>;

bool has(const Names &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string joined(const Names &names)
{
  std::string text;
  for (const std::string &n : names)
    text += (text.empty() ? "" : ", ") + n;
  return text;
}

/// The shipped study with these cases and levels of its axis alone.
std::string cut(const Names &cases, const Names &levels)
{
  std::istringstream in(read_file(std::string(OGIVE_SOURCE_DIR) + "/apps/studies/stability.prm"));
  std::string        text, line;
  Names              path;
  int                skipped = 0; // depth inside a subsection that is left out
  while (std::getline(in, line))
  {
    std::istringstream words(line);
    std::string        first, second;
    words >> first >> second;
    if (first == "subsection")
    {
      const bool out = (path == Names{"Cases"} && !has(cases, second)) ||
                       (path == Names{"Axes", "configuration"} && !has(levels, second));
      skipped += skipped > 0 || out;
      path.push_back(second);
    }
    const std::size_t at    = line.find(" at ");
    const bool        other = path.size() == 4 && path[2] == "Axes" && at != std::string::npos &&
                       !has(levels, line.substr(at + 4, line.find(' ', at + 4) - at - 4));
    if (first == "set" && second == "cases")
      line = "set cases = " + joined(cases);
    if (first == "set" && second == "levels")
      line = "set levels = " + joined(levels);
    if (const std::size_t place = line.find("../scenes/"); place != std::string::npos)
      line.replace(place, 10, scene(""));
    if (skipped == 0 && !other)
      text += line + "\n";
    if (first == "end")
    {
      path.pop_back();
      skipped -= skipped > 0;
    }
  }
  return text;
}

/// The cells of the map's line whose first one ends so, without the first three.
Names map_line(const std::string &tables, const std::string &title)
{
  std::istringstream in(tables.substr(tables.find("## What survives")));
  for (std::string line; std::getline(in, line);)
    if (line.find(title + " |") != std::string::npos)
    {
      std::istringstream cells(line.substr(2));
      Names              all;
      for (std::string cell; std::getline(cells, cell, '|');)
        all.push_back(cell);
      all.erase(all.begin(), all.begin() + 3);
      return all;
    }
  return {};
}
} // namespace

// Known beforehand: the corrected gradient is exact on any lattice and the standard
// one is not; nothing in a one-point element resists a chessboard of velocities, so
// that without control all of its energy is left, while particles damp it.
TEST(StabilityMap, SurvivorsAndFailuresAreNotMixedUp)
{
  const Scratch s;
  write_file(s.path("study.prm"),
             cut({"saw-tooth", "patch-start"}, {"standard", "split", "elements", "elements-bare"}));
  const Outcome run = ogive::test::ogive({"chart", s.path("study.prm"), "-o", s.path("r")});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string tables = read_file(s.path("r/tables.md"));
  const Names       saw    = map_line(tables, "zero-energy modes: saw-tooth velocity, chessboard");
  const Names       patch  = map_line(tables, "particle disorder: the same, jitter .3, after two steps");
  ASSERT_EQ(saw.size(), 4u) << tables;
  ASSERT_EQ(patch.size(), 4u) << tables;
  const auto begins = [](const std::string &cell, const std::string &with) { return cell.find(with) == 1; };
  EXPECT_TRUE(begins(saw[1], "survived, ")) << saw[1];
  EXPECT_TRUE(begins(saw[3], "**failed**, 1 ")) << saw[3];
  EXPECT_TRUE(begins(patch[0], "**failed**, ")) << patch[0];
  EXPECT_TRUE(begins(patch[1], "survived, ")) << patch[1];
  EXPECT_TRUE(begins(patch[2], "does not apply")) << patch[2];
  EXPECT_TRUE(begins(patch[3], "does not apply")) << patch[3];
}

// Exact .2442 (the scene's reference). A row of the history is .4 % of that; the
// elastic waves of the start leave as much.
TEST(TensileRod, ElementsBreakWhereTheyShould)
{
  const auto s = run_scene("tensile-rod/scene.prm",
                           {"Bodies/rod/method=fem", "Bodies/rod/lower=-10, -2.5 mm", "Bodies/rod/upper=10, 2.5 mm",
                            "Bodies/rod/field speed=40 m/s"});
  EXPECT_LT(error(s, "fracture_strain"), .01);
}

// Swegle's condition: W'' > 0 at the neighbours' distance, so that tension is unstable
// and pressure is not, in the same patch.
TEST(StretchedPatch, TensionIsUnstableAndPressureIsNot)
{
  const Names form{"SPH/form=corrected", "SPH/kernel=cubic", "SPH/correction=none", "SPH/shock split=none",
                   "SPH/limiter=none"};
  Names       pressed = form;
  pressed.push_back("Bodies/patch/start density=1050 kg/m^3");
  const auto tension  = run_scene("swegle-patch/scene.prm", form);
  const auto pressure = run_scene("swegle-patch/scene.prm", pressed);
  EXPECT_GT(quantity(tension, "kinetic_energy_kept"), 100);
  EXPECT_LT(quantity(tension, "smallest_distance"), .5);
  EXPECT_LT(quantity(pressure, "kinetic_energy_kept"), 1);
  EXPECT_GT(quantity(pressure, "smallest_distance"), .95);
}

// On an even lattice the stress of a uniform stretch is right to the lattice's own
// error of waves; jitter spoils it in proportion.
TEST(PatchTest, JitterIsWhatSpoilsTheStress)
{
  const auto error_at = [](const char *jitter) {
    return quantity(run_scene("patch-test/scene.prm", {std::string("Bodies/block/jitter=") + jitter}), "patch_error");
  };
  const double even = error_at("0"), little = error_at("0.1"), more = error_at("0.2");
  EXPECT_LT(even, .01);
  EXPECT_GT(little, 10 * even);
  EXPECT_NEAR(more / little, 2, .4);
}
