// SPDX-License-Identifier: LGPL-2.1-or-later
// Oracle: all pairs, one by one.
#include "core/base/simd.h"
#include "sph/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
using namespace ogive;
using namespace ogive::sph;

template <int dim>
void compare(std::mt19937 &random, std::size_t n, std::size_t ghosts, double radius, double stretch)
{
  std::array<std::vector<double>, dim>     x;
  std::array<std::span<const double>, dim> view;
  std::uniform_real_distribution<double>   place(-1.7, 2.9);
  for (int a = 0; a < dim; ++a)
  {
    for (std::size_t i = 0; i < n + ghosts; ++i)
      x[a].push_back(place(random) * (a == 0 ? stretch : 1));
    view[a] = x[a];
  }
  NeighbourRows       rows;
  const std::uint32_t dummy = static_cast<std::uint32_t>(n + ghosts);
  append_rows<dim>(view, 0, n, n, n + ghosts, radius, dummy, rows);
  ASSERT_EQ(rows.row.size(), n + 1);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t j = 0; j < n + ghosts; ++j)
    {
      double r2 = 0;
      for (int a = 0; a < dim; ++a)
        r2 += (x[a][i] - x[a][j]) * (x[a][i] - x[a][j]);
      if (j != i && r2 < radius * radius)
        expected.push_back(j);
    }
    ASSERT_EQ((rows.row[i + 1] - rows.row[i]) % simd_width, 0u);
    for (std::size_t p = rows.row[i]; p < rows.row[i + 1]; ++p)
      if (rows.index[p] != dummy)
        found.push_back(rows.index[p]);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
    pairs += expected.size();
  }
  EXPECT_EQ(rows.pairs, pairs);
}

TEST(Neighbours, EqualBruteForceOnRandomClouds)
{
  std::mt19937 random(2024);
  for (int k = 0; k < 1000; ++k)
  {
    const std::size_t n       = k % 50 == 0 ? 0 : k % 50 == 1 ? 1 : random() % 90;
    const std::size_t ghosts  = random() % 20;
    const double      radius  = .02 + .002 * (random() % 700);
    const double      stretch = k % 7 == 0 ? 1e4 : 1; // fragments far apart
    compare<1>(random, n, ghosts, radius, stretch);
    compare<2>(random, n, ghosts, radius, stretch);
    compare<3>(random, n, ghosts, radius, stretch);
    if (HasFatalFailure())
      FAIL() << "cloud " << k;
  }
}

TEST(Neighbours, CoincidentPointsSeeEachOther)
{
  const std::vector<double>                x{.5, .5, .5};
  std::array<std::span<const double>, 2>   view{x, x};
  NeighbourRows                            rows;
  append_rows<2>(view, 0, 3, 3, 3, .1, 3, rows);
  EXPECT_EQ(rows.pairs, 6u);
}

TEST(MortonOrder, IsAPermutationThatKeepsCellsTogether)
{
  std::mt19937                             random(5);
  std::uniform_real_distribution<double>   place(0, 4);
  std::array<std::vector<double>, 3>       x;
  std::vector<std::int64_t>                id;
  for (int i = 0; i < 500; ++i)
  {
    for (auto &a : x)
      a.push_back(place(random));
    id.push_back(i);
  }
  const auto order = morton_order<3>({x[0], x[1], x[2]}, 0, 500, 1., id);
  auto       sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t i = 0; i < 500; ++i)
    ASSERT_EQ(sorted[i], i);
  // Each of the at most 64 cells is one run.
  double lower[3];
  for (int a = 0; a < 3; ++a)
    lower[a] = *std::min_element(x[a].begin(), x[a].end());
  int runs = 0, last = -1;
  for (const auto i : order)
  {
    int cell = 0;
    for (int a = 0; a < 3; ++a)
      cell = cell * 8 + static_cast<int>(x[a][i] - lower[a]);
    runs += cell != last;
    last = cell;
  }
  EXPECT_LE(runs, 64);
}
} // namespace
