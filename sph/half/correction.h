// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/correction/weights.h"
#include "sph/half/half.h"

namespace ogive::sph
{
/// correction_sweep (correction/correction_sweep.h), pairwise with one support.
template <int dim, class Kernel>
[[gnu::flatten]] void half_correction_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  const KernelAt<Kernel, dim>                       kernel(s.h);
  const CorrectionWeight<dim, Kernel, false, false> weight(s);
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.correction_records + i * L::correction_stride;
    const HalfRow row(s, i);
    VDouble       sum[padded(dim)];
#pragma GCC unroll 32
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = row.begin; p < row.end; p += simd_width)
    {
      VDouble j[L::correction_stride], pair[padded(dim)], r2 = 0.;
      load_records<2 * dim + 2>(s.correction_records, L::correction_stride, s.index + p, j);
      for (int a = 0; a < dim; ++a)
        r2 += (own[L::x + a] - j[L::x + a]) * (own[L::x + a] - j[L::x + a]);
      const VDouble k = row.mine(p, weight(own, j, VDouble(r2 * kernel.inverse_distance(r2))));
#pragma GCC unroll 32
      for (auto &a : pair)
        a = 0.;
      for (int a = 0; a < dim; ++a)
      {
        const VDouble f = k * (own[L::da + a] - j[L::da + a]);
        sum[a] += f;
        pair[a] = -f;
      }
      add_records<dim>(pair, s.sums + L::f_sum, L::forces_stride, s.index + p);
    }
    double total[padded(dim)];
    store_sums<dim>(sum, total);
    for (int a = 0; a < dim; ++a)
      s.sums[i * L::forces_stride + L::f_sum + a] += total[a];
  }
}
} // namespace ogive::sph
