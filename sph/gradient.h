// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

#include <algorithm>

namespace ogive::sph
{
/// Moment matrix M = -sum V_j gradW (x) x_ij, velocity differences
/// G = sum V_j (v_j - v_i) (x) gradW, Shepard sum at h_c and sum V_j |gradW|.
/// The standard form also sums m_j v_ij.gradW, its density rate.
///
/// In two short loops over each batch of a row: the way from a record to the
/// kernel is long and waits for itself, so that many of them must be under way at once,
/// which one long loop with all of the sums does not leave room for.
template <int dim, class Kernel, bool standard>
[[gnu::flatten]] void gradient_sweep(const Sweep &s)
{
  using L              = Layout<dim>;
  constexpr int batch  = 16; // registers
  constexpr int n_sums = standard ? L::n_gradient : L::continuity_sum;
  const KernelAt<Kernel, dim> kernel(s.h), wide(s.h * s.support);
  VDouble dx[dim][batch], dv[dim][batch], vg[batch], mg[batch], stiffness[batch], shepard[batch];
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    VDouble       sum[L::gradient_stride];
#pragma GCC unroll 32
    for (auto &a : sum)
      a = 0.;
    for (std::size_t first = s.row[i]; first < s.row[i + 1]; first += batch * simd_width)
    {
      const int n = static_cast<int>(std::min<std::size_t>(batch, (s.row[i + 1] - first) / simd_width));
      for (int k = 0; k < n; ++k)
      {
        VDouble j[padded(L::n_motion)];
        load_records<L::n_motion>(s.force_records, L::force_stride, s.index + first + k * simd_width, j);
        VDouble r2 = 0.;
        for (int a = 0; a < dim; ++a)
        {
          const VDouble d = own[L::x + a] - j[L::x + a];
          dx[a][k]        = d;
          dv[a][k]        = j[L::v + a] - own[L::v + a];
          r2 += d * d;
        }
        const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
        const VDouble g = kernel.slope(r, inv_r);
        VDouble       volume = j[L::weight];
        if constexpr (standard)
        {
          volume = select(j[L::density] > 0., VDouble(volume / j[L::density]), VDouble(0.));
          mg[k]  = j[L::weight] * g;
        }
        vg[k]        = volume * g;
        stiffness[k] = volume * g * r;
        shepard[k]   = volume * wide.value(r);
      }
      for (int k = 0; k < n; ++k)
      {
        for (int b = 0; b < dim; ++b)
        {
          const VDouble f = vg[k] * dx[b][k];
          sum[L::normal_sum + b] += f;
          for (int a = 0; a <= b; ++a)
            sum[L::m_sum + L::sym(a, b)] -= f * dx[a][k];
          for (int a = 0; a < dim; ++a)
            sum[L::g_sum + a * dim + b] += f * dv[a][k];
          if constexpr (standard)
            sum[L::continuity_sum] -= mg[k] * dx[b][k] * dv[b][k];
        }
        sum[L::shepard_sum] += shepard[k];
        sum[L::stiffness_sum] -= stiffness[k];
      }
    }
    store_sums<n_sums>(sum, s.sums + i * L::gradient_stride);
  }
}
} // namespace ogive::sph
