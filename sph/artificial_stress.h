// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// Artificial stress against the tensile instability: Gray, Monaghan and Swift,
/// Comput. Methods Appl. Mech. Eng. 190 (2001) 6641. F_ij = V_i V_j (W/W(dx))^4
/// (R_i + R_j) gradW, R = -epsilon sigma_k e_k (x) e_k over the principal
/// stresses in tension. Adds forces (`power` false) or their heating of each
/// end, -F_ij.v_ij, to the hourglass power (true).
template <int dim, class Kernel, bool power>
[[gnu::flatten]] void artificial_stress_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  using S = StressLayout<dim>;
  const KernelAt<Kernel, dim> kernel(s.h);
  const double                inverse = 1 / kernel.value(s.spacing);
  constexpr int               n       = power ? 1 : dim;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.stress_records + i * S::stride;
    VDouble       sum[padded(dim)];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(S::n_fields)], dx[dim], r2 = 0.;
      load_records<S::n_fields>(s.stress_records, S::stride, s.index + p, j);
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[S::x + a] - j[S::x + a];
        r2 += dx[a] * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble f = kernel.value(r) * inverse, f2 = f * f;
      const VDouble scale = (own[S::volume] * j[S::volume]) * kernel.slope(r, inv_r) * (f2 * f2);
      VDouble       e[L::energy_stride];
      if constexpr (power)
        load_records<2 * dim + 1>(s.energy_records, L::energy_stride, s.index + p, e);
      for (int a = 0; a < dim; ++a)
      {
        VDouble t = 0.;
        for (int b = 0; b < dim; ++b)
          t += (own[S::r + L::sym(a, b)] + j[S::r + L::sym(a, b)]) * dx[b];
        if constexpr (power)
          sum[0] -= scale * t * (s.energy_records[i * L::energy_stride + L::v + a] - e[L::v + a]);
        else
          sum[a] += scale * t;
      }
    }
    double total[padded(dim)];
    store_sums<n>(sum, total);
    if constexpr (power)
      s.sums[i * L::powers_stride + L::hourglass_power] += total[0];
    else
      for (int a = 0; a < dim; ++a)
        s.sums[i * L::forces_stride + L::f_sum + a] += total[a];
  }
}
} // namespace ogive::sph
