// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/half/half.h"
#include "sph/kernels/kernels.h"

namespace ogive::sph
{
/// The sums of gradient_sweep (gradient.h) of the corrected form.
template <int dim, class Kernel>
[[gnu::flatten]] void half_gradient_sweep(const Sweep &s)
{
  using L           = Layout<dim>;
  constexpr int n_sums = L::continuity_sum;
  const KernelAt<Kernel, dim> kernel(s.h), wide(s.h * s.support);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    const HalfRow row(s, i);
    VDouble       sum[L::gradient_stride];
#pragma GCC unroll 32
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = row.begin; p < row.end; p += simd_width)
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
      const VDouble g = row.mine(p, kernel.slope(r, inv_r));
      const VDouble w = row.mine(p, wide.value(r));
      // Without the volume of the other end; what changes its sign with the end is
      // subtracted there.
      VDouble pair[L::gradient_stride];
      for (int b = 0; b < dim; ++b)
      {
        const VDouble f         = g * dx[b];
        pair[L::normal_sum + b] = f;
        for (int a = 0; a <= b; ++a)
          pair[L::m_sum + L::sym(a, b)] = -f * dx[a];
        for (int a = 0; a < dim; ++a)
          pair[L::g_sum + a * dim + b] = f * dv[a];
      }
      pair[L::shepard_sum]   = w;
      pair[L::stiffness_sum] = -g * r;
#pragma GCC unroll 32
      for (int f = 0; f < n_sums; ++f)
        sum[f] += j[L::weight] * pair[f];
#pragma GCC unroll 32
      for (int f = 0; f < n_sums; ++f)
        pair[f] *= f >= L::normal_sum && f < L::normal_sum + dim ? -own[L::weight] : own[L::weight];
#pragma GCC unroll 32
      for (int f = n_sums; f < static_cast<int>(L::gradient_stride); ++f)
        pair[f] = 0.;
      add_records<n_sums>(pair, s.sums, L::gradient_stride, s.index + p);
    }
    add_sums<n_sums>(sum, s.sums + i * L::gradient_stride);
  }
}
} // namespace ogive::sph
