// SPDX-License-Identifier: LGPL-2.1-or-later
// What comes back from absorbing faces at an angle, against plane waves and dashpots.
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <complex>
#include <cstdio>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;
using input::BoundaryKind;

namespace
{
Parameters quiet()
{
  Parameters p;
  p.options.bulk_linear = p.options.bulk_quadratic = 0;
  return p;
}

double mechanical(const Balance &b)
{
  return b.kinetic + b.elastic + b.hourglass_fem;
}

/// Poisson's solid: c_p/c_s = sqrt(3).
constexpr double young = 100e9, nu = .25, density = 8000;
const double     shear_modulus = young / (2 * (1 + nu)), lame = 2 * nu * shear_modulus / (1 - 2 * nu);
const double c_p = std::sqrt((lame + 2 * shear_modulus) / density), c_s = std::sqrt(shear_modulus / density);

/// Share of the energy of a plane wave at `angle` from the normal that returns
/// from dashpots sigma_yy = rho c_p v_y, sigma_xy = rho c_s v_x on y = 0: a
/// reflected P and a reflected S of the same slowness along x, from the two conditions.
double reflected_share(bool p_wave, double angle)
{
  using Complex = std::complex<double>;
  struct Wave
  {
    Complex sx, sy, px, py; ///< slowness and direction of motion
  };
  const auto conditions = [](const Wave &w)
  {
    return Eigen::Vector2cd(lame * (w.sx * w.px + w.sy * w.py) + 2 * shear_modulus * w.sy * w.py +
                                density * c_p * w.py,
                            shear_modulus * (w.sx * w.py + w.sy * w.px) + density * c_s * w.px);
  };
  const double  c = p_wave ? c_p : c_s, sx = std::sin(angle) / c, sy = -std::cos(angle) / c;
  const Wave    in = p_wave ? Wave{sx, sy, c * sx, c * sy} : Wave{sx, sy, c * sy, -c * sx};
  const Complex yp = std::sqrt(Complex(1 / (c_p * c_p) - sx * sx)),
                ys = std::sqrt(Complex(1 / (c_s * c_s) - sx * sx));
  const Wave       p{sx, yp, c_p * sx, c_p * yp}, s{sx, ys, c_s * ys, -c_s * sx};
  Eigen::Matrix2cd M;
  M << conditions(p), conditions(s);
  const Eigen::Vector2cd amplitude = M.inverse() * -conditions(in);
  return (std::norm(amplitude[0]) * c_p * c_p * yp.real() + std::norm(amplitude[1]) * c_s * c_s * ys.real()) /
         (c * std::cos(angle));
}

/// The same of a packet whose spectrum is a Gaussian of relative width `spread`.
double reflected_share(bool p_wave, double angle, double spread)
{
  double sum = 0, weight = 0;
  for (int k = -30; k <= 30; ++k)
  {
    const double off = .1 * k, at = angle + off * spread;
    if (std::abs(at) < .5 * M_PI)
    {
      sum += std::exp(-.5 * off * off) * reflected_share(p_wave, at);
      weight += std::exp(-.5 * off * off);
    }
  }
  return sum / weight;
}

/// A packet in the middle of a strip parts in two, each meets an absorbing side
/// at `angle`; the energy left when both are back in the middle. The strip is so
/// wide that waves two spreads steeper or flatter have met one side, not two.
double left_in_strip(bool p_wave, double angle, int elements)
{
  const double h = 1e-3, wave = elements * h, sigma = 2 * wave, reach = 4.2 * sigma;
  const double width = 4 * reach * std::tan(angle) + 6 * sigma;
  auto         mesh =
      block<2>({-.5 * width, -reach, 0}, {.5 * width, reach, 0}, h, false, 0, elastic(young, nu, density));
  const Eigen::Vector2d d(std::sin(angle), std::cos(angle)), k = 2 * M_PI / wave * d;
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    // Gradient (P) or curl (S) of a potential, so that nothing of the other kind is in it.
    const Eigen::Vector2d x(mesh.x[0][a], mesh.x[1][a]);
    const double          envelope = std::exp(-.5 * x.squaredNorm() / (sigma * sigma));
    const Eigen::Vector2d slope =
        wave * envelope * (std::cos(k.dot(x)) * k - std::sin(k.dot(x)) / (sigma * sigma) * x);
    mesh.v[0][a] = 1e-4 * (p_wave ? slope[0] : slope[1]);
    mesh.v[1][a] = 1e-4 * (p_wave ? slope[1] : -slope[0]);
  }
  Parameters p         = quiet();
  p.boundaries         = {boundary("y-", BoundaryKind::absorbing), boundary("y+", BoundaryKind::absorbing)};
  auto          solver = solver_with(std::move(mesh), p);
  const Balance before = solver->balance();
  Driver<2>     driver{*solver};
  EXPECT_TRUE(driver.until(2 * reach / std::cos(angle) / (p_wave ? c_p : c_s)).ok);
  return mechanical(solver->balance()) / mechanical(before);
}

// The closed form itself: nothing at normal incidence, all of it at grazing.
TEST(Absorbing, ClosedForm)
{
  for (const bool p_wave : {true, false})
  {
    EXPECT_NEAR(reflected_share(p_wave, 0), 0, 1e-20);
    EXPECT_NEAR(reflected_share(p_wave, .5 * M_PI - 1e-4), 1, 1e-3);
    for (double angle = .05; angle < 1.5; angle += .05)
    {
      EXPECT_GE(reflected_share(p_wave, angle), 0);
      EXPECT_LE(reflected_share(p_wave, angle), 1);
    }
  }
}

// At 8, 12 and 16 elements a wavelength. The mesh's own error is of second order,
// so the differences from the closed form fall at least as the square, and what
// they tend to (Richardson) is the closed form of the packet. The strip does
// not follow the 5 % of it beyond two spreads to their end; their share differs from
// the mean by the order of .06, so by .003 in all.
void expect_oblique(bool p_wave, int degrees)
{
  const double angle = degrees * M_PI / 180, spread = 1 / (std::sqrt(2.) * 2 * 2 * M_PI);
  const double exact = reflected_share(p_wave, angle), packet = reflected_share(p_wave, angle, spread);
  double       left[3];
  for (int k = 0; k < 3; ++k)
    left[k] = left_in_strip(p_wave, angle, 8 + 4 * k);
  const double limit = left[2] - (left[1] - left[2]) / (16. * 16 / (12. * 12) - 1);
  std::printf(
      "%s at %d degrees, energy that comes back at 8, 12, 16 elements a wavelength: %.4f %.4f %.4f, limit "
      "%.4f; plane wave %.4f, packet %.4f\n",
      p_wave ? "P" : "S", degrees, left[0], left[1], left[2], limit, exact, packet);
  EXPECT_NEAR(limit, packet, .003);
  EXPECT_LT(std::abs(left[2] - packet), std::abs(left[0] - packet) / 4 + 1e-3);
}
TEST(Absorbing, P30)
{
  expect_oblique(true, 30);
}
TEST(Absorbing, P60)
{
  expect_oblique(true, 60);
}
TEST(Absorbing, S30)
{
  expect_oblique(false, 30);
}
TEST(Absorbing, S60)
{
  expect_oblique(false, 60);
}
} // namespace
