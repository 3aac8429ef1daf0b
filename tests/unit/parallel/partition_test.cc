// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using ogive::Partition;
using ogive::Ranks;

namespace
{
/// Random points with weights, the same on all ranks; each holds every size-th.
template <int dim>
struct Cloud
{
  std::array<std::vector<double>, dim> all, own;
  std::vector<double>                  all_weights, weights;

  Cloud(const Ranks &ranks, std::size_t n)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t k = 0; k < n; ++k)
    {
      const bool mine = static_cast<int>(k % ranks.size()) == ranks.rank();
      for (int a = 0; a < dim; ++a)
      {
        const double x = std::pow(uniform(random), 1 + a); // denser near the planes x_a = 0
        all[a].push_back(x);
        if (mine)
          own[a].push_back(x);
      }
      all_weights.push_back(uniform(random) < .1 ? 7. : 1.);
      if (mine)
        weights.push_back(all_weights.back());
    }
  }
  std::array<std::span<const double>, dim> view() const
  {
    std::array<std::span<const double>, dim> v;
    for (int a = 0; a < dim; ++a)
      v[a] = own[a];
    return v;
  }
};

template <int dim>
void cut_and_check()
{
  const Ranks      ranks = Ranks::world();
  const Cloud<dim> cloud(ranks, 4000);
  Partition<dim>   partition(ranks);
  const auto       rank = partition.cut(cloud.view(), cloud.weights);
  ASSERT_EQ(rank.size(), cloud.weights.size());

  // Everyone agrees whose each point is, and so does the cut.
  std::vector<double> work(ranks.size());
  std::vector<int>    owner;
  for (std::size_t k = 0; k < cloud.all_weights.size(); ++k)
  {
    std::array<double, dim> x;
    for (int a = 0; a < dim; ++a)
      x[a] = cloud.all[a][k];
    owner.push_back(partition.at(x));
    ASSERT_GE(owner.back(), 0);
    ASSERT_LT(owner.back(), ranks.size());
    work[owner.back()] += cloud.all_weights[k];
    if (static_cast<int>(k % ranks.size()) == ranks.rank())
    {
      EXPECT_EQ(rank[k / ranks.size()], owner.back());
    }
  }
  // No cut is farther from even than one point's weight; there are log2(ranks) of them.
  const double mean = std::accumulate(work.begin(), work.end(), 0.) / ranks.size();
  EXPECT_LT(*std::max_element(work.begin(), work.end()), mean + 7 * (1 + std::log2(ranks.size())));
  const std::vector<int> everyone = ranks.gather(owner);
  for (std::size_t k = 0; k < everyone.size(); ++k)
    ASSERT_EQ(everyone[k], owner[k % owner.size()]);

  // A box meets the owners of all points in it.
  std::mt19937                           random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 50; ++trial)
  {
    std::array<double, dim> lower, upper;
    for (int a = 0; a < dim; ++a)
    {
      lower[a] = uniform(random);
      upper[a] = lower[a] + .2 * uniform(random);
    }
    std::vector<int> met;
    partition.meets(lower, upper, met);
    EXPECT_TRUE(std::is_sorted(met.begin(), met.end()));
    for (std::size_t k = 0; k < owner.size(); ++k)
    {
      bool inside = true;
      for (int a = 0; a < dim; ++a)
        inside = inside && cloud.all[a][k] >= lower[a] && cloud.all[a][k] <= upper[a];
      EXPECT_TRUE(!inside || std::binary_search(met.begin(), met.end(), owner[k]));
    }
  }
}

TEST(Partition, IsEvenAndAgreedOnALine)
{
  cut_and_check<1>();
}
TEST(Partition, IsEvenAndAgreedInAPlane)
{
  cut_and_check<2>();
}
TEST(Partition, IsEvenAndAgreedInSpace)
{
  cut_and_check<3>();
}

TEST(Partition, FewerPointsThanRanks)
{
  const Ranks         ranks = Ranks::world();
  std::vector<double> x, weight;
  if (ranks.first())
  {
    x      = {.25, .75};
    weight = {1, 1};
  }
  Partition<1> partition(ranks);
  const auto   rank = partition.cut({std::span<const double>(x)}, weight);
  for (std::size_t k = 0; k < rank.size(); ++k)
    EXPECT_EQ(rank[k], partition.at({x[k]}));
  if (ranks.first())
  {
    EXPECT_EQ(rank[0] == rank[1], ranks.alone());
  }
}

/// Layers of a lattice: a cut lies between two of them.
TEST(Partition, PartsALatticeBetweenItsLayers)
{
  const Ranks         ranks = Ranks::world();
  std::vector<double> x, y, weight;
  for (int i = 0; i < 84; ++i)
    for (int j = 0; j < 20; ++j)
      if (i % ranks.size() == ranks.rank())
      {
        x.push_back(.1 * i);
        y.push_back(.1 * j);
        weight.push_back(1);
      }
  Partition<2> partition(ranks);
  const auto   rank = partition.cut({std::span<const double>(x), std::span<const double>(y)}, weight);
  std::vector<double> work(ranks.size());
  for (const int r : rank)
    ++work[r];
  ranks.sum(std::span<double>(work));
  for (const double w : work) // 1680 points; a cut misses its share by half a layer at most
    EXPECT_NEAR(w, 1680. / ranks.size(), 30);
}
} // namespace
