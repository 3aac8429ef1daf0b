// SPDX-License-Identifier: LGPL-2.1-or-later
// A checkpoint that ranks write together holds what one process would have put
// into it: the oracle is the whole array, made without ranks.
#include "core/io/hdf5_archive.h"
#include "core/io/hdf5_file.h"
#include "core/io/memory_archive.h"
#include "core/parallel/together.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace ogive;
using namespace ogive::io;
namespace fs = std::filesystem;

namespace
{
/// One directory for all ranks, gone with the object.
class SharedScratch
{
public:
  SharedScratch()
    : path_(told_by_first(ranks_, [] {
      std::string name = (fs::temp_directory_path() / "ogive-ranks-XXXXXX").string();
      return mkdtemp(name.data()) ? name : std::string();
    }))
  {}
  ~SharedScratch()
  {
    ranks_.any(false); // all are done with it
    if (ranks_.first())
      fs::remove_all(path_);
  }
  std::string file(const std::string &name) const { return path_ + "/" + name; }

private:
  Ranks       ranks_ = Ranks::world();
  std::string path_;
};

/// Rank r has 5 r values: the first one none.
std::size_t share(int rank)
{
  return 5 * static_cast<std::size_t>(rank);
}
double value(std::size_t k)
{
  return std::sin(1. + static_cast<double>(k)) / 3;
}

template <class T>
struct Values
{
  std::vector<T> own, whole;
};
template <class T>
Values<T> values(const Ranks &ranks)
{
  Values<T> v;
  for (int r = 0; r < ranks.size(); ++r)
    for (std::size_t i = 0; i < share(r); ++i)
    {
      v.whole.push_back(static_cast<T>(1e6 * value(v.whole.size())));
      if (r == ranks.rank())
        v.own.push_back(v.whole.back());
    }
  return v;
}

template <class Archive>
void fill(Archive &archive, const Ranks &ranks)
{
  archive.write_parts(ranks, "sph/x", values<double>(ranks).own);
  archive.write_parts(ranks, "sph/id", values<std::int64_t>(ranks).own);
  archive.write_parts(ranks, "sph/none", std::span<const double>());
  archive.write("clock/step", std::int64_t(7));
  archive.write("clock/time", 1. / 3);
}

template <class Archive>
void expect_filled(const Archive &archive, const Ranks &ranks)
{
  EXPECT_EQ(archive.doubles("sph/x"), values<double>(ranks).whole);
  EXPECT_EQ(archive.integers("sph/id"), values<std::int64_t>(ranks).whole);
  EXPECT_TRUE(archive.doubles("sph/none").empty());
  EXPECT_EQ(archive.integer("clock/step"), 7);
  EXPECT_EQ(archive.number("clock/time"), 1. / 3);
}
} // namespace

TEST(RankedArchive, PartsComeBackWholeOnEachRank)
{
  const Ranks         ranks = Ranks::world();
  const SharedScratch scratch;
  Hdf5ArchiveWriter   writer(scratch.file("checkpoint-1.h5"), ranks);
  fill(writer, ranks);
  writer.write_text("scene", "text of the scene");
  EXPECT_FALSE(fs::exists(scratch.file("checkpoint-1.h5"))) << "no name before commit()";
  writer.commit();

  const Hdf5ArchiveReader reader(scratch.file("checkpoint-1.h5"));
  expect_filled(reader, ranks);
  EXPECT_EQ(reader.text("scene"), "text of the scene");
}

// An archive that knows nothing of ranks.
TEST(RankedArchive, MemoryHoldsTheSame)
{
  const Ranks   ranks = Ranks::world();
  MemoryArchive archive;
  fill(archive, ranks);
  expect_filled(archive, ranks);
}

TEST(RankedArchive, LeavesNothingWithoutCommit)
{
  const Ranks         ranks = Ranks::world();
  const SharedScratch scratch;
  {
    Hdf5ArchiveWriter writer(scratch.file("checkpoint-2.h5"), ranks);
    fill(writer, ranks);
  }
  ranks.any(false);
  EXPECT_FALSE(fs::exists(scratch.file("checkpoint-2.h5")));
  EXPECT_FALSE(fs::exists(scratch.file("checkpoint-2.h5.part")));
}

TEST(RankedArchive, NoPlaceIsAnErrorOnAll)
{
  EXPECT_THROW(Hdf5ArchiveWriter("/nowhere/at/all/checkpoint.h5", Ranks::world()), RunError);
}

// Rows of three, in single precision, and tables of whole numbers: what fields need.
TEST(RankedFile, RowsOfAllRanksFormOneTable)
{
  const Ranks         ranks = Ranks::world();
  const SharedScratch scratch;
  const int           n = ranks.rank() + 1; // rows here
  std::vector<double> rows;
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c)
      rows.push_back(.5 * ranks.rank() + i + 100 * c);
  hdf5::File file(scratch.file("r.h5"), ranks);
  file.write_parts("a/points", rows, 3, true);
  file.write_parts("a/cells", std::vector<std::uint32_t>(2 * static_cast<std::size_t>(n), 4u), 2);
  file.close();

  std::vector<double>       all = ranks.gather(rows), points;
  std::vector<std::int64_t> cells;
  const hdf5::File          again(scratch.file("r.h5"), hdf5::File::Mode::read);
  ASSERT_TRUE(again.read("a/points", points));
  ASSERT_TRUE(again.read("a/cells", cells));
  EXPECT_EQ(points, all); // halves of small numbers: exact in single precision
  EXPECT_EQ(cells, std::vector<std::int64_t>(all.size() / 3 * 2, 4));
}
