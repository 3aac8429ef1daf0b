// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/search.h"

#include <gtest/gtest.h>

#include <cmath>
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

// Rows of a list thinned out are those of the list of the pairs that stay.
TEST(NeighbourList, DropsPairs)
{
  std::mt19937        random(6);
  std::vector<Box<3>> boxes(80);
  for (auto &box : boxes)
    box = random_box<3>(random, 2.);
  NeighbourList<3> list, whole;
  list.build(boxes, boxes);
  whole.build(boxes, boxes);
  const auto drop = [](std::size_t q, std::uint32_t t) { return t <= q || t % 3 == 0; };
  list.remove_if(drop);
  std::size_t left = 0;
  for (std::size_t q = 0; q < boxes.size(); ++q)
  {
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t t : whole.of(q))
      if (!drop(q, t))
        expected.push_back(t);
    const auto found = list.of(q);
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
    left += expected.size();
  }
  EXPECT_EQ(list.n_pairs(), left);
  EXPECT_GT(left, 20u);
  EXPECT_LT(left, whole.n_pairs() / 2);
}

// Coplanar, repeated and huge boxes, points on the sides of others: what a tree
// of boxes meets in a flat plate whose nodes share their coordinates.
TEST(NeighbourList, EqualsBruteForceOnFlatLattices)
{
  std::vector<Box<3>> lattice, points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
    {
      lattice.emplace_back();
      lattice.back().include({i * .5, j * .5, 0});
      lattice.back().include({i * .5 + .5, j * .5 + .5, 0});
      points.emplace_back();
      points.back().include({i * .5, j * .5, j % 2 ? 0. : .25});
    }
  lattice.push_back(lattice.front());
  lattice.emplace_back();
  lattice.back().include(Point<3>::Constant(-1e9));
  lattice.back().include(Point<3>::Constant(1e9));
  expect_brute_force<3>(points, lattice);
  expect_brute_force<3>(lattice, points);
}

TEST(DisplacementWatch, BoundsWhatComesTogether)
{
  DisplacementWatch<2>    watch;
  std::vector<Point<2>>   points{{.3, 4}, {-2, 1}, {7, 7}};
  constexpr double        never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(watch.approach(points), never); // never set
  watch.set(points, 1);
  EXPECT_EQ(watch.approach(points), 0);
  for (auto &p : points)
    p += Point<2>(100, -30); // all alike
  EXPECT_LT(watch.approach(points), 1e-12);
  // One point alone, by .05: in the frame half way each side has gone .025.
  points[0] += Point<2>(.03, .04);
  EXPECT_NEAR(watch.approach(points), .05, 1e-12);
  EXPECT_EQ(watch.approach(std::span(points).first(2)), never);
  points[2][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(watch.approach(points), never);
}

// It is a bound: no pair across the groups has come closer by more.
TEST(DisplacementWatch, NeverFallsShort)
{
  std::mt19937                           random(8);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int round = 0; round < 300; ++round)
  {
    std::vector<Point<3>> before(9), after;
    for (auto &p : before)
      p = {u(random), u(random), u(random)};
    const Point<3> common(5 * u(random), 5 * u(random), 5 * u(random));
    for (const auto &p : before)
      after.push_back(p + common + .3 * Point<3>(u(random), u(random), u(random)));
    DisplacementWatch<3> watch;
    watch.set(before, 4);
    const double bound = watch.approach(after);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 4; j < 9; ++j)
        ASSERT_LE((before[i] - before[j]).norm() - (after[i] - after[j]).norm(), bound);
    ASSERT_LE(bound, 2 * .3 * 2 * std::sqrt(3.));
  }
}
} // namespace ogive::coupling
