// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// Pairwise acceleration correction: the viscous force m_i da_i is replaced by
/// sum_j K_ij (da_i - da_j), K_ij = V_i V_j W(x_ij; h_c) min(rho_i/s_i,
/// rho_j/s_j), s the Shepard sum with self. With one density this is
/// m_i m_j W/(rho max(s_i, s_j)); the minimum keeps the row sums of K/m below 1
/// whatever the densities, hence the spectrum in [0, 2). K is symmetric:
/// momentum is exact, constants die.
template <int dim, class Kernel>
struct PairwiseCorrection
{
  using L = Layout<dim>;
  KernelAt<Kernel, dim> kernel;

  /// K over volume, for the lanes j of a correction record.
  VDouble weight(const double *own, const VDouble *j, const VDouble &r) const
  {
    return (own[L::volume] * j[L::volume]) * stdx::min(VDouble(own[L::kappa]), j[L::kappa]) * kernel.value(r);
  }
};

template <int dim, class Kernel>
[[gnu::flatten]] void correction_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  const PairwiseCorrection<dim, Kernel> k{KernelAt<Kernel, dim>(s.h * s.support)};
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.correction_records + i * L::correction_stride;
    VDouble       sum[padded(dim)];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[L::correction_stride];
      load_records<2 * dim + 2>(s.correction_records, L::correction_stride, s.index + p, j);
      VDouble r2 = 0.;
      for (int a = 0; a < dim; ++a)
        r2 += (own[L::x + a] - j[L::x + a]) * (own[L::x + a] - j[L::x + a]);
      const VDouble w = k.weight(own, j, stdx::sqrt(r2));
      for (int a = 0; a < dim; ++a)
        sum[a] += w * (own[L::da + a] - j[L::da + a]);
    }
    double total[padded(dim)];
    store_sums<dim>(sum, total);
    for (int a = 0; a < dim; ++a)
      s.sums[i * L::forces_stride + L::f_sum + a] += total[a];
  }
}
} // namespace ogive::sph
