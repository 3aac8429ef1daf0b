// SPDX-License-Identifier: LGPL-2.1-or-later
// The sweeps on jittered free blocks: exactness and conservation follow from
// the algebra, so rounding is the only tolerance.
#include "sph/kernels/kernels.h"
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = .013, h = 1.3 * spacing;

template <int dim>
Cloud<dim> jittered()
{
  const Vec3 upper = spacing * (dim == 1 ? Vec3(30, 0, 0) : dim == 2 ? Vec3(9, 7, 0) : Vec3(7, 6, 5));
  return Cloud<dim>(box<dim>(Vec3::Zero(), upper, spacing, copper(), .2), h);
}

template <int dim>
Eigen::Matrix<double, dim, dim> a_matrix(double scale)
{
  Eigen::Matrix3d m;
  m << .3, -1.1, .7, 2.1, .4, -.6, -.9, 1.7, -1.3;
  return scale * m.topLeftCorner<dim, dim>();
}

template <int dim>
void gradient_of_affine_field()
{
  auto       cloud = jittered<dim>();
  const auto l     = a_matrix<dim>(2300);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.v[i] = l * cloud.x[i] + Cloud<dim>::V::Constant(170.);
  cloud.pack();
  choose_sweeps<dim>({}).gradient(cloud.with(cloud.gradient_sums));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_LT((cloud.difference(i) * cloud.moment(i).inverse() - l).norm(), 1e-12 * l.norm()) << i;
}

TEST(Gradient, ExactOnAffineVelocity)
{
  gradient_of_affine_field<1>();
  gradient_of_affine_field<2>();
  gradient_of_affine_field<3>();
}

template <int dim>
void stress_forces(const std::string &kernel, bool standard)
{
  SCOPED_TRACE(kernel + " " + std::to_string(dim) + (standard ? " standard" : " corrected"));
  using M     = typename Cloud<dim>::M;
  auto cloud  = jittered<dim>();
  cloud.pack(standard);
  const auto sweeps = choose_sweeps<dim>({.standard = standard, .kernel = kernel});
  sweeps.gradient(cloud.with(cloud.gradient_sums));
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> stress(-4e8, 4e8);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    M s;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b <= a; ++b)
        s(a, b) = s(b, a) = stress(random);
    const M corrected = s * cloud.moment(i).inverse();
    cloud.set_p(i, standard ? M(s / (cloud.density[i] * cloud.density[i])) : corrected);
  }
  sweeps.force(cloud.with(cloud.force_sums));
  Vec3   force = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0, arms = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    Vec3 f = Vec3::Zero(), x = Vec3::Zero();
    f.head<dim>() = cloud.force_on(i);
    x.head<dim>() = cloud.x[i];
    force += f;
    torque += x.cross(f);
    size += f.norm();
    arms += x.norm() * f.norm();
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(force.norm(), 1e-13 * size);
  // Shared B and V make the corrected form exact; the standard one is not.
  if (!standard)
  {
    EXPECT_LT(torque.norm(), 1e-13 * arms);
  }
}

TEST(Force, LinearAndAngularMomentum)
{
  for (const char *kernel : {"cubic", "quintic", "wendland-c2", "wendland-c4"})
    for (bool standard : {false, true})
    {
      stress_forces<1>(kernel, standard);
      stress_forces<2>(kernel, standard);
      stress_forces<3>(kernel, standard);
    }
}

TEST(Force, PairIsAntisymmetricToTheBit)
{
  std::mt19937                           random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 200; ++trial)
    for (bool standard : {false, true})
    {
      auto cloud = jittered<3>();
      cloud.x.resize(2);
      cloud.v.resize(2);
      cloud.mass.resize(2);
      cloud.density = {8930 + 100 * u(random), 8930 + 100 * u(random)};
      for (int i = 0; i < 2; ++i)
      {
        cloud.x[i] = .6 * h * Vec3(u(random), u(random), u(random));
        cloud.v[i] = 100 * Vec3(u(random), u(random), u(random));
      }
      std::array<double, 3> damage{}; // the last belongs to the filling
      cloud.pack(standard);
      cloud.sweep.damage = damage.data();
      for (int i = 0; i < 2; ++i)
      {
        cloud.set_p(i, 1e8 * Mat3::NullaryExpr([&](auto, auto) { return u(random); }));
        cloud.set_rate(i, 1e3 * Mat3::NullaryExpr([&](auto, auto) { return u(random); }));
        damage[i] = std::abs(u(random));
      }
      choose_sweeps<3>({.standard = standard, .damage = true}).force(cloud.with(cloud.force_sums));
      EXPECT_GT(cloud.force_on(0).norm(), 0);
      for (int a = 0; a < 3; ++a)
        EXPECT_EQ(cloud.force_on(0)[a], -cloud.force_on(1)[a]);
    }
}

/// The high-pass filter of numerics.md section 3 on a 1-D lattice, h = h_c = 1.3
/// spacings: what the correction keeps of a viscous acceleration cos(k x).
TEST(Correction, KeepsWhatTheLatticeFilterKeeps)
{
  const std::map<int, double> kept{{2, .93}, {4, .51}, {8, .16}, {16, .04}, {32, .01}};
  using L = Layout<1>;
  for (const auto &[wavelength, share] : kept)
  {
    Cloud<1> cloud(box<1>(Vec3::Zero(), Vec3(128 * spacing, 0, 0), spacing, copper()), h);
    cloud.pack();
    const auto sweeps = choose_sweeps<1>({.correction = "pairwise"});
    sweeps.gradient(cloud.with(cloud.gradient_sums));
    const double self = KernelAt<CubicSpline, 1>(h).value(0.);
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      double *r    = &cloud.correction[i * L::correction_stride];
      r[L::x]      = cloud.x[i][0];
      r[L::da]     = 7e5 * std::cos(2 * M_PI * i / wavelength);
      r[L::volume] = spacing;
      r[L::kappa]  = 8930 / (cloud.gradient_sums[i * L::gradient_stride + L::shepard_sum] + spacing * self);
    }
    sweeps.correction(cloud.with(cloud.force_sums));
    EXPECT_NEAR(cloud.force_on(64)[0] / cloud.mass[64] / 7e5, share, .005) << wavelength;
  }
}

/// Constants die, momentum stays, energy is taken, on disorder and at surfaces.
TEST(Correction, IsSelfAdjointKillsConstantsAndDissipates)
{
  using L    = Layout<3>;
  auto cloud = jittered<3>();
  cloud.pack();
  const auto sweeps = choose_sweeps<3>({.correction = "pairwise"});
  sweeps.gradient(cloud.with(cloud.gradient_sums));
  std::mt19937                           random(17);
  std::uniform_real_distribution<double> u(-1, 1);
  const double                           self = KernelAt<CubicSpline, 3>(h).value(0.);
  const auto                             run  = [&](double noise) {
    std::fill(cloud.force_sums.begin(), cloud.force_sums.end(), 0.);
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      double *r = &cloud.correction[i * L::correction_stride];
      for (int a = 0; a < 3; ++a)
      {
        r[L::x + a]  = cloud.x[i][a];
        r[L::da + a] = 3e5 * (a + 1) + noise * u(random);
      }
      const double volume = cloud.mass[i] / cloud.density[i];
      r[L::volume]        = volume;
      r[L::kappa] = cloud.density[i] / (cloud.gradient_sums[i * L::gradient_stride + L::shepard_sum] + volume * self);
    }
    sweeps.correction(cloud.with(cloud.force_sums));
  };
  run(0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_EQ(cloud.force_on(i).norm(), 0);
  run(1e5);
  Vec3   force = Vec3::Zero();
  double size = 0, with_itself = 0, rayleigh = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Vec3 da = Eigen::Map<const Vec3>(&cloud.correction[i * L::correction_stride + L::da]);
    force += cloud.force_on(i);
    size += cloud.force_on(i).norm();
    with_itself += da.dot(cloud.force_on(i));
    rayleigh += (da - 3e5 * Vec3(1, 2, 3)).squaredNorm() * cloud.mass[i];
  }
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_GT(with_itself, 0);
  EXPECT_LT(with_itself, 2 * rayleigh); // spectrum in [0, 2)
}
} // namespace
