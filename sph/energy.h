// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/correction/weights.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// Powers of the forces of t_n on the mean velocity of the kick. The stress
/// power of a particle is its own term, w_i P_i : sum_j w_j (v_j - v_i) (x)
/// gradW, so that no stress heat leaks to a neighbour; the dissipative pair
/// forces heat half and half, -1/2 F_ij . v_ij. The sum over all particles is
/// minus the power of the forces, to rounding. `central`: the viscosity that
/// acts as it is has central forces; `correction`: pairwise, one support.
template <int dim, class Kernel, bool central, bool correction>
[[gnu::flatten]] void energy_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  const KernelAt<Kernel, dim> kernel(s.h);
  const CorrectionWeight<dim, Kernel, false, false> k(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own        = s.energy_records + i * L::energy_stride;
    const double *own_stress = s.force_records + i * L::force_stride + L::p;
    const double *own_da     = s.correction_records + i * L::correction_stride;
    VDouble       sum[L::powers_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[L::energy_stride];
      load_records<2 * dim + 1>(s.energy_records, L::energy_stride, s.index + p, j);
      VDouble dx[dim], dv[dim], r2 = 0., vx = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        dv[a] = own[L::v + a] - j[L::v + a];
        r2 += dx[a] * dx[a];
        vx += dv[a] * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble wg = j[L::weight] * kernel.slope(r, inv_r);
      VDouble stress = 0.;
      for (int a = 0; a < dim; ++a)
      {
        VDouble t = 0.;
        for (int b = 0; b < dim; ++b)
          t += own_stress[a * dim + b] * dx[b];
        stress += t * dv[a];
      }
      sum[L::stress_power] -= wg * stress;
      sum[L::hourglass_power] -= VDouble(s.pair_hourglass + p, stdx::vector_aligned) * vx;
      if constexpr (correction)
      {
        VDouble c[L::correction_stride], dot = 0.;
        load_records<2 * dim + 2>(s.correction_records, L::correction_stride, s.index + p, c);
        for (int a = 0; a < dim; ++a)
          dot += (own_da[L::da + a] - c[L::da + a]) * dv[a];
        sum[L::viscous_power] -= k(own_da, c, VDouble(stdx::sqrt(r2))) * dot;
      }
      if constexpr (central)
        sum[L::viscous_power] -= VDouble(s.pair_viscosity + p, stdx::vector_aligned) * vx;
    }
    store_sums<3>(sum, s.sums + i * L::powers_stride);
  }
}
} // namespace ogive::sph
