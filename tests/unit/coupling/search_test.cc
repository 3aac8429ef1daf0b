// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/search.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ogive::coupling
{
namespace
{
template <int dim>
Box<dim> random_box(std::mt19937 &random, double largest)
{
  std::uniform_real_distribution<double> place(-3, 3), size(0, largest);
  Box<dim>                               box;
  for (int corner = 0; corner < 2; ++corner)
  {
    Point<dim> p;
    for (int a = 0; a < dim; ++a)
      p[a] = corner == 0 ? place(random) : box.lower[a] + size(random);
    box.include(p);
  }
  return box;
}

template <int dim>
void expect_brute_force(const std::vector<Box<dim>> &queries, const std::vector<Box<dim>> &targets)
{
  NeighbourList<dim> list;
  list.build(queries, targets);
  ASSERT_EQ(list.n_queries(), queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q)
  {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < targets.size(); ++t)
      if (queries[q].meets(targets[t]))
        expected.push_back(t);
    const auto found = list.of(q);
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
  }
}

template <int dim>
void random_clouds()
{
  std::mt19937                       random(20 + dim);
  std::uniform_int_distribution<int> count(0, 60);
  std::size_t                        pairs = 0;
  for (int cloud = 0; cloud < 200; ++cloud)
  {
    std::vector<Box<dim>> queries(count(random)), targets(count(random));
    for (auto &box : queries)
      box = random_box<dim>(random, 1.);
    for (auto &box : targets)
      box = random_box<dim>(random, cloud % 2 ? 0. : 2.); // points and boxes
    expect_brute_force<dim>(queries, targets);
    NeighbourList<dim> list;
    list.build(queries, targets);
    pairs += list.n_pairs();
  }
  EXPECT_GT(pairs, 1000u);
}
} // namespace

TEST(NeighbourList, EqualsBruteForceOnRandomClouds)
{
  random_clouds<1>();
  random_clouds<2>();
  random_clouds<3>();
}

TEST(NeighbourList, EmptyAndSingle)
{
  std::mt19937          random(3);
  std::vector<Box<3>>   none, one{random_box<3>(random, 1.)};
  expect_brute_force<3>(none, none);
  expect_brute_force<3>(none, one);
  expect_brute_force<3>(one, none);
  expect_brute_force<3>(one, one);
}

TEST(NeighbourList, CoincidentBoxesAreAllFound)
{
  std::mt19937          random(4);
  std::vector<Box<2>>   same(100, random_box<2>(random, .5));
  NeighbourList<2>      list;
  list.build(same, same);
  EXPECT_EQ(list.n_pairs(), 10000u);
}

TEST(NeighbourList, TouchingBoxesMeet)
{
  Box<2> left, right;
  left.include({0, 0});
  left.include({1.5, 2});
  right.include({1.5, 2});
  right.include({3, 5});
  NeighbourList<2> list;
  list.build(std::vector<Box<2>>{left}, std::vector<Box<2>>{right});
  EXPECT_EQ(list.n_pairs(), 1u);
}

TEST(NeighbourList, BoxWithoutPlaceMeetsNothing)
{
  const double          nan = std::numeric_limits<double>::quiet_NaN();
  std::mt19937          random(5);
  std::vector<Box<3>>   boxes(5, random_box<3>(random, 1.));
  boxes[2].lower[1] = nan;
  boxes[3]          = Box<3>(); // includes no point
  NeighbourList<3> list;
  list.build(boxes, boxes);
  EXPECT_EQ(list.of(2).size(), 0u);
  EXPECT_EQ(list.of(3).size(), 0u);
  EXPECT_EQ(list.of(0).size(), 3u);
}

TEST(DisplacementWatch, SeesMotionBeyondTheMarginAndNaN)
{
  DisplacementWatch<2>       watch;
  std::vector<Point<2>>      points{{.3, 4}, {-2, 1}};
  EXPECT_TRUE(watch.exceeded(points, 1e9)); // never set
  watch.set(points);
  points[1] += Point<2>(.03, .04);
  EXPECT_FALSE(watch.exceeded(points, .0501));
  EXPECT_TRUE(watch.exceeded(points, .0499));
  points[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(watch.exceeded(points, 1e9));
}
} // namespace ogive::coupling
