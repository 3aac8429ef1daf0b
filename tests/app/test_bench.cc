// SPDX-License-Identifier: LGPL-2.1-or-later
// What `ogive bench` writes and keeps. No figure of speed is asserted.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace ogive::test;

namespace
{
Outcome bench(std::vector<std::string> more)
{
  more.insert(more.begin(), {"bench", "--sph-edge", "8", "--fem-edge", "4", "--steps", "2"});
  return ogive::test::ogive(more);
}
} // namespace

TEST(Bench, WritesEachKernelBesideTheLimits)
{
  const Scratch scratch;
  const Outcome run = bench({"--json", scratch.path("bench.json"), "--kept", scratch.path("none.json")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(std::filesystem::exists(scratch.path("none.json"))); // kept only when asked
  const auto json = nlohmann::json::parse(read_file(scratch.path("bench.json")));
  EXPECT_GT(json.at("memory_bytes_per_s").get<double>(), 0);
  EXPECT_GT(json.at("multiply_add_flops_per_s").get<double>(), 0);
  ASSERT_GE(json.at("kernels").size(), 2u);
  for (const auto &kernel : json.at("kernels"))
  {
    EXPECT_GT(kernel.at("per_core_s").get<double>(), 0);
    if (!kernel.contains("bytes"))
      continue;
    // No kernel can beat what it needs at least.
    EXPECT_DOUBLE_EQ(kernel.at("limit_by_memory").get<double>(),
                     json.at("memory_bytes_per_s").get<double>() / kernel.at("bytes").get<double>());
    EXPECT_GT(kernel.at("share_of_limit").get<double>(), 0);
  }
}

TEST(Bench, ComparesWithTheLastKeptResult)
{
  const Scratch     scratch;
  const std::string kept = scratch.path("kept.json");
  const Outcome     first = bench({"--kept", kept, "--keep"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out.find("kept of"), std::string::npos);
  const Outcome second = bench({"--kept", kept, "--keep"});
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_NE(second.out.find("kept of"), std::string::npos) << second.out;
  EXPECT_EQ(nlohmann::json::parse(read_file(kept)).size(), 2u);
}

TEST(Bench, RefusesAFileThatIsNoneOfItsOwn)
{
  const Scratch scratch;
  write_file(scratch.path("notes.txt"), "not a list");
  const Outcome run = bench({"--kept", scratch.path("notes.txt"), "--keep"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("notes.txt"), std::string::npos) << run.err;
  EXPECT_EQ(read_file(scratch.path("notes.txt")), "not a list");
}
