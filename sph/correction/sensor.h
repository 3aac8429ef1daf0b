// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"
#include "sph/viscosity/switches.h"

#include <algorithm>
#include <cmath>

namespace ogive::sph
{
/// Sums over the neighbours of D = div v: sum W |D_i - D_j|, sum W (|D_i| +
/// |D_j|), sum W (D_j - D_i), sum V_j (D_j - D_i) gradW, sum W (x_j - x_i).
/// Without self. Zeros where `compressed_only` says that nobody asks.
template <int dim, class Kernel>
[[gnu::flatten]] void sensor_sweep(const Sweep &s)
{
  using L = SensorLayout<dim>;
  const KernelAt<Kernel, dim> kernel(s.h);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.sensor_records + i * L::stride;
    VDouble       sum[L::sums_stride];
    for (auto &a : sum)
      a = 0.;
    const bool asked = !s.compressed_only || own[L::divergence] < 0;
    for (std::size_t p = s.row[i]; asked && p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(L::n_fields)], dx[dim], r2 = 0.;
      load_records<L::n_fields>(s.sensor_records, L::stride, s.index + p, j);
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        r2 += dx[a] * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      // Images that do not act have no volume.
      const VDouble w = select(j[L::volume] > 0., kernel.value(r), VDouble(0.));
      const VDouble d = own[L::divergence] - j[L::divergence];
      const VDouble g = j[L::volume] * kernel.slope(r, inv_r) * d;
      sum[L::jump] += w * stdx::fabs(d);
      sum[L::bend] -= w * d;
      sum[L::size] += w * (std::abs(own[L::divergence]) + stdx::fabs(j[L::divergence]));
      for (int a = 0; a < dim; ++a)
      {
        sum[L::slope + a] -= g * dx[a];
        sum[L::offset + a] -= w * dx[a];
      }
    }
    store_sums<L::n_sums>(sum, s.sums + i * L::sums_stride);
  }
}

/// Share of a particle's viscosity that captures a shock and is not corrected:
/// clamp(-h div v/(c M0), 0, 1).
template <int dim>
double compression_sensor(const ViscousPoint<dim> &p, double m0)
{
  return std::clamp(-p.h * p.divergence() / (m0 * p.sound), 0., 1.);
}

/// Ducros's factor F = D^2/(D^2 + max(0, e:e - 2/3 D^2) + 2 w^2), e the deviator
/// of the three-dimensional rate, w = |curl v|/2: 1 where all of the motion is
/// compression along one line, 0 in shear and rotation.
template <int dim>
double ducros(const ViscousPoint<dim> &p)
{
  const double d        = p.divergence();
  const auto   rate     = (.5 * (p.gradient + p.gradient.transpose())).eval();
  const double deviator = rate.squaredNorm() + p.hoop * p.hoop - d * d / 3; // e:e, missing axes at rest
  const double w        = .5 * curl<dim>(p.gradient);
  const double all      = d * d + std::max(0., deviator - 2. / 3 * d * d) + 2 * w * w;
  return all > 0 ? d * d / all : 0; // squares of what runs ahead of a front underflow
}

/// Sharper ones: where it is compressed, F S/(1 + S), S = (R/R0)^8, with the
/// scale-free jump R = jump/(size + 1e-6 c/h of as many neighbours) of div v
/// between neighbours. That alone (sharp) fires at the nodes of a smooth wave,
/// where div v changes sign, as it does in a front. With `bend`, what a linear
/// field leaves of the sum of the differences (curvature), S also has the factor
/// G/(1 + G), G = (bend/(size ...)/r_bend)^4: nodes are straight, fronts are not.
/// `weights`: sum W of the lattice.
struct Unevenness
{
  double jump, size, weights, r0;
  double bend, r_bend; ///< r_bend 0: not asked
};

template <int dim>
double uneven_sensor(const ViscousPoint<dim> &p, const Unevenness &u)
{
  if (!(p.divergence() < 0))
    return 0;
  const auto   power4 = [](double x) { return x * x * x * x; };
  const double size   = u.size + 1e-6 * p.sound / p.h * u.weights;
  if (!(size > 0)) // alone, and without sound
    return 0;
  const double s      = power4(u.jump / size / u.r0) * power4(u.jump / size / u.r0);
  double       share  = ducros(p) * s / (1 + s);
  if (u.r_bend > 0)
  {
    const double g = power4(u.bend / size / u.r_bend);
    share *= g / (1 + g);
  }
  return share;
}
} // namespace ogive::sph
