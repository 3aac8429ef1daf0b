// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// Moment matrix M = -sum V_j gradW (x) x_ij, velocity differences
/// G = sum V_j (v_j - v_i) (x) gradW, Shepard sum at h_c and sum V_j |gradW|.
/// The standard form also sums m_j v_ij.gradW, its density rate.
template <int dim, class Kernel, bool standard>
[[gnu::flatten]] void gradient_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  const KernelAt<Kernel, dim> kernel(s.h), wide(s.h * s.support);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    VDouble       sum[L::gradient_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(L::n_motion)];
      load_records<L::n_motion>(s.force_records, L::force_stride, s.index + p, j);
      VDouble dx[dim], dv[dim], r2 = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        dv[a] = j[L::v + a] - own[L::v + a];
        r2 += dx[a] * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble g = kernel.slope(r, inv_r);
      VDouble       volume = j[L::weight];
      if constexpr (standard)
        volume = select(j[L::density] > 0., VDouble(volume / j[L::density]), VDouble(0.));
      const VDouble vg = volume * g;
      for (int b = 0; b < dim; ++b)
      {
        const VDouble f = vg * dx[b];
        sum[L::normal_sum + b] += f;
        for (int a = 0; a <= b; ++a)
          sum[L::m_sum + L::sym(a, b)] -= f * dx[a];
        for (int a = 0; a < dim; ++a)
          sum[L::g_sum + a * dim + b] += f * dv[a];
        if constexpr (standard)
          sum[L::continuity_sum] -= j[L::weight] * g * dx[b] * dv[b];
      }
      sum[L::shepard_sum] += volume * wide.value(r);
      sum[L::stiffness_sum] -= vg * r;
    }
    store_sums<L::n_gradient>(sum, s.sums + i * L::gradient_stride);
  }
}
} // namespace ogive::sph
