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
/// |D_j|), sum V_j (D_j - D_i) gradW. Without self.
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
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
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
      sum[L::size] += w * (std::abs(own[L::divergence]) + stdx::fabs(j[L::divergence]));
      for (int a = 0; a < dim; ++a)
        sum[L::slope + a] -= g * dx[a];
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

/// The sharper one: where it is compressed, F S/(1 + S) with the scale-free
/// jump of div v between neighbours S = (R/R0)^8, R = jump/(size + 1e-6 c/h of
/// as many neighbours), and Ducros's factor F = D^2/(D^2 + max(0, e:e - 2/3 D^2)
/// + 2 w^2), e the deviator of the three-dimensional rate, w = |curl v|/2.
/// `jump`, `size`: sums of the sensor sweep; `weights`: sum W of the lattice.
template <int dim>
double sharp_sensor(const ViscousPoint<dim> &p, double jump, double size, double weights, double r0)
{
  const double d = p.divergence();
  if (!(d < 0))
    return 0;
  const auto   rate = (.5 * (p.gradient + p.gradient.transpose())).eval();
  const double deviator = rate.squaredNorm() - d * d / 3; // e:e, the missing axes at rest
  const double w        = .5 * curl<dim>(p.gradient);
  const double ducros   = d * d / (d * d + std::max(0., deviator - 2. / 3 * d * d) + 2 * w * w);
  const double ratio    = jump / (size + 1e-6 * p.sound / p.h * weights) / r0;
  const double s2 = ratio * ratio, s4 = s2 * s2, s8 = s4 * s4;
  return ducros * s8 / (1 + s8);
}
} // namespace ogive::sph
