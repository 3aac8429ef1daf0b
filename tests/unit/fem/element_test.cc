// SPDX-License-Identifier: LGPL-2.1-or-later
// Kernels of the one-point elements with T = double, held against exact
// properties: linear fields, volumes, forces as transposes, rigid turns.
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/one_point.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_axisymmetric.h"
#include "fem/embedding.h"

#include <gtest/gtest.h>

#include <random>

using namespace ogive::fem;

namespace
{
template <class Element>
struct Sample
{
  static constexpr int n = Element::corners, dim = Element::dim;
  double               x[n][dim];

  /// A cell of edge 2 mm, its corners moved by up to a fifth of that; away from r = 0.
  explicit Sample(unsigned int seed)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> shift(-4e-4, 4e-4);
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < dim; ++i)
        x[a][i] = 1e-3 * corner_sign[a][i] + shift(random) + (i == 0 ? 5e-3 : 0.);
  }
};

template <class Element>
class OnePoint : public testing::Test
{};
using Elements = testing::Types<Line2, Quad4, Quad4Axisymmetric, Hex8>;
TYPED_TEST_SUITE(OnePoint, Elements);

// Mean gradient of linear fields: sum x (x) B = V I (axial symmetry: a field
// linear in r and z has a constant gradient, whatever the weight).
TYPED_TEST(OnePoint, GradientOfLinearFieldsIsExact)
{
  constexpr int dim = TypeParam::dim;
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    Sample<TypeParam>           s(seed);
    Geometry<TypeParam, double> g;
    TypeParam::gradient(s.x, g);
    ASSERT_GT(g.volume, 0);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
      {
        double sum = 0, constant = 0;
        for (int a = 0; a < TypeParam::corners; ++a)
        {
          sum += s.x[a][i] * g.B[a][j];
          constant += g.B[a][j];
        }
        EXPECT_NEAR(sum / g.volume, i == j, 1e-12);
        EXPECT_NEAR(constant * 1e-3 / g.volume, 0, 1e-12);
      }
  }
}

// The trace of the discrete rate of strain is the rate of the exact volume.
TYPED_TEST(OnePoint, TraceIsTheRateOfVolume)
{
  constexpr int     dim = TypeParam::dim, n = TypeParam::corners;
  Sample<TypeParam> s(7), v(8);
  const double      h = 1e-6;
  Geometry<TypeParam, double> g, plus, minus;
  TypeParam::gradient(s.x, g);
  double xp[n][dim], xm[n][dim], rate = 0;
  for (int a = 0; a < n; ++a)
    for (int i = 0; i < dim; ++i)
    {
      xp[a][i] = s.x[a][i] + h * v.x[a][i];
      xm[a][i] = s.x[a][i] - h * v.x[a][i];
      rate += v.x[a][i] * g.B[a][i];
      if constexpr (TypeParam::hoop)
        rate += i == 0 ? v.x[a][0] * g.hoop[a] : 0;
    }
  TypeParam::gradient(xp, plus);
  TypeParam::gradient(xm, minus);
  EXPECT_NEAR((plus.volume - minus.volume) / (2 * h) / rate, 1, 1e-8);
}

// Rotating by finite angles in steps strains nothing: spin only. Off-axis in 3-D.
TYPED_TEST(OnePoint, RigidTurnStrainsNothing)
{
  constexpr int dim = TypeParam::dim, n = TypeParam::corners;
  if constexpr (dim > 1 && !TypeParam::hoop)
  {
    Sample<TypeParam> s(3);
    const Eigen::Vector3d axis = dim == 3 ? Eigen::Vector3d(1, -2, .5).normalized() : Eigen::Vector3d::UnitZ();
    const double          dt = 3e-7, angle = .05;
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    double                v[n][dim], x[n][dim];
    for (int a = 0; a < n; ++a)
    {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int i = 0; i < dim; ++i)
        p[i] = s.x[a][i];
      const Eigen::Vector3d q = R * p;
      for (int i = 0; i < dim; ++i)
      {
        v[a][i] = (q[i] - p[i]) / dt;
        x[a][i] = q[i];
      }
    }
    Geometry<TypeParam, double>    g;
    Deformation<TypeParam, double> d;
    deform<TypeParam, double>(x, v, dt, g, d);
    for (const double strain : d.strain)
      EXPECT_NEAR(strain, 0, 1e-14);
    // Cayley's turn: tan(angle/2) = half the spin.
    const double spin = std::sqrt(d.spin[0] * d.spin[0] + d.spin[1] * d.spin[1] + d.spin[2] * d.spin[2]);
    EXPECT_NEAR(2 * std::atan(spin / 2), angle, 1e-13);
    for (auto &row : d.rate)
      for (const double rate : row)
        EXPECT_NEAR(rate * dt / 2e-3, 0, 1e-13);
    // Hourglass forces turn with the body.
    double         Q[Geometry<TypeParam, double>::modes][dim];
    Eigen::Vector3d q0(.3, -1.1, .7);
    for (auto &row : Q)
      for (int i = 0; i < dim; ++i)
        row[i] = q0[i];
    if (dim == 2)
      q0[2] = 0;
    turn<TypeParam, double>(d.spin, Q);
    const Eigen::Vector3d turned = R * q0;
    for (int i = 0; i < dim; ++i)
      EXPECT_NEAR(Q[0][i], turned[i], 1e-13);
  }
  else
  {
    // one dimension and the half section know no turn: the rigid motion left is
    // the shift along the last axis
    Sample<TypeParam> here(7), shift(8);
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < dim; ++i)
        shift.x[a][i] = i == dim - 1 ? 317. : 0.;
    Geometry<TypeParam, double>    g;
    Deformation<TypeParam, double> d;
    const double                   dt = 3e-7;
    deform<TypeParam, double>(here.x, shift.x, dt, g, d);
    for (const double strain : d.strain)
      EXPECT_NEAR(strain / (317 * dt / 2e-3), 0, 1e-13);
  }
}

// Corner forces are minus the transpose of the strain operator: their power is
// -V sigma:D - Q.rate for any motion; net force and moment vanish.
TYPED_TEST(OnePoint, ForcesAreTheTransposeOfTheStrain)
{
  constexpr int dim = TypeParam::dim, n = TypeParam::corners;
  Sample<TypeParam> s(11), v(12);
  Geometry<TypeParam, double>    g;
  Deformation<TypeParam, double> d;
  deform<TypeParam, double>(s.x, v.x, 1e-12, g, d); // so short that the middle is the end
  const double sigma[6] = {3e8, -1e8, 2e8, .5e8, -.7e8, 1.3e8};
  double       Q[Geometry<TypeParam, double>::modes][dim], f[n][dim];
  double       expected = 0;
  for (int m = 0; m < Geometry<TypeParam, double>::modes; ++m)
    for (int i = 0; i < dim; ++i)
    {
      Q[m][i] = m < TypeParam::modes ? 100. * (m + 1) - 40 * i : 0.;
      if (m < TypeParam::modes)
        expected -= Q[m][i] * d.rate[m][i];
    }
  for (int k = 0; k < 6; ++k)
    expected -= g.volume * sigma[k] * d.strain[k] / 1e-12 * (k < 3 ? 1 : 2);
  corner_forces<TypeParam, double>(g, sigma, Q, f);
  double power = 0, size = 0, net[3] = {}, moment[3] = {};
  for (int a = 0; a < n; ++a)
  {
    double x3[3] = {}, f3[3] = {};
    for (int i = 0; i < dim; ++i)
    {
      power += f[a][i] * v.x[a][i];
      size += std::abs(f[a][i]);
      net[i] += f[a][i];
      x3[i] = s.x[a][i];
      f3[i] = f[a][i];
    }
    for (int i = 0; i < 3; ++i)
      moment[i] += x3[(i + 1) % 3] * f3[(i + 2) % 3] - x3[(i + 2) % 3] * f3[(i + 1) % 3];
  }
  EXPECT_NEAR(power / expected, 1, 1e-9);
  for (int i = TypeParam::hoop ? 1 : 0; i < dim; ++i)
    EXPECT_NEAR(net[i] / size, 0, 1e-14);
  if (!TypeParam::hoop)
    for (const double m : moment)
      EXPECT_NEAR(m / (size * 1e-3), 0, 1e-12);
}

// A corner moved against linear motion is felt by the hourglass pattern and not
// by the mean strain of an undistorted cell.
TEST(Hourglass, PatternMakesARateAndNoStrain)
{
  double x[8][3], v[8][3];
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
    {
      x[a][i] = 1e-3 * corner_sign[a][i];
      v[a][i] = i == 1 ? 4 * Hex8::hourglass[2][a] : 0;
    }
  Geometry<Hex8, double>    g;
  Deformation<Hex8, double> d;
  deform<Hex8, double>(x, v, 1e-7, g, d);
  for (const double strain : d.strain)
    EXPECT_NEAR(strain, 0, 1e-16);
  EXPECT_NEAR(d.rate[2][1], 32, 1e-13);
  EXPECT_NEAR(g.volume / 8e-9, 1, 1e-14);
}

// Ring of rectangular section: V = pi (b^2 - a^2) h exactly, and a uniform
// expansion u_r = alpha r has hoop strain = radial strain = alpha.
TEST(Axisymmetric, RingVolumeAndUniformExpansion)
{
  const double a = 2e-3, b = 5e-3, h = 1.5e-3, alpha = 40;
  const double x[4][2] = {{a, 0}, {b, 0}, {b, h}, {a, h}};
  double       v[4][2];
  for (int c = 0; c < 4; ++c)
    v[c][0] = alpha * x[c][0], v[c][1] = 0;
  Geometry<Quad4Axisymmetric, double>    g;
  Deformation<Quad4Axisymmetric, double> d;
  const double                           dt = 1e-9;
  deform<Quad4Axisymmetric, double>(x, v, dt, g, d);
  EXPECT_NEAR(g.volume / (M_PI * (b * b - a * a) * h), 1, 1e-14);
  EXPECT_NEAR(d.strain[0] / d.strain[2], 1, 1e-12);
  EXPECT_NEAR(d.strain[2] / (alpha * dt), 1, 1e-6);
  double share[4], sum = 0;
  Quad4Axisymmetric::corner_volumes(x, share);
  for (const double s : share)
    sum += s;
  EXPECT_NEAR(sum / g.volume, 1, 1e-14);
}

TEST(Embedding, WeightsReproduceThePointInsideAndALittleOutside)
{
  Sample<Hex8>                         s(5);
  std::array<std::array<double, 3>, 8> x;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
      x[a][i] = s.x[a][i];
  std::array<double, 8> w;
  for (const std::array<double, 3> p : {std::array{5.2e-3, -.3e-3, .4e-3}, std::array{6.4e-3, .1e-3, .2e-3}})
  {
    ASSERT_TRUE(weights_of_point<3>(x, p, .8, w));
    double sum = 0, back[3] = {};
    for (int a = 0; a < 8; ++a)
    {
      sum += w[a];
      for (int i = 0; i < 3; ++i)
        back[i] += w[a] * x[a][i];
    }
    EXPECT_NEAR(sum, 1, 1e-13);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(back[i], p[i], 1e-15);
  }
  EXPECT_FALSE(weights_of_point<3>(x, {9e-3, 0, 0}, .5, w));
}
} // namespace
