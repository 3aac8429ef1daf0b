// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/hdf5_archive.h"

#include "core/base/error.h"
#include "core/io/hdf5_file.h"
#include "core/io/memory_archive.h"
#include "tests/unit/io/scratch.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace
{
using namespace ogive;
using namespace ogive::io;
using ogive::test::bytes_of;
using ogive::test::expect_parts;
using ogive::test::message_of;
using ogive::test::write_bytes;

using Archive = ogive::test::Scratch;

std::vector<double> some_numbers()
{
  std::mt19937_64     random(20);
  std::vector<double> values{0., -0., 5e-324, -std::numeric_limits<double>::max(), INFINITY, std::nan("7"), 1. / 3};
  for (int i = 0; i < 1000; ++i)
    values.push_back(std::bit_cast<double>(random()));
  return values;
}

void write_example(ArchiveWriter &out)
{
  out.write("sph/x0", some_numbers());
  out.write("sph/id", std::vector<std::int64_t>{-1, 0, std::numeric_limits<std::int64_t>::min()});
  out.write("sph/none", std::span<const double>{});
  out.write("clock/time", 3.7e-5);
  out.write("clock/step", std::int64_t{1} << 60);
}

void expect_example(const ArchiveReader &in)
{
  const std::vector<double> expected = some_numbers(), read = in.doubles("sph/x0");
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(expected[i])) << i;
  EXPECT_EQ(in.integers("sph/id"), (std::vector<std::int64_t>{-1, 0, std::numeric_limits<std::int64_t>::min()}));
  EXPECT_TRUE(in.doubles("sph/none").empty());
  EXPECT_EQ(in.number("clock/time"), 3.7e-5);
  EXPECT_EQ(in.integer("clock/step"), std::int64_t{1} << 60);
}

void write_file(const std::string &path)
{
  Hdf5ArchiveWriter out(path);
  write_example(out);
  out.write_text("scene", "set Title = \"Schlag, Stoß\"\n");
  out.write_text("empty", "");
  out.commit();
}

TEST_F(Archive, ComesBackToTheBit)
{
  write_file(in("checkpoint-1.h5"));
  const Hdf5ArchiveReader file(in("checkpoint-1.h5"));
  expect_example(file);
  EXPECT_EQ(file.text("scene"), "set Title = \"Schlag, Stoß\"\n");
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_TRUE(file.contains("sph/x0"));
  EXPECT_FALSE(file.contains("sph/x1"));
  EXPECT_FALSE(file.contains("fem/x0"));

  MemoryArchive memory;
  write_example(memory);
  expect_example(memory);
}

// Restarted and unbroken runs are compared by their last checkpoints.
TEST_F(Archive, EqualContentsGiveEqualBytes)
{
  write_file(in("a.h5"));
  ::sleep(1); // time stamps have a resolution of one second
  write_file(in("b.h5"));
  EXPECT_GT(bytes_of(in("a.h5")).size(), 8000u);
  EXPECT_EQ(bytes_of(in("a.h5")), bytes_of(in("b.h5")));
}

TEST_F(Archive, AppearsOnlyWhenWhole)
{
  {
    Hdf5ArchiveWriter out(in("checkpoint-1.h5"));
    write_example(out);
    EXPECT_FALSE(std::filesystem::exists(in("checkpoint-1.h5")));
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory()));
  write_file(in("checkpoint-1.h5"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory()), {}), 1);
}

TEST_F(Archive, AnAbandonedWriterLeavesTheOldFile)
{
  write_file(in("checkpoint-1.h5"));
  const std::string before = bytes_of(in("checkpoint-1.h5"));
  {
    Hdf5ArchiveWriter out(in("checkpoint-1.h5"));
    out.write("clock/time", 1.);
  }
  EXPECT_EQ(bytes_of(in("checkpoint-1.h5")), before);
}

TEST_F(Archive, ATruncatedFileIsRefusedWhereverItIsCut)
{
  write_file(in("whole.h5"));
  const std::string whole = bytes_of(in("whole.h5"));
  const std::string path  = in("cut.h5");
  for (const double share : {0., .001, .01, .1, .3, .5, .7, .9, .99})
    {
      write_bytes(path, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
      expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{path}; }), {"cut.h5", "cut short", "expected"});
    }
  write_bytes(path, whole.substr(0, whole.size() - 1));
  expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{path}; }), {"cut.h5", "cut short", "expected"});
}

TEST_F(Archive, AnotherVersionIsRefused)
{
  {
    hdf5::File file(in("old.h5"), hdf5::File::Mode::create);
    file.write_text("format", "ogive checkpoint");
    file.write("format_version", std::vector<std::int64_t>{checkpoint_version + 6});
    file.close();
  }
  expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{in("old.h5")}; }),
               {"old.h5", "version 7", "expected format version 1"});
}

TEST_F(Archive, WhatIsNoCheckpointIsRefused)
{
  {
    hdf5::File file(in("results.h5"), hdf5::File::Mode::create);
    file.write("points", std::vector<double>{1, 2, 3});
    file.close();
  }
  expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{in("results.h5")}; }),
               {"results.h5", "not a checkpoint", "expected"});
  expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{in("none.h5")}; }),
               {"none.h5", "no such checkpoint", "expected"});
  expect_parts(message_of<InputError>([&] { Hdf5ArchiveReader{directory()}; }), {"no such checkpoint"});
}

TEST_F(Archive, AMissingOrMistakenNameIsNamed)
{
  write_file(in("c.h5"));
  const Hdf5ArchiveReader file(in("c.h5"));
  expect_parts(message_of<InputError>([&] { file.doubles("fem/x0"); }), {"c.h5", "\"fem/x0\"", "missing", "real numbers"});
  expect_parts(message_of<InputError>([&] { file.integers("sph/x0"); }), {"c.h5", "\"sph/x0\"", "another kind", "whole numbers"});
  expect_parts(message_of<InputError>([&] { file.text("sph"); }), {"c.h5", "\"sph\"", "text"});
  expect_parts(message_of<InputError>([&] { MemoryArchive().doubles("a"); }), {"\"a\"", "missing"});
}

TEST_F(Archive, AnUnwritablePlaceIsARunError)
{
  expect_parts(message_of<RunError>([&] { Hdf5ArchiveWriter{in("none/checkpoint.h5")}; }),
               {"none/checkpoint.h5", "writable"});
}
} // namespace
