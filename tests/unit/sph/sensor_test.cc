// SPDX-License-Identifier: LGPL-2.1-or-later
// The shock sensor in closed cases; the sums are those of a front and of a
// straight field.
#include "sph/correction/sensor.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive::sph;

template <int dim>
ViscousPoint<dim> point(const Eigen::Matrix<double, dim, dim> &gradient, double sound = 5000)
{
  ViscousPoint<dim> p;
  p.gradient = gradient;
  p.density  = 2700;
  p.sound    = sound;
  p.h        = 1e-3;
  return p;
}

template <int dim>
void ducros_is_exact()
{
  using M    = Eigen::Matrix<double, dim, dim>;
  M squeezed = M::Zero();
  squeezed(0, 0) = -3e4;
  EXPECT_NEAR(ducros(point<dim>(squeezed)), 1, 1e-14);
  if (dim == 1)
    return;
  M shear = M::Zero();
  shear(0, dim - 1) = 3e4;
  EXPECT_EQ(ducros(point<dim>(shear)), 0);
  EXPECT_EQ(ducros(point<dim>(shear - shear.transpose())), 0); // a turn
}

TEST(Sensor, DucrosIsOneInCompressionAlongALineAndZeroInShear)
{
  ducros_is_exact<1>();
  ducros_is_exact<2>();
  ducros_is_exact<3>();
}

// jump = size in a front, where neighbours stand still; 1/(1 + r0^8) of F = 1
TEST(Sensor, OpensInAFrontAndNotWhereExpanding)
{
  const Unevenness front{1e4, 1e4, 1, .15, 1e3, .02};
  const auto       in  = point<1>(Eigen::Matrix<double, 1, 1>(-1e4));
  const auto       out = point<1>(Eigen::Matrix<double, 1, 1>(1e4));
  EXPECT_GT(uneven_sensor(in, front), .99);
  EXPECT_EQ(uneven_sensor(out, front), 0);
  const Unevenness straight{1e4, 1e4, 1, .15, 1e-3, .02}; // a node: uneven, without curvature
  EXPECT_LT(uneven_sensor(in, straight), 1e-12);
}

// What runs ahead of a front falls below the smallest square; a particle alone
// has no sums, and a cold gas no sound.
TEST(Sensor, IsAlwaysANumber)
{
  for (const double d : {-1e-155, -1e-170, -1e-200, -1e-300, -5e-324})
    for (const double sound : {5000., 0.})
    {
      const Eigen::Matrix3d g = d * Eigen::Matrix3d::Identity();
      for (const Unevenness &u : {Unevenness{0, 0, 1e9, .15, 0, .02}, Unevenness{-d, -d, 1e9, .15, -d, .02},
                                  Unevenness{-1e9 * d, -1e9 * d, 1e9, .15, -1e8 * d, .02}})
      {
        const double share = uneven_sensor(point<3>(g, sound), u);
        EXPECT_GE(share, 0) << d; // false for what is not a number
        EXPECT_LE(share, 1) << d;
      }
    }
}
} // namespace
