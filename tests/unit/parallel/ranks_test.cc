// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using ogive::Ranks;

namespace
{
TEST(Ranks, AloneAnswersForItself)
{
  const Ranks alone;
  EXPECT_EQ(alone.size(), 1);
  EXPECT_EQ(alone.rank(), 0);
  EXPECT_EQ(alone.sum(3.5), 3.5);
  EXPECT_EQ(alone.least(-2.).value, -2.);
  EXPECT_EQ(alone.before(std::int64_t(7)), 0);
  EXPECT_EQ(alone.gather(std::vector<int>{1, 2}), (std::vector<int>{1, 2}));
  EXPECT_EQ(alone.swap(std::vector<std::vector<int>>{{4, 5}}), (std::vector<std::vector<int>>{{4, 5}}));
}

TEST(Ranks, SumsMinimaAndMaxima)
{
  const Ranks ranks = Ranks::world();
  const int   n = ranks.size(), r = ranks.rank();
  EXPECT_EQ(ranks.sum(double(r + 1)), .5 * n * (n + 1));
  EXPECT_EQ(ranks.sum(std::int64_t(r)), n * (n - 1) / 2);
  EXPECT_EQ(ranks.min(double(r)), 0);
  EXPECT_EQ(ranks.max(double(r)), n - 1);
  EXPECT_EQ(ranks.max(std::int64_t(-r)), 0);
  EXPECT_TRUE(ranks.any(r == n - 1));
  EXPECT_EQ(ranks.all(r == n - 1), n == 1);
  EXPECT_EQ(ranks.before(std::int64_t(r + 1)), r * (r + 1) / 2);
  const auto least = ranks.least(std::abs(r - (n - 1) / 2) - 1.);
  EXPECT_EQ(least.value, -1);
  EXPECT_EQ(least.rank, (n - 1) / 2);
}

/// A long and a short vector of numbers that do not add exactly: all ranks end
/// with the same bits, near the sum in another order.
TEST(Ranks, SumsHaveTheSameBitsEverywhere)
{
  const Ranks ranks = Ranks::world();
  for (const std::size_t size : {3u, 5000u})
  {
    std::mt19937                           random(11 + ranks.rank());
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double>                    own(size);
    for (double &x : own)
      x = uniform(random) * std::exp(20 * uniform(random));
    const std::vector<double> each = ranks.gather(own);
    std::vector<double>       sum  = own;
    ranks.sum(std::span<double>(sum));
    const std::vector<double> sums = ranks.gather(sum);
    for (std::size_t k = 0; k < sums.size(); ++k)
      ASSERT_EQ(sums[k], sum[k % size]);
    for (std::size_t k = 0; k < size; ++k)
    {
      double expected = 0, scale = 0;
      for (int r = 0; r < ranks.size(); ++r)
      {
        expected += each[r * size + k];
        scale += std::abs(each[r * size + k]);
      }
      ASSERT_NEAR(sum[k], expected, 1e-15 * ranks.size() * scale);
    }
  }
}

TEST(Ranks, GathersInTheirOrder)
{
  const Ranks              ranks = Ranks::world();
  std::vector<int>         own(ranks.rank(), ranks.rank()); // the first has none
  std::vector<std::size_t> first;
  const auto               all = ranks.gather(own, &first);
  ASSERT_EQ(first.size(), ranks.size() + 1u);
  for (int r = 0; r < ranks.size(); ++r)
    for (std::size_t k = first[r]; k < first[r + 1]; ++k)
      EXPECT_EQ(all[k], r);
  EXPECT_EQ(all.size(), static_cast<std::size_t>(ranks.size() * (ranks.size() - 1) / 2));
}

TEST(Ranks, SwapsAndBroadcasts)
{
  const Ranks                           ranks = Ranks::world();
  std::vector<std::vector<std::int64_t>> to(ranks.size());
  for (int r = 0; r < ranks.size(); ++r)
    to[r].assign((r + ranks.rank()) % 3, 100 * ranks.rank() + r);
  const auto from = ranks.swap(to);
  ASSERT_EQ(from.size(), to.size());
  for (int r = 0; r < ranks.size(); ++r)
    EXPECT_EQ(from[r], std::vector<std::int64_t>((r + ranks.rank()) % 3, 100 * r + ranks.rank()));
  std::vector<double> values(4, ranks.rank());
  ranks.broadcast(std::span<double>(values), ranks.size() - 1);
  EXPECT_EQ(values, std::vector<double>(4, ranks.size() - 1));
}
} // namespace
