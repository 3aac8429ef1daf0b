// SPDX-License-Identifier: LGPL-2.1-or-later
// The command line as users and scripts rely on it: exit statuses, messages,
// files, and that nothing is written over.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
/// A run of a few steps.
std::vector<std::string> short_run(const Scratch &scratch)
{
  return {"run",   scene("elastic-bar/scene.prm"), "-o", scratch.path("r"), "--set", "Bodies/bar/spacing=5 mm",
          "--set", "end time=5 us"};
}
} // namespace

TEST(Command, SaysWhatItCanDo)
{
  const Outcome help = ogive::test::ogive({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char *word : {"check", "run", "restart", "materials", "reference", "bench"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(ogive::test::ogive({"fly"}).status, 2);
  EXPECT_EQ(ogive::test::ogive({}).status, 2);
}

TEST(Command, RunWritesWhatIsPromised)
{
  const Scratch scratch;
  const Outcome run = ogive::test::ogive(short_run(scratch));
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char *file : {"summary.json", "history.csv", "results.xdmf", "results.h5", "resolved.prm"})
  {
    EXPECT_TRUE(fs::exists(scratch.path("r/") + file)) << file;
    EXPECT_NE(run.out.find(std::string(file) == "results.h5" ? "results.xdmf" : file), std::string::npos) << file;
  }
  const auto s = summary(scratch.path("r"));
  for (const char *entry : {"scene", "title", "version", "commit", "ranks", "dimension", "wall_s", "core_s", "steps",
                            "end_time_s", "counts", "quantities", "ledger", "checks", "throughput", "limiter"})
    EXPECT_TRUE(s.contains(entry)) << entry;
  EXPECT_EQ(s.at("scene"), "elastic-bar");
  EXPECT_DOUBLE_EQ(s.at("end_time_s").get<double>(), 5e-6); // the last step lands on the end time
}

TEST(Command, NothingIsOverwrittenWithoutForce)
{
  const Scratch scratch;
  ASSERT_EQ(ogive::test::ogive(short_run(scratch)).status, 0);
  const std::string before  = read_file(scratch.path("r/summary.json"));
  const Outcome     refused = ogive::test::ogive(short_run(scratch));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(scratch.path("r/summary.json")), before);
  auto forced = short_run(scratch);
  forced.push_back("--force");
  EXPECT_EQ(ogive::test::ogive(forced).status, 0);
}

TEST(Command, ResolvedSceneGivesTheSameHistory)
{
  const Scratch scratch;
  ASSERT_EQ(ogive::test::ogive(short_run(scratch)).status, 0);
  const Outcome again = ogive::test::ogive({"run", scratch.path("r/resolved.prm"), "-o", scratch.path("again")});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_file(scratch.path("r/history.csv")), read_file(scratch.path("again/history.csv")));
}

TEST(Command, CheckPrintsThePlan)
{
  const Outcome check = ogive::test::ogive({"check", scene("plate-weldox-blunt/scene.prm")});
  ASSERT_EQ(check.status, 0) << check.err;
  for (const char *word : {"3-D", "symmetry planes x, y", "projectile", "pair-flux", "contact", "counts", "step", "memory"})
    EXPECT_NE(check.out.find(word), std::string::npos) << word << " in\n" << check.out;
}

TEST(Command, BadSceneEndsWithStatusTwoAndOneMessage)
{
  const Scratch scratch;
  const Outcome run = ogive::test::ogive({"run", scene("elastic-bar/scene.prm"), "-o", scratch.path("r"), "--set",
                                          "Bodies/bar/methd=sph"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("method"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(scratch.path("r")));
}

TEST(Command, UnwritableDirectoryIsBadInput)
{
  const Scratch scratch;
  write_file(scratch.path("file"), "not a directory\n");
  auto a = short_run(scratch);
  a[3]   = scratch.path("file/r");
  const Outcome run = ogive::test::ogive(a);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find(scratch.path("file")), std::string::npos) << run.err;
  EXPECT_EQ(read_file(scratch.path("file")), "not a directory\n");
}

TEST(Command, MaterialsNameTheirSources)
{
  const Outcome list = ogive::test::ogive({"materials"});
  ASSERT_EQ(list.status, 0);
  for (const char *name : {"copper-ofhc", "copper-benchmark", "steel-4340", "iron-armco", "aluminium-6061-t6",
                           "aluminium-1100-h12", "weldox-460e", "arne-tool-steel", "tungsten-alloy", "beryllium",
                           "rubber"})
  {
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
    const Outcome one = ogive::test::ogive({"materials", name});
    EXPECT_EQ(one.status, 0);
    EXPECT_NE(one.out.find("Sources"), std::string::npos) << name;
  }
  const Outcome unknown = ogive::test::ogive({"materials", "weldox-460"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("weldox-460e"), std::string::npos) << unknown.err;
}

TEST(Command, ReferenceListsEntriesWithUnits)
{
  const Outcome reference = ogive::test::ogive({"reference"});
  ASSERT_EQ(reference.status, 0);
  for (const char *entry : {"end time", "spacing", "velocity", "tied", "friction", "foot_radius"})
    EXPECT_NE(reference.out.find(entry), std::string::npos) << entry;
}

namespace
{
/// A copper bar on a wall far above any speed that the model is meant for, in steps of
/// particles above their bound.
Outcome absurd_impact(const Scratch &scratch, const std::string &method, const std::string &speed,
                      const std::string &end)
{
  return ogive::test::ogive({"run", scene("taylor-copper-227/scene.prm"), "-o", scratch.path("r"), "--set",
                             "Bodies/bar/method=" + method, "--set", "Bodies/bar/velocity=0, 0, -" + speed, "--set",
                             "Bodies/bar/spacing=0.8 mm", "--set", "end time=" + end, "--set", "SPH/step factor=1.5"});
}
} // namespace

TEST(Command, RejectedStepGoesBackAndOnWithItsBooksClosed)
{
  const Scratch scratch;
  const Outcome run = absurd_impact(scratch, "sph", "20 km/s", "0.8 us");
  ASSERT_EQ(run.status, 0) << run.err;
  ASSERT_NE(run.err.find("step rejected"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("of body \"bar\" at ("), std::string::npos) << run.err;
  const auto s = summary(scratch.path("r"));
  EXPECT_LT(std::abs(s.at("checks").at("energy_drift").get<double>()), 1e-10);
  EXPECT_DOUBLE_EQ(s.at("end_time_s").get<double>(), .8e-6);
  EXPECT_FALSE(s.at("warnings").empty());
}

TEST(Command, FailingRunNamesEntityPlaceTimeAndCause)
{
  const Scratch scratch;
  const Outcome run = absurd_impact(scratch, "fem", "30 km/s", "4 us");
  EXPECT_EQ(run.status, 1);
  for (const char *word : {"element ", "of body \"bar\"", " m: ", "at time ", "the time step fell to"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  EXPECT_TRUE(fs::exists(scratch.path("r/history.csv"))); // what was written stays
}

TEST(Command, SceneThatCannotBeBuiltTouchesNothing)
{
  const Scratch scratch;
  ASSERT_EQ(ogive::test::ogive(short_run(scratch)).status, 0);
  const std::string history = read_file(scratch.path("r/history.csv"));
  // no particle at the seam: found only once both bodies stand
  std::string text = read_file(scene("plate-weldox-blunt/scene.prm"));
  text.replace(text.find("set radius    = 24 mm"), 21, "set radius    = 18 mm");
  write_file(scratch.path("wrong.prm"), text);
  const Outcome run = ogive::test::ogive({"run", scratch.path("wrong.prm"), "-o", scratch.path("r"), "--force"});
  EXPECT_EQ(run.status, 2);
  for (const char *word : {"wrong.prm:60: ", "Interfaces/plate", "plate-zone", "m away"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  EXPECT_EQ(read_file(scratch.path("r/history.csv")), history);
}

TEST(Command, CountsBeyondReasonAreRefusedAtOnce)
{
  for (const char *setting : {"Bodies/projectile/spacing=1e-9 mm", "Bodies/plate-zone/spacing=1e-9 mm"})
  {
    const Outcome check = ogive::test::ogive({"check", scene("plate-weldox-blunt/scene.prm"), "--set", setting});
    EXPECT_EQ(check.status, 2);
    EXPECT_NE(check.err.find("points"), std::string::npos) << check.err;
  }
}
