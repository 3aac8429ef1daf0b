// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/correction/weights.h"
#include "sph/half/half.h"

namespace ogive::sph
{
/// energy_sweep (energy.h) with a central viscosity and the pairwise correction.
template <int dim, class Kernel>
[[gnu::flatten]] void half_energy_sweep(const Sweep &s)
{
  using L              = Layout<dim>;
  constexpr int n_sums = 3, before = L::p / simd_width * simd_width; // whole lines: P is in them
  constexpr int n_line = L::p - before + dim * dim - 1;              // but for the last
  const KernelAt<Kernel, dim>                       kernel(s.h);
  const CorrectionWeight<dim, Kernel, false, false> k(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own        = s.energy_records + i * L::energy_stride;
    const double *own_stress = s.force_records + i * L::force_stride + L::p;
    const double *own_da     = s.correction_records + i * L::correction_stride;
    const HalfRow row(s, i);
    ask_ahead<1>(s, i, s.energy_records, L::energy_stride);
    ask_ahead<1>(s, i, s.correction_records, L::correction_stride);
    ask_ahead<1>(s, i, s.force_records + before, L::force_stride);
    ask_ahead<1>(s, i, s.sums, L::powers_stride);
    VDouble       sum[L::powers_stride];
#pragma GCC unroll 32
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = row.begin; p < row.end; p += simd_width)
    {
      VDouble j[L::energy_stride];
      load_records<2 * dim + 2>(s.energy_records, L::energy_stride, s.index + p, j);
      VDouble dx[dim], dv[dim], r2 = 0., vx = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        dv[a] = own[L::v + a] - j[L::v + a];
        r2 += dx[a] * dx[a];
        vx += dv[a] * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble g = row.mine(p, kernel.slope(r, inv_r));
      VDouble       stress[padded(n_line)], power_i = 0., power_j = 0.;
      load_records<n_line>(s.force_records + before, L::force_stride, s.index + p, stress);
      for (int a = 0; a < dim; ++a)
      {
        VDouble ti = 0., tj = 0.;
        for (int b = 0; b < dim; ++b)
        {
          ti += own_stress[a * dim + b] * dx[b];
          tj += (a * dim + b == dim * dim - 1 ? j[L::last_p] : stress[L::p - before + a * dim + b]) * dx[b];
        }
        power_i += ti * dv[a];
        power_j += tj * dv[a];
      }
      VDouble c[L::correction_stride], dot = 0.;
      load_records<2 * dim + 2>(s.correction_records, L::correction_stride, s.index + p, c);
      for (int a = 0; a < dim; ++a)
        dot += (own_da[L::da + a] - c[L::da + a]) * dv[a];
      const std::size_t q     = p - row.begin + s.half_at[i];
      const VDouble weak      = row.mine(p, k(own_da, c, r)) * dot;
      const VDouble viscous   = weak + VDouble(s.pair_viscosity + s.viscosity_step * q, stdx::vector_aligned) * vx;
      const VDouble hourglass = VDouble(s.pair_hourglass + q, stdx::vector_aligned) * vx;
      sum[L::stress_power] -= (j[L::weight] * g) * power_i;
      sum[L::viscous_power] -= viscous;
      sum[L::hourglass_power] -= hourglass;
      VDouble pair[L::powers_stride];
#pragma GCC unroll 32
      for (auto &a : pair)
        a = 0.;
      pair[L::stress_power]    = -(own[L::weight] * g) * power_j;
      pair[L::viscous_power]   = -viscous;
      pair[L::hourglass_power] = -hourglass;
      add_records<n_sums>(pair, s.sums, L::powers_stride, s.index + p);
    }
    add_sums<n_sums>(sum, s.sums + i * L::powers_stride);
  }
}
} // namespace ogive::sph
