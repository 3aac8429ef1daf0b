// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// sum m_j W(x_ij; h) without self, kg/m^dim, for density by summation; the mass
/// is in the weight of the standard form, weight times density otherwise.
template <int dim, class Kernel, bool standard>
[[gnu::flatten]] void density_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  const KernelAt<Kernel, dim> kernel(s.h);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    VDouble       sum[padded(1)];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(L::n_motion)], r2 = 0.;
      load_records<L::n_motion>(s.force_records, L::force_stride, s.index + p, j);
      for (int a = 0; a < dim; ++a)
        r2 += (own[L::x + a] - j[L::x + a]) * (own[L::x + a] - j[L::x + a]);
      VDouble mass = j[L::weight];
      if constexpr (!standard)
        mass *= j[L::density];
      sum[0] += mass * kernel.value(VDouble(stdx::sqrt(r2)));
    }
    double total[padded(1)];
    store_sums<1>(sum, total);
    s.sums[i * padded(1)] = total[0];
  }
}
} // namespace ogive::sph
