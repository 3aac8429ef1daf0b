// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/run_directory.h"

#include "core/base/error.h"
#include "tests/unit/io/scratch.h"

namespace
{
using namespace ogive;
using io::RunDirectory;
using ogive::test::bytes_of;
using ogive::test::expect_parts;
using ogive::test::message_of;
using ogive::test::write_bytes;

using Directory = ogive::test::Scratch;

TEST_F(Directory, IsMadeWithAllAboveIt)
{
  const RunDirectory run = RunDirectory::create(in("a/b/c"), false);
  EXPECT_TRUE(std::filesystem::is_directory(in("a/b/c")));
  EXPECT_EQ(run.summary(), in("a/b/c") + "/summary.json");
}

TEST_F(Directory, KeepsResultsUnlessForced)
{
  RunDirectory run = RunDirectory::create(in("run"), false);
  RunDirectory::create(in("run"), false); // still empty
  write_bytes(in("run/notes.txt"), "mine");
  RunDirectory::create(in("run"), false); // not results

  for (const std::string &name : {run.summary(), run.history(), run.checkpoint(12), run.resolved_scene(), in("run/results.h5"), in("run/results.xdmf.part")})
    {
      write_bytes(name, "kept");
      expect_parts(message_of<InputError>([&] { RunDirectory::create(in("run"), false); }), {"run", "holds the results", "--force", "-o DIR"});
      EXPECT_EQ(bytes_of(name), "kept");
      RunDirectory::create(in("run"), true);
      EXPECT_FALSE(std::filesystem::exists(name));
    }
  EXPECT_EQ(bytes_of(in("run/notes.txt")), "mine");
}

TEST_F(Directory, APlaceThatCannotBeWrittenIsNamed)
{
  write_bytes(in("file"), "");
  // Below a file and in the kernel's own tree not even root can make one.
  for (const std::string &path : {in("file"), in("file/run"), std::string("/proc/ogive/run")})
    expect_parts(message_of<InputError>([&] { RunDirectory::create(path, true); }), {path.c_str(), "cannot write", "expected a directory", "-o DIR"});
}

TEST_F(Directory, TakesTheFirstFreeNumber)
{
  EXPECT_EQ(RunDirectory::default_name("bar", directory()), in("bar-1"));
  RunDirectory::create(in("bar-1"), false);
  RunDirectory::create(in("bar-3"), false);
  EXPECT_EQ(RunDirectory::default_name("bar", directory()), in("bar-2"));
  EXPECT_EQ(RunDirectory::default_name("bar"), "results/bar-1");
}

TEST_F(Directory, FindsTheLastCheckpoint)
{
  RunDirectory run = RunDirectory::create(in("run"), false);
  expect_parts(message_of<InputError>([&] { run.last_checkpoint(); }), {"run", "no checkpoint"});
  for (const std::int64_t step : {99999, 1000000, 7})
    write_bytes(run.checkpoint(step), "");
  write_bytes(run.checkpoint(2000000) + ".part", "");
  EXPECT_EQ(run.checkpoints().size(), 3u);
  EXPECT_EQ(run.last_checkpoint(), run.checkpoint(1000000));
}

TEST_F(Directory, OpensOnlyARun)
{
  expect_parts(message_of<InputError>([&] { RunDirectory::open(in("none")); }), {"none", "no such directory"});
  expect_parts(message_of<InputError>([&] { RunDirectory::open(directory()); }), {"holds no results"});
  write_bytes(in("history.csv"), "");
  EXPECT_EQ(RunDirectory::open(directory()).path(), directory());
}
} // namespace
