// SPDX-License-Identifier: LGPL-2.1-or-later
// Every registered viscosity, raw and limited, in every dimension: what makes a
// viscosity one. All bounds are rounding; the numbers follow from the algebra.
#include "sph/viscosity/viscosities.h"
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = .013, h = 1.3 * spacing;

template <int dim, class Law>
struct Case
{
  using V = typename Cloud<dim>::V;
  using M = typename Cloud<dim>::M;

  Cloud<dim>     cloud;
  std::vector<M> gradients;
  SweepFunctions sweeps;

  bool           limited;

  explicit Case(bool with_limiter)
    : cloud(box<dim>(Vec3::Zero(), spacing * (dim == 1 ? Vec3(30, 0, 0) : dim == 2 ? Vec3(9, 7, 0) : Vec3(6, 5, 5)),
                     spacing, copper(), .2),
            h)
    , sweeps(choose_sweeps<dim>({.viscosity = Law::name, .limited = with_limiter}))
    , limited(with_limiter)
  {}

  template <class F>
  void run(F &&velocity)
  {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.v[i] = velocity(cloud.x[i], i);
    cloud.pack();
    sweeps.gradient(cloud.with(cloud.gradient_sums));
    gradients.clear();
    for (std::size_t i = 0; i < cloud.size(); ++i)
      gradients.push_back(cloud.difference(i) * cloud.moment(i).inverse());
    cloud.template pack_viscous<Law>(gradients, limited);
    sweeps.viscous(cloud.with(cloud.viscous_sums));
  }
  double size() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      sum += cloud.viscous_force_on(i).norm();
    return sum;
  }
};

/// Size of viscous forces of a compression of 1e4 1/s: the scale of all bounds.
template <int dim, class Law>
double scale()
{
  Case<dim, Law> c(false);
  c.run([](const auto &x, std::size_t) { return (-1e4 * x).eval(); });
  return c.size();
}

template <int dim, class Law>
void conformance(bool limited)
{
  SCOPED_TRACE(std::string(Law::name) + (limited ? " limited " : " ") + std::to_string(dim));
  using V             = typename Cloud<dim>::V;
  const double whole  = scale<dim, Law>();
  ASSERT_GT(whole, 0);
  Case<dim, Law> c(limited);

  // Drift and rigid rotation: no pair changes its length.
  Eigen::Matrix3d spin;
  spin << 0, -9e3, 4e3, 9e3, 0, -7e3, -4e3, 7e3, 0;
  c.run([&](const V &x, std::size_t) { return (spin.topLeftCorner<dim, dim>() * x + V::Constant(77.)).eval(); });
  EXPECT_LT(c.size(), 1e-9 * whole);
  // Expansion.
  c.run([](const V &x, std::size_t) { return (1e4 * x).eval(); });
  EXPECT_EQ(c.size(), 0);
  // Uniform compression is no jump: the limiter takes all of it.
  c.run([](const V &x, std::size_t) { return (-1e4 * x).eval(); });
  if (limited)
  {
    EXPECT_LT(c.size(), 1e-9 * whole);
  }

  // Anything: action and reaction, the frame of the observer, dissipation.
  const auto wild = [](const V &x, std::size_t i) {
    V v;
    for (int a = 0; a < dim; ++a)
      v[a] = 90 * std::sin(400 * x[(a + 1) % dim] + 1.7 * static_cast<double>(i) + a);
    return v;
  };
  c.run(wild);
  V              sum   = V::Zero();
  double         power = 0, rate = 0;
  std::vector<V> still;
  for (std::size_t i = 0; i < c.cloud.size(); ++i)
  {
    still.push_back(c.cloud.viscous_force_on(i));
    sum += still.back();
    power += still.back().dot(c.cloud.v[i]);
    rate += c.cloud.viscous_sums[i * ViscousLayout<dim>::sums_stride + ViscousLayout<dim>::direct_rate];
  }
  const double size = c.size();
  EXPECT_GT(size, 0);
  EXPECT_GT(rate, 0);
  EXPECT_LT(sum.norm(), 1e-13 * size);
  EXPECT_LT(power, 0);
  if (Law::dissipates)
    for (std::size_t p = 0; p < c.cloud.rows.index.size(); ++p)
      EXPECT_GE(c.cloud.viscosity[p], 0); // pushes, and only pairs that approach
  c.run([&](const V &x, std::size_t i) { return (wild(x, i) + V::Constant(1000.)).eval(); });
  for (std::size_t i = 0; i < c.cloud.size(); ++i)
    EXPECT_LT((c.cloud.viscous_force_on(i) - still[i]).norm(), 1e-10 * size);
}

template <int dim, std::size_t k = 0>
void all()
{
  if constexpr (k < std::tuple_size_v<Viscosities<dim>>)
  {
    conformance<dim, std::tuple_element_t<k, Viscosities<dim>>>(false);
    conformance<dim, std::tuple_element_t<k, Viscosities<dim>>>(true);
    all<dim, k + 1>();
  }
}

TEST(Viscosity, ConformanceInOneDimension) { all<1>(); }
TEST(Viscosity, ConformanceInTwoDimensions) { all<2>(); }
TEST(Viscosity, ConformanceInThreeDimensions) { all<3>(); }

/// In one dimension there is nothing across the line: Owen's tensor is
/// Monaghan's number.
TEST(Viscosity, OwenIsMonaghanInOneDimension)
{
  Case<1, Owen<1>>     owen(false);
  Case<1, Monaghan<1>> monaghan(false);
  const auto           v = [](const auto &x, std::size_t) { return (80 * (500 * x).array().sin()).matrix().eval(); };
  owen.run(v);
  monaghan.run(v);
  for (std::size_t i = 0; i < owen.cloud.size(); ++i)
    EXPECT_NEAR(owen.cloud.viscous_force_on(i)[0], monaghan.cloud.viscous_force_on(i)[0], 1e-12 * monaghan.size());
}

/// Two particles: Monaghan's Pi by hand, alpha 1, beta 2.
TEST(Viscosity, MonaghanPairByHand)
{
  Case<1, Monaghan<1>> c(false);
  c.cloud.x.resize(2);
  c.cloud.v.resize(2);
  c.cloud.mass.resize(2);
  c.cloud.density.resize(2);
  c.cloud.x[0][0] = 0;
  c.cloud.x[1][0] = spacing;
  c.run([](const auto &, std::size_t i) { return Eigen::Matrix<double, 1, 1>(i == 0 ? 30. : -20.); });
  const double rho = c.cloud.density[0], m = c.cloud.mass[0];
  const double mu = -h * 50 * spacing / (spacing * spacing + .01 * h * h);
  const double pi = (-4660 * mu + 2 * mu * mu) / rho;
  const double q  = spacing / h, slope = 2. / (3 * h * h) * (2.25 * q * q - 3 * q); // W'(r)
  EXPECT_NEAR(c.cloud.viscous_force_on(0)[0], m * m * pi * slope, 1e-12 * std::abs(m * m * pi * slope));
}

TEST(Viscosity, UnknownNameIsAnInputError)
{
  EXPECT_THROW(choose_sweeps<2>({.viscosity = "treacle"}), InputError);
  EXPECT_THROW(choose_sweeps<2>({.correction = "full"}), InputError);
}
} // namespace
