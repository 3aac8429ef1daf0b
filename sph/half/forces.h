// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/half/half.h"
#include "sph/kernels/kernels.h"
#include "sph/viscosity/limiter.h"

namespace ogive::sph
{
/// Stress, hourglass control (force.h) and Monaghan's viscosity in its two parts
/// (viscous_sweep.h), all in one sweep of the corrected form: the shares of
/// viscosity that act as they are go to the force, those for the correction
/// to weak_sum, all damping rates, weighed for the step bound, to `damping`.
/// `half`: each pair once; else the directed pairs with images or riders.
template <int dim, class Kernel, bool limited, bool damage, bool half>
[[gnu::flatten]] void joint_force_sweep(const Sweep &s)
{
  using L                = Layout<dim>;
  constexpr int n_fields = L::n_force, n_sums = L::n_joint;
  const KernelAt<Kernel, dim> kernel(s.h);
  const double z = .25 * s.hourglass * s.h, soft = .01 * s.h * s.h, half_alpha = .5 * s.alpha;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    double        c_i, share_i;
    SoundAndShare::unpack(own[L::sound], c_i, share_i);
    VDouble sum[L::forces_stride];
#pragma GCC unroll 32
    for (auto &a : sum)
      a = 0.;
    if constexpr (half)
    {
      ask_ahead<3>(s, i, s.force_records, L::force_stride);
      ask_ahead<1>(s, i, s.sums, L::forces_stride);
    }
    const std::size_t last = half ? s.half[i] : s.row[i + 1];
    for (std::size_t p = s.row[i]; p < last; p += simd_width)
    {
      VDouble j[padded(n_fields)];
      load_records<n_fields>(s.force_records, L::force_stride, s.index + p, j);
      VDouble weight_j = j[L::weight];
      if constexpr (half)
        weight_j = HalfRow(s, i).mine(p, weight_j);
      VDouble dx[dim], r2 = 0., vx = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dx[a] = own[L::x + a] - j[L::x + a];
        r2 += dx[a] * dx[a];
        vx += (own[L::v + a] - j[L::v + a]) * dx[a];
      }
      const VDouble inv_r = kernel.inverse_distance(r2), r = r2 * inv_r;
      const VDouble g = kernel.slope(r, inv_r) * (own[L::weight] * weight_j);
      VDouble       c_j, share_j;
      SoundAndShare::unpack(j[L::sound], c_j, share_j);
      const VDouble c2 = c_i + c_j, rho2 = own[L::density] + j[L::density];

      VDouble t[dim], gi = 0., gj = 0.;
      for (int a = 0; a < dim; ++a)
      {
        t[a] = 0.;
        for (int b = 0; b < dim; ++b)
          t[a] += (own[L::p + a * dim + b] + j[L::p + a * dim + b]) * dx[b];
        for (int b = a; b < dim; ++b)
        {
          const VDouble xx = (a == b ? 1. : 2.) * (dx[a] * dx[b]);
          gi += own[L::rate + L::sym(a, b)] * xx;
          gj += j[L::rate + L::sym(a, b)] * xx;
        }
      }
      VDouble rate = (z * g) * (c2 * rho2) * (inv_r * inv_r);
      if constexpr (damage)
        rate *= (1. - s.damage[i]) * (1. - load_numbers(s.damage, s.index + p));
      VDouble hourglass = rate * (vx - .5 * (gi + gj));
      hourglass         = select(hourglass * vx > 0., VDouble(0.), hourglass);

      const VDouble approach = stdx::min(vx, VDouble(0.));
      const VDouble limit    = limited ? limited_jump(vx, gi, gj) : approach;
      const VDouble share    = stdx::max(VDouble(share_i), share_j);
      const VDouble distance = r2 + soft, inverse = reciprocal(VDouble(distance * rho2));
      const VDouble per_jump = s.h * inverse * rho2, ac = half_alpha * c2;
      const VDouble masses   = -g * (own[L::density] * j[L::density]);
      const VDouble scale    = masses * (2. * inverse * distance); // over the mean density
      const VDouble mu = approach * per_jump, weak_mu = limit * per_jump;
      const VDouble direct = share * scale * mu * (s.beta * mu - ac);
      const VDouble weak   = (1. - share) * scale * weak_mu * (s.beta * weak_mu - ac);
      const VDouble damping = masses * r2 * ((ac - 2. * s.beta * mu) * (2. * s.h * inverse));
      const std::size_t q = half ? p - s.row[i] + s.half_at[i] : p;
      hourglass.copy_to(s.pair_hourglass + s.hourglass_step * q, stdx::vector_aligned);
      direct.copy_to(s.pair_viscosity + s.viscosity_step * q, stdx::vector_aligned);

      VDouble       pair[L::forces_stride];
      const VDouble central = hourglass + direct;
#pragma GCC unroll 32
      for (auto &a : pair)
        a = 0.;
      for (int a = 0; a < dim; ++a)
      {
        pair[L::f_sum + a]    = g * t[a] + central * dx[a];
        pair[L::weak_sum + a] = weak * dx[a];
      }
      pair[L::damping] = damping * (s.weak_share + (s.direct_share - s.weak_share) * share) - s.hourglass_share * (rate * r2);
#pragma GCC unroll 32
      for (int f = 0; f < n_sums; ++f)
        sum[f] += pair[f];
      if constexpr (half)
      {
#pragma GCC unroll 32
        for (int f = 0; f < n_sums; ++f)
          if (f != L::damping)
            pair[f] = -pair[f];
        add_records<n_sums>(pair, s.sums, L::forces_stride, s.index + p);
      }
    }
    if constexpr (half)
      add_sums<n_sums>(sum, s.sums + i * L::forces_stride);
    else
      store_sums<n_sums>(sum, s.sums + i * L::forces_stride);
  }
}
} // namespace ogive::sph
