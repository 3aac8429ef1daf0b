// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/halo.h"

#include <gtest/gtest.h>

using ogive::Halo;
using ogive::Ranks;

namespace
{
using Lists = std::vector<std::vector<std::uint32_t>>;

/// A ring of ranks: each has three entries of its own and takes the last of the
/// rank before into entry 3, the first of the rank after into entry 4.
struct Ring
{
  Ranks ranks = Ranks::world();
  Lists give{static_cast<std::size_t>(ranks.size())}, take = give;
  int   before = (ranks.rank() + ranks.size() - 1) % ranks.size(), after = (ranks.rank() + 1) % ranks.size();

  Ring()
  {
    if (ranks.alone())
      return;
    give[after].push_back(2);
    take[before].push_back(3);
    give[before].push_back(0);
    take[after].push_back(4);
  }
};

TEST(Halo, CopiesChosenFieldsOfRecords)
{
  const Ring          ring;
  const Halo          halo(ring.ranks, ring.give, ring.take);
  constexpr int       stride = 4;
  std::vector<double> records(5 * stride, -1.);
  for (int i = 0; i < 3; ++i)
    for (int f = 0; f < stride; ++f)
      records[i * stride + f] = 100 * ring.ranks.rank() + 10 * i + f;
  halo.copy(records.data(), stride, 1, 3);
  if (ring.ranks.alone())
    return;
  const auto lies = [&](int at, int rank, int i) {
    EXPECT_EQ(records[at * stride], -1);
    EXPECT_EQ(records[at * stride + 1], 100 * rank + 10 * i + 1);
    EXPECT_EQ(records[at * stride + 2], 100 * rank + 10 * i + 2);
    EXPECT_EQ(records[at * stride + 3], -1);
  };
  lies(3, ring.before, 2);
  lies(4, ring.after, 0);
  EXPECT_EQ(halo.given(), 2u);
  EXPECT_EQ(halo.neighbours(), ring.before == ring.after ? 1u : 2u);
}

TEST(Halo, CopiesSeveralArraysInOneMessage)
{
  const Ring          ring;
  const Halo          halo(ring.ranks, ring.give, ring.take);
  std::vector<double> a(5, ring.ranks.rank()), b(5, -ring.ranks.rank());
  const auto          messages = ring.ranks.traffic().messages;
  halo.copy(std::vector<double *>{a.data(), b.data()});
  if (ring.ranks.alone())
    return;
  EXPECT_EQ(a[3], ring.before);
  EXPECT_EQ(b[4], -ring.after);
  EXPECT_EQ(ring.ranks.traffic().messages - messages, halo.neighbours());
}

/// Two entries that all ranks share, one that is nobody else's: numbers that do
/// not add exactly give the same bits on all ranks, the sum in the order of ranks.
TEST(Halo, SumsInTheOrderOfRanks)
{
  const Ranks ranks = Ranks::world();
  Lists       others(ranks.size());
  for (int r = 0; r < ranks.size(); ++r)
    if (r != ranks.rank())
      others[r] = {0, 2};
  const Halo halo(ranks, others, others);
  const auto part = [](int rank, int i) { return (i + 1) * (rank % 2 ? 1e16 : .3) / (rank + 3.) * (rank % 3 ? 1 : -1); };
  std::vector<double> field, second;
  for (int i = 0; i < 3; ++i)
  {
    field.push_back(part(ranks.rank(), i));
    second.push_back(2 * part(ranks.rank(), i));
  }
  std::vector<double> records(3 * 2);
  for (int i = 0; i < 3; ++i)
    records[2 * i + 1] = field[i];
  halo.sum(std::vector<double *>{field.data(), second.data()});
  halo.sum(records.data(), 2, 1, 2);
  for (const int i : {0, 2})
  {
    double expected = 0;
    for (int r = 0; r < ranks.size(); ++r)
      expected += part(r, i);
    EXPECT_EQ(field[i], expected);
    EXPECT_EQ(second[i], 2 * expected);
    EXPECT_EQ(records[2 * i + 1], expected);
  }
  EXPECT_EQ(field[1], part(ranks.rank(), 1));
}
} // namespace
