// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/correction/weights.h"

namespace ogive::sph
{
namespace detail
{
/// Loads the neighbours of particle i and calls f(p, record, r).
template <int dim, std::size_t stride, int n_fields, class F>
inline void over_correction_records(const Sweep &s, std::size_t i, F &&f)
{
  using L           = Layout<dim>;
  const double *own = s.correction_records + i * stride;
  for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
  {
    VDouble j[padded(n_fields)], r2 = 0.;
    load_records<n_fields>(s.correction_records, stride, s.index + p, j);
    for (int a = 0; a < dim; ++a)
      r2 += (own[L::x + a] - j[L::x + a]) * (own[L::x + a] - j[L::x + a]);
    f(p, j, VDouble(r2 * reciprocal_root(VDouble(r2 + 1e-300))));
  }
}
} // namespace detail

/// Adds the corrected viscous force to the f_sum of the force sums.
template <int dim, class Kernel, bool shepard, bool variable>
[[gnu::flatten]] void correction_sweep(const Sweep &s)
{
  using L      = Layout<dim>;
  using Weight = CorrectionWeight<dim, Kernel, shepard, variable>;
  const Weight weight(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.correction_records + i * Weight::stride;
    VDouble       sum[padded(dim)];
    for (auto &a : sum)
      a = 0.;
    detail::over_correction_records<dim, Weight::stride, Weight::n_fields>(
      s, i, [&](std::size_t, const VDouble *j, const VDouble &r) {
        const VDouble w = weight(own, j, r);
        for (int a = 0; a < dim; ++a)
          sum[a] += w * (own[L::da + a] - j[L::da + a]);
      });
    double total[padded(dim)];
    store_sums<dim>(sum, total);
    for (int a = 0; a < dim; ++a)
      s.sums[i * L::forces_stride + L::f_sum + a] += total[a];
  }
}

/// Heating by the corrected pair forces, -K_ij (da_i - da_j).v_ij, added to the
/// viscous power. Of the pairwise form; energy_sweep does the fixed support of
/// the current configuration on its way.
template <int dim, class Kernel, bool variable>
[[gnu::flatten]] void correction_power_sweep(const Sweep &s)
{
  using L      = Layout<dim>;
  using Weight = CorrectionWeight<dim, Kernel, false, variable>;
  const Weight weight(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.correction_records + i * Weight::stride;
    const double *v   = s.energy_records + i * L::energy_stride;
    VDouble       sum[padded(1)];
    for (auto &a : sum)
      a = 0.;
    detail::over_correction_records<dim, Weight::stride, Weight::n_fields>(
      s, i, [&](std::size_t p, const VDouble *j, const VDouble &r) {
        VDouble e[L::energy_stride], dot = 0.;
        load_records<2 * dim + 1>(s.energy_records, L::energy_stride, s.index + p, e);
        for (int a = 0; a < dim; ++a)
          dot += (own[L::da + a] - j[L::da + a]) * (v[L::v + a] - e[L::v + a]);
        sum[0] -= weight(own, j, r) * dot;
      });
    double total[padded(1)];
    store_sums<1>(sum, total);
    s.sums[i * L::powers_stride + L::viscous_power] += total[0];
  }
}

/// Sums that the support rules ask for, over wide correction records whose
/// `da` holds any vector field q: sum V_j W at the pair's support, sum V_j W f_j
/// of the scalar `kappa`, sum V_j W |q_j - q_i|, and of their parts along x_ij
/// the sum and the sum of sizes.
template <int dim, class Kernel>
[[gnu::flatten]] void mean_sweep(const Sweep &s)
{
  using L      = Layout<dim>;
  using Weight = CorrectionWeight<dim, Kernel, false, true>;
  const Weight weight(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.correction_records + i * Weight::stride;
    VDouble       sum[L::means_stride];
    for (auto &a : sum)
      a = 0.;
    detail::over_correction_records<dim, Weight::stride, Weight::n_fields>(
      s, i, [&](std::size_t, const VDouble *j, const VDouble &r) {
        const VDouble w = j[L::volume] * weight.value(own, j, r);
        VDouble       square = 0., along = 0.;
        for (int a = 0; a < dim; ++a)
        {
          const VDouble d = own[L::da + a] - j[L::da + a];
          square += d * d;
          along += d * (own[L::x + a] - j[L::x + a]);
        }
        sum[L::share_mean] += w;
        sum[L::field_mean] += w * j[L::kappa];
        sum[L::variation] += w * stdx::sqrt(square);
        sum[L::along] += w * along;
        sum[L::along_size] += w * stdx::fabs(along);
      });
    store_sums<L::n_means>(sum, s.sums + i * L::means_stride);
  }
}
} // namespace ogive::sph
