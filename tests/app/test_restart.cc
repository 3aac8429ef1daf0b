// SPDX-License-Identifier: LGPL-2.1-or-later
// A run that is broken off and continued gives the same bytes as one that is
// not: through contact, the tied interface, plasticity and damage.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
std::vector<std::string> checkpoints(const std::string &directory)
{
  std::vector<std::string> files;
  for (const auto &entry : fs::directory_iterator(directory))
    if (entry.path().filename().string().starts_with("checkpoint-"))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Runs a scene with checkpoints, copies the run as it was at its second-last
/// kept state, continues the copy, compares.
void restart_equals_unbroken(std::vector<std::string> arguments)
{
  const Scratch     scratch;
  const std::string whole = scratch.path("whole"), broken = scratch.path("broken");
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), {"-o", whole});
  const Outcome run = ogive::test::ogive(arguments);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto kept = checkpoints(whole);
  ASSERT_GE(kept.size(), 3u);

  fs::copy(whole, broken);
  fs::remove(broken + "/summary.json");
  const auto copies = checkpoints(broken);
  for (std::size_t k = copies.size() / 2; k < copies.size(); ++k)
    fs::remove(copies[k]);
  const Outcome restart = ogive::test::ogive({"restart", broken});
  ASSERT_EQ(restart.status, 0) << restart.err;

  EXPECT_EQ(read_file(whole + "/history.csv"), read_file(broken + "/history.csv"));
  ASSERT_EQ(fs::exists(whole + "/conversions.csv"), fs::exists(broken + "/conversions.csv"));
  if (fs::exists(whole + "/conversions.csv"))
  {
    EXPECT_EQ(read_file(whole + "/conversions.csv"), read_file(broken + "/conversions.csv"));
  }
  const auto ends = checkpoints(broken);
  EXPECT_EQ(fs::path(kept.back()).filename(), fs::path(ends.back()).filename());
  EXPECT_TRUE(read_file(kept.back()) == read_file(ends.back())) << "final checkpoints differ";
}
} // namespace

TEST(Restart, PlateThroughContactAndTiedInterface)
{
  restart_equals_unbroken({scene("plate-weldox-blunt/scene.prm"), "--set", "Bodies/projectile/spacing=5 mm", "--set",
                           "Bodies/plate-zone/spacing=3 mm", "--set", "Bodies/plate-rest/spacing=6 mm", "--set",
                           "end time=12 us", "--set", "Output/checkpoint interval=2 us", "--set",
                           "Output/history interval=0.5 us", "--set", "Output/field interval=4 us"});
}

// Elements turn into particles before and after the checkpoint, under contact and
// beside a seam that moves.
TEST(Restart, PlateThroughConversion)
{
  restart_equals_unbroken({scene("plate-weldox-blunt/auto.prm"), "--set", "Bodies/projectile/spacing=2 mm", "--set",
                           "Bodies/plate/spacing=1 mm", "--set", "Bodies/plate/spacing far=8 mm", "--set",
                           "end time=12 us", "--set", "Output/checkpoint interval=1 us", "--set",
                           "Output/field interval=4 us"});
}

TEST(Restart, ParticlesOnAWall)
{
  restart_equals_unbroken({scene("taylor-copper-227/scene.prm"), "--set", "Bodies/bar/method=sph", "--set",
                           "Bodies/bar/spacing=0.8 mm", "--set", "end time=6 us", "--set",
                           "Output/checkpoint interval=1 us"});
}

TEST(Restart, RefusesWhatIsNoCheckpoint)
{
  const Scratch scratch;
  const Outcome run =
    ogive::test::ogive({"run", scene("elastic-bar/scene.prm"), "-o", scratch.path("r"), "--set",
                        "Bodies/bar/spacing=5 mm", "--set", "end time=5 us"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string last    = checkpoints(scratch.path("r")).back();
  const std::string history = read_file(scratch.path("r/history.csv"));

  const std::string bytes = read_file(last);
  write_file(last, bytes.substr(0, bytes.size() / 2));
  const Outcome truncated = ogive::test::ogive({"restart", scratch.path("r")});
  EXPECT_EQ(truncated.status, 2);
  EXPECT_NE(truncated.err.find(fs::path(last).filename().string()), std::string::npos) << truncated.err;

  write_file(last, "hello\n");
  EXPECT_EQ(ogive::test::ogive({"restart", scratch.path("r")}).status, 2);
  EXPECT_EQ(ogive::test::ogive({"restart", scratch.path("nowhere")}).status, 2);
  EXPECT_EQ(read_file(scratch.path("r/history.csv")), history);
}

TEST(Restart, ShockTubeWithItsStartStates)
{
  restart_equals_unbroken({scene("sod/scene.prm"), "--set", "Bodies/gas/spacing=10 mm", "--set",
                           "Output/checkpoint interval=40 ms"});
}

// Observers that remember: the energy of a wave at its start, the worst overshoot.
TEST(Restart, ObserversThatRemember)
{
  restart_equals_unbroken({scene("smooth-wave/scene.prm"), "--set", "Output/checkpoint interval=10 us"});
  restart_equals_unbroken({scene("symmetric-impact/scene.prm"), "--set", "Output/checkpoint interval=2 us"});
  restart_equals_unbroken({scene("shear-flow/scene.prm"), "--set", "end time=20 us", "--set",
                           "Output/checkpoint interval=4 us"});
}
