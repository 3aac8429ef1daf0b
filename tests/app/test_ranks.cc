// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs on ranks as a user starts them: the same answer, restart on another number
// of them, and errors that are told once and never leave a rank waiting.
#include "tests/app/ranks_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <sys/wait.h>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
/// What design.md asks of a smooth run on any number of ranks.
constexpr double same = 1e-9;

using Settings = std::vector<std::string>;

/// A plate of particles and elements under a projectile: contact, a seam,
/// plasticity, damage.
const char    *plate       = "plate-weldox-blunt/scene.prm";
const Settings small_plate = {"Bodies/projectile/spacing=5 mm", "Bodies/plate-zone/spacing=3 mm",
                              "Bodies/plate-rest/spacing=6 mm", "end time=4 us",
                              "Output/checkpoint interval=1 us", "Output/history interval=0.5 us",
                              "Output/field interval=2 us"};

void expect_same(const std::string &directory, const Numbers &reference, double bound = same)
{
  const Difference d = difference(numbers_of(directory), reference);
  EXPECT_LT(d.quantities.value, bound) << d.quantities.where;
  EXPECT_LT(d.history.value, bound) << d.history.where;
  EXPECT_LT(d.checks.value, bound) << d.checks.where;
}

void same_on_2_and_3(const std::string &name, const Settings &settings, double bound = same)
{
  const Scratch scratch;
  const Outcome alone = run_on(0, name, settings, scratch.path("1"));
  ASSERT_EQ(alone.status, 0) << alone.err;
  const Numbers reference = numbers_of(scratch.path("1"));
  EXPECT_EQ(reference.ranks, 1);
  for (const int n : {2, 3})
  {
    SCOPED_TRACE(std::to_string(n) + " ranks");
    const std::string directory = scratch.path(std::to_string(n));
    const Outcome     run       = run_on(n, name, settings, directory);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(numbers_of(directory).ranks, n);
    expect_same(directory, reference, bound);
  }
}

std::size_t times(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++n;
  return n;
}

/// Runs words of a shell as mpirun's, for what a user starts by hand.
Outcome by_mpirun(int ranks, const std::string &words)
{
  const Scratch     scratch;
  const std::string line = "mpirun -q --allow-run-as-root --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -n " +
                           std::to_string(ranks) + " " + words + " >" + scratch.path("out") + " 2>" + scratch.path("err");
  const int         status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(scratch.path("out")), read_file(scratch.path("err"))};
}

/// Without any program in the path while it lives.
class NoPrograms
{
public:
  NoPrograms() { setenv("PATH", "/nowhere", 1); }
  ~NoPrograms() { setenv("PATH", path_.c_str(), 1); }

private:
  std::string path_ = std::getenv("PATH");
};

std::vector<std::string> checkpoints(const std::string &directory)
{
  std::vector<std::string> files;
  for (const auto &entry : fs::directory_iterator(directory))
    if (entry.path().filename().string().starts_with("checkpoint-"))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A copy of a run as it was half-way.
std::string broken_off(const Scratch &scratch, const std::string &whole, const std::string &name)
{
  const std::string broken = scratch.path(name);
  fs::copy(whole, broken);
  fs::remove(broken + "/summary.json");
  const auto all = checkpoints(broken);
  for (std::size_t k = all.size() / 2; k < all.size(); ++k)
    fs::remove(all[k]);
  return broken;
}
} // namespace

TEST(Ranks, ParticlesInThreeDimensions)
{
  same_on_2_and_3("taylor-copper-227/scene.prm", {"Bodies/bar/method=sph", "Bodies/bar/spacing=0.8 mm", "end time=4 us"});
}

TEST(Ranks, ElementsInThreeDimensions)
{
  same_on_2_and_3("taylor-copper-227/scene.prm", {"Bodies/bar/method=fem", "Bodies/bar/spacing=0.6 mm", "end time=6 us"});
}

TEST(Ranks, ElementsOnTheAxis)
{
  same_on_2_and_3("taylor-copper-227/axisymmetric.prm", {"Bodies/bar/spacing=0.4 mm", "end time=6 us"});
}

TEST(Ranks, ParticlesInThePlane)
{
  same_on_2_and_3("oscillating-plate/scene.prm", {"end time=2 ms"});
  // Rings that meet mirrored: of two equally near particles rounding chooses. On one rank
  // 1e-10 m/s more of one ring move the energy kept by 3e-9 and the smallest distance by 1e-8.
  same_on_2_and_3("rubber-rings/scene.prm", {"end time=20 us"}, 1e-6);
}

TEST(Ranks, ASplitBar)
{
  same_on_2_and_3("elastic-bar/split.prm", {"end time=20 us"});
}

// One run on each number of ranks serves all: the same answer, and what goes on
// from the middle of one on as many ranks or on others.
TEST(Ranks, CoupledPlateAndItsRestarts)
{
  const Scratch              scratch;
  std::map<int, std::string> whole;
  for (const int n : {1, 2, 3})
  {
    whole[n]          = scratch.path("whole-" + std::to_string(n));
    const Outcome run = run_on(n, plate, small_plate, whole[n]);
    ASSERT_EQ(run.status, 0) << run.err;
    ASSERT_GE(checkpoints(whole[n]).size(), 3u);
  }
  const Numbers reference = numbers_of(whole[1]);
  expect_same(whole[2], reference);
  expect_same(whole[3], reference);
  for (const auto &[from, to] : {std::pair{2, 3}, {3, 1}, {1, 2}, {2, 2}})
  {
    const std::string name = std::to_string(from) + " on " + std::to_string(to);
    SCOPED_TRACE(name);
    const std::string broken  = broken_off(scratch, whole[from], name);
    const Outcome     restart = ogive::test::ogive({"restart", broken, "-n", std::to_string(to)});
    ASSERT_EQ(restart.status, 0) << restart.err;
    EXPECT_EQ(numbers_of(broken).ranks, to);
    expect_same(broken, reference);
    if (from == to) // which also repeats the second half of a run
    {
      EXPECT_EQ(read_file(broken + "/history.csv"), read_file(whole[from] + "/history.csv"));
      EXPECT_TRUE(read_file(checkpoints(broken).back()) == read_file(checkpoints(whole[from]).back()))
        << "final checkpoints differ";
    }
  }
}

TEST(Ranks, TwoRunsOnAsManyRanksAreEqualToTheBit)
{
  const Scratch  scratch;
  const Settings few = {"Bodies/bar/method=sph", "Bodies/bar/spacing=0.8 mm", "end time=3 us"};
  for (const char *name : {"a", "b"})
  {
    const Outcome run = run_on(3, "taylor-copper-227/scene.prm", few, scratch.path(name));
    ASSERT_EQ(run.status, 0) << run.err;
  }
  EXPECT_EQ(read_file(scratch.path("a/history.csv")), read_file(scratch.path("b/history.csv")));
  EXPECT_TRUE(read_file(checkpoints(scratch.path("a")).back()) == read_file(checkpoints(scratch.path("b")).back()));
}

TEST(Ranks, OneProcessNeedsNoMpirun)
{
  const Scratch    scratch;
  const NoPrograms none;
  const Settings   few = {"Bodies/bar/spacing=5 mm", "end time=5 us"};
  EXPECT_EQ(run_on(0, "elastic-bar/scene.prm", few, scratch.path("a")).status, 0);
  EXPECT_EQ(run_on(1, "elastic-bar/scene.prm", few, scratch.path("b")).status, 0);
  EXPECT_EQ(read_file(scratch.path("a/history.csv")), read_file(scratch.path("b/history.csv")));
  const Outcome two = run_on(2, "elastic-bar/scene.prm", few, scratch.path("c"));
  EXPECT_EQ(two.status, 2);
  EXPECT_NE(two.err.find("openmpi-bin"), std::string::npos) << two.err;
  EXPECT_FALSE(fs::exists(scratch.path("c")));
}

TEST(Ranks, StartedByMpirun)
{
  const Scratch     scratch;
  const std::string words = std::string(OGIVE_COMMAND) + " run " + scene("elastic-bar/scene.prm") + " -o " +
                            scratch.path("r") + " --set 'Bodies/bar/spacing=5 mm' --set 'end time=5 us'";
  const Outcome run = by_mpirun(2, words);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(summary(scratch.path("r")).at("ranks"), 2);
  EXPECT_EQ(times(run.out, "written to"), 1u) << run.out; // the first rank alone speaks

  const Outcome other = by_mpirun(2, words + " --force -n 3");
  EXPECT_EQ(other.status, 2);
  EXPECT_EQ(times(other.err, "mpirun has started 2 processes"), 1u) << other.err;
  const Outcome check = by_mpirun(2, std::string(OGIVE_COMMAND) + " check " + scene("elastic-bar/scene.prm"));
  EXPECT_EQ(check.status, 2);
  EXPECT_EQ(times(check.err, "runs on one process"), 1u) << check.err;
}

TEST(Ranks, BadInputIsToldOnce)
{
  const Scratch scratch;
  const Outcome wrong = run_on(3, "elastic-bar/scene.prm", {"Bodies/bar/spacing=5 kg"}, scratch.path("r"));
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(times(wrong.err, "spacing"), times(run_on(0, "elastic-bar/scene.prm", {"Bodies/bar/spacing=5 kg"},
                                                      scratch.path("r")).err, "spacing")) << wrong.err;
  EXPECT_EQ(times(wrong.err, "ogive:"), 1u) << wrong.err;
  EXPECT_FALSE(fs::exists(scratch.path("r")));

  // found by the first rank alone, which makes the directory
  const Settings few = {"Bodies/bar/spacing=5 mm", "end time=5 us"};
  ASSERT_EQ(run_on(0, "elastic-bar/scene.prm", few, scratch.path("full")).status, 0);
  const std::string before = read_file(scratch.path("full/summary.json"));
  const Outcome     full   = run_on(2, "elastic-bar/scene.prm", few, scratch.path("full"));
  EXPECT_EQ(full.status, 2);
  EXPECT_EQ(times(full.err, "--force"), 1u) << full.err;
  EXPECT_EQ(read_file(scratch.path("full/summary.json")), before);
}

TEST(Ranks, AFailedRunIsToldOnce)
{
  const Scratch scratch;
  const Outcome run = run_on(2, plate, {"Bodies/projectile/spacing=5 mm", "Bodies/plate-zone/spacing=3 mm",
                                        "Bodies/plate-rest/spacing=6 mm", "end time=6 us", "Limits/energy drift=1e-12"},
                             scratch.path("r"));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(times(run.err, "ogive: at "), 1u) << run.err;
  EXPECT_NE(run.err.find("energy"), std::string::npos) << run.err;
}

TEST(Ranks, TroubleOfOneEndsAll)
{
  const Outcome alike = by_mpirun(3, OGIVE_TROUBLE " alike");
  EXPECT_EQ(alike.status, 2);
  EXPECT_EQ(alike.err, "no such scene\n");
  const Outcome differ = by_mpirun(3, OGIVE_TROUBLE " differ");
  EXPECT_EQ(differ.status, 1);
  for (const char *rank : {"0", "1", "2"})
    EXPECT_EQ(times(differ.err, std::string("trouble of ") + rank + " (rank " + rank + ")"), 1u) << differ.err;
  // the others wait for the one in trouble, which would be for ever
  const Outcome one = by_mpirun(3, OGIVE_TROUBLE " one");
  EXPECT_EQ(one.status, 1);
  EXPECT_EQ(times(one.err, "a stray error (rank 1 of 3)"), 1u) << one.err;
}
