// SPDX-License-Identifier: LGPL-2.1-or-later
// Programs side by side, with the shell as the program.
#include "apps/chart/processes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

using namespace ogive::chart;

namespace
{
Job shell(const std::string &script, double limit = 0)
{
  return {{"/bin/sh", "-c", script}, limit};
}

std::vector<Ended> run(const std::vector<Job> &jobs, int at_once)
{
  std::vector<Ended> all(jobs.size());
  run_all(jobs, at_once, [&](std::size_t i, const Ended &e) { all[i] = e; });
  return all;
}
} // namespace

TEST(Processes, GiveStatusAndWhatTheyWrote)
{
  const auto all = run({shell("echo one; echo two >&2; exit 3"), shell("kill -9 $$"), {{"/no/such/program"}, 0}}, 2);
  EXPECT_EQ(all[0].exit, 3);
  EXPECT_EQ(all[0].out, "one\n");
  EXPECT_EQ(all[0].err, "two\n");
  EXPECT_EQ(all[1].signal, 9);
  EXPECT_FALSE(all[1].too_long);
  EXPECT_EQ(all[2].exit, 127);
}

TEST(Processes, EndAtTheirLimit)
{
  const auto all = run({shell("exec sleep 60", .05), shell("exit 0", 60)}, 1);
  EXPECT_TRUE(all[0].too_long);
  EXPECT_EQ(all[1].exit, 0);
}

TEST(Processes, RunNoMoreThanAskedFor)
{
  std::size_t most = 0;
  run_all(
    std::vector<Job>(6, shell("sleep .1")), 3, [](std::size_t, const Ended &) {},
    [&](std::size_t running) { most = std::max(most, running); });
  EXPECT_EQ(most, 3u);
}

TEST(Processes, AnExceptionEndsTheOthers)
{
  // were the long one waited for, this test would run into its time limit
  EXPECT_THROW(run_all({shell("exec sleep 1000"), shell("exit 1")}, 2,
                       [](std::size_t, const Ended &) { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

TEST(Processes, TheLastLineIsTheReason)
{
  EXPECT_EQ(last_line("a\nogive: b\n\n  \n"), "ogive: b");
  EXPECT_EQ(last_line(""), "");
}
