// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// Pair forces at x^n. Every factor that both ends share is written so that it
/// comes out the same from either end (products and sums of the two ends
/// first): the force of a pair is antisymmetric to the bit.
///  stress     F = w_i w_j (P_i + P_j) gradW
///  hourglass  F = z rho c h V_i V_j (W'/r) (d_ij . r^) r^ (1-D_i)(1-D_j),
///             d_ij = v_ij - 1/2 (L_i + L_j) x_ij, zero where it would drive
/// Damage softens the stress of a point itself; the pair carries what its two
/// ends have. (A factor (1 - |D_i - D_j|)^2 on pairs in tension, as the
/// literature has it, leaves the gradient as it was: force and gradient are then
/// no longer transposed, and whole material beside broken material draws
/// energy from its stress without end.)
template <int dim, class Kernel, bool standard, bool damage>
[[gnu::flatten]] void force_sweep(const Sweep &s)
{
  using L                = Layout<dim>;
  constexpr int n_fields = L::n_force;
  const KernelAt<Kernel, dim> kernel(s.h);
  const double                z = .25 * s.hourglass * s.h; // means of rho and c: 1/4
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    VDouble       sum[L::forces_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(n_fields)];
      load_records<n_fields>(s.force_records, L::force_stride, s.index + p, j);
      VDouble dx[dim], r2 = 0., vx = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        r2 += dx[a] * dx[a];
        vx += (own[L::v + a] - j[L::v + a]) * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble g  = kernel.slope(r, inv_r);
      const VDouble ww = own[L::weight] * j[L::weight];
      const VDouble c2 = own[L::sound] + j[L::sound], rho2 = own[L::density] + j[L::density];

      VDouble t[dim], stretch = 0.;
      for (int a = 0; a < dim; ++a)
      {
        t[a]         = 0.;
        VDouble d    = 0.;
        for (int b = 0; b < dim; ++b)
        {
          t[a] += (own[L::p + a * dim + b] + j[L::p + a * dim + b]) * dx[b];
          d += (own[L::rate + L::sym(a, b)] + j[L::rate + L::sym(a, b)]) * dx[b];
        }
        stretch += d * dx[a];
      }

      VDouble vol2 = ww;
      if constexpr (standard)
      {
        const VDouble rr = own[L::density] * j[L::density];
        vol2             = select(rr > 0., VDouble(ww / rr), VDouble(0.));
      }
      const VDouble delta = vx - .5 * stretch;
      VDouble       rate  = (z * (vol2 * g)) * (c2 * rho2) * (inv_r * inv_r);
      if constexpr (damage)
        rate *= (1. - s.damage[i]) * (1. - load_numbers(s.damage, s.index + p));
      VDouble hourglass = rate * delta;
      hourglass         = select(hourglass * vx > 0., VDouble(0.), hourglass);
      hourglass.copy_to(s.pair_hourglass + p, stdx::vector_aligned);

      for (int a = 0; a < dim; ++a)
        sum[L::f_sum + a] += g * ww * t[a] + hourglass * dx[a];
      sum[L::hourglass_rate] -= rate * r2;
    }
    store_sums<L::n_forces>(sum, s.sums + i * L::forces_stride);
  }
}
} // namespace ogive::sph
