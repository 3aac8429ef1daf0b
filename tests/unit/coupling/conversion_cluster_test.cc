// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/conversion_cluster.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

/// Particles made of elements by hand. What must be conserved is exact, so the
/// bars are rounding; other numbers are worked out beside the tests.
namespace ogive::coupling
{
namespace
{
/// A brick grid of n elements along each axis, edge 1 m from the origin (r from
/// 1 m in axial symmetry), density 1: corners moved by `shake` of the edge, all
/// of them turning at rate w about (.3, -.2, .1) with a speed on top. Lumped
/// mass: a quarter or an eighth of the undistorted element to each corner.
template <int dim>
std::vector<fem::Departure<dim>> grid(int n, double shake, double w, bool axisymmetric)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(-shake, shake);
  const int                              points = static_cast<int>(std::lround(std::pow(n + 1, dim)));
  std::vector<std::array<double, dim>>   x0(points), x(points), v(points);
  for (int p = 0; p < points; ++p)
  {
    Vec3 at = Vec3::Zero();
    for (int i = 0, k = p; i < dim; ++i, k /= n + 1)
    {
      x0[p][i] = k % (n + 1) + (axisymmetric && i == 0 ? 1 : 0);
      at[i] = x[p][i] = x0[p][i] + uniform(random);
    }
    const Vec3 axis = dim == 3 ? Vec3(.2, -.5, 1).normalized() : Vec3(Vec3::UnitZ());
    const Vec3 speed = Vec3(3, 5, -2) + w * axis.cross(at - Vec3(.3, -.2, .1));
    for (int i = 0; i < dim; ++i)
      v[p][i] = speed[i];
  }
  std::vector<fem::Departure<dim>> elements;
  for (int e = 0; e < std::lround(std::pow(n, dim)); ++e)
  {
    fem::Departure<dim> d;
    constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int a = 0; a < d.corners; ++a)
    {
      int p = 0, stride = 1;
      for (int i = 0, k = e; i < dim; ++i, k /= n, stride *= n + 1)
        p += (k % n + corner[a][i]) * stride;
      d.x0[a] = x0[p], d.x[a] = x[p], d.v[a] = v[p];
      d.mass[a] = 1. / d.corners * (axisymmetric ? 2 * std::numbers::pi * x0[p][0] : 1);
    }
    d.internal     = 3;
    d.plastic_work = 2;
    elements.push_back(d);
  }
  return elements;
}

template <int dim>
materials::Points states(const std::vector<fem::Departure<dim>> &elements)
{
  materials::Points points;
  points.resize(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    double mass = 0;
    for (const double m : elements[e].mass)
      mass += m;
    points.density[e]      = 1;
    points.energy[e]       = elements[e].internal / mass;
    points.plastic_work[e] = elements[e].plastic_work / mass;
    points.damage[e]       = .01 * static_cast<double>(e);
    points.temperature[e]  = 300 + static_cast<double>(e);
    points.sigma[4][e]     = 7. + static_cast<double>(e);
  }
  return points;
}

template <int dim>
struct Made
{
  sph::Newcomers<dim> particles;
  ConversionSums      before, after;
  double              turn = 0;
};

template <int dim>
Made<dim> make(const std::vector<fem::Departure<dim>> &elements, int n, bool axisymmetric)
{
  Made<dim> made;
  auto      points = states(elements);
  for (std::size_t e = 0; e < elements.size(); ++e)
    add_particles<dim>(elements[e], lattice_of(elements[e], 1. / n), points, e, axisymmetric, made.particles);
  made.before = sums_of<dim>(elements, points, axisymmetric);
  made.turn   = repair_momenta(made.before, axisymmetric, made.particles, 0);
  made.after  = sums_of(made.particles, 0, axisymmetric);
  return made;
}

void expect_kept(const ConversionSums &before, const ConversionSums &after)
{
  EXPECT_NEAR(after.mass, before.mass, 1e-14 * before.mass);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm());
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), 1e-12 * before.angular_momentum.norm());
  EXPECT_NEAR(after.internal, before.internal, 1e-13 * before.internal);
  EXPECT_NEAR(after.plastic_work, before.plastic_work, 1e-13 * before.plastic_work);
  EXPECT_NEAR(after.damage, before.damage, 1e-13);
  EXPECT_NEAR(after.temperature, before.temperature, 1e-10);
}
} // namespace

template <int dim>
void expect_all_kept(bool axisymmetric)
{
  for (const int n : {1, 2, 3})
    for (const double shake : {0., .25})
    {
      SCOPED_TRACE(std::to_string(n) + " an edge, shaken by " + std::to_string(shake));
      const auto made = make(grid<dim>(3, shake, axisymmetric ? 0 : 4, axisymmetric), n, axisymmetric);
      EXPECT_EQ(made.particles.size(), static_cast<std::size_t>(std::lround(std::pow(3 * n, dim))));
      expect_kept(made.before, made.after);
    }
}

TEST(ConversionCluster, KeepsMassMomentaAndStateInThePlane) { expect_all_kept<2>(false); }
TEST(ConversionCluster, KeepsMassMomentaAndStateInAxialSymmetry) { expect_all_kept<2>(true); }
TEST(ConversionCluster, KeepsMassMomentaAndStateInSpace) { expect_all_kept<3>(false); }

// One square, two particles an edge: corners at a distance^2 of 1/2 from the
// centre, particles of 1/8, so the turn that gives the same angular momentum is
// four times the spin, three times on top. Four squares: 1/2 + 1/2 against
// 1/2 + 1/8.
TEST(ConversionCluster, TurnsByTheInertiaThatIsMissing)
{
  const double w = 4;
  EXPECT_NEAR(make(grid<2>(1, 0, w, false), 2, false).turn, 3 * w, 1e-12);
  EXPECT_NEAR(make(grid<2>(2, 0, w, false), 2, false).turn, (1 / .625 - 1) * w, 1e-12);
  EXPECT_NEAR(inertia_ratio<2>(grid<2>(1, 0, w, false), .5, false), .25, 1e-14);
  EXPECT_NEAR(inertia_ratio<2>(grid<2>(2, 0, w, false), .5, false), .625, 1e-14);
}

// A single particle cannot turn; its mass and momentum still hold.
TEST(ConversionCluster, OneParticleCannotTurn)
{
  for (const int n : {1})
  {
    const auto flat = make(grid<2>(1, 0, 4, false), n, false);
    EXPECT_EQ(flat.turn, 0);
    EXPECT_LE((flat.after.momentum - flat.before.momentum).norm(), 1e-13 * flat.before.momentum.norm());
    EXPECT_EQ(inertia_ratio<3>(grid<3>(1, 0, 4, false), 1, false), 0);
  }
}

// Rings: the mass of a particle goes with its radius. Element from r = 1 to 2,
// two an edge: r = 1.25 and 1.75.
TEST(ConversionCluster, RingsWeighByTheirRadius)
{
  const auto made = make(grid<2>(1, 0, 0, true), 2, true);
  ASSERT_EQ(made.particles.size(), 4u);
  EXPECT_NEAR(made.particles.mass[1] / made.particles.mass[0], 1.75 / 1.25, 1e-14);
  EXPECT_EQ(made.after.momentum[0], 0);
  EXPECT_EQ(made.after.angular_momentum.norm(), 0);
}

// Places: xi = -1/2, 1/2 on an element of edge 1; cells of half an edge; state
// of the element.
TEST(ConversionCluster, PlacesAndStates)
{
  const auto elements = grid<3>(1, 0, 0, false);
  const auto made     = make(elements, 2, false);
  ASSERT_EQ(made.particles.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k)
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(made.particles.x[i][k], (k >> i) % 2 ? .75 : .25, 1e-15);
      EXPECT_NEAR(made.particles.half_cell[i][k], .25, 1e-15);
      EXPECT_EQ(made.particles.points.sigma[4][k], 7);
    }
}

// An element of 1 x 2 m and particles 1/2 m apart: 2 x 4 of them.
TEST(ConversionCluster, LongElementsGiveMore)
{
  auto element = grid<2>(1, 0, 0, false).front();
  for (auto *corners : {&element.x0, &element.x})
    for (auto &corner : *corners)
      corner[1] *= 2;
  EXPECT_EQ(lattice_of(element, .5), (Lattice<2>{2, 4}));
  EXPECT_EQ(lattice_of(element, 3.), (Lattice<2>{1, 1}));
}

TEST(ConversionCluster, ColumnsNameTheirUnits)
{
  const auto columns = ConversionEvent::columns();
  EXPECT_EQ(columns.size(), ConversionEvent().values().size());
  EXPECT_NE(std::find(columns.begin(), columns.end(), "angular_momentum_z_after [N m s]"), columns.end());
  for (const auto &column : columns)
    EXPECT_NE(column.find(" ["), std::string::npos) << column;
}
} // namespace ogive::coupling
