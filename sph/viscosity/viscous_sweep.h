// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/reference/layout.h"
#include "sph/sweep.h"
#include "sph/viscosity/limiter.h"
#include "sph/viscosity/pair.h"

#include <type_traits>

namespace ogive::sph
{
/// A kernel that moves with the material: gradW = F^-T gradW0/J with the pair's
/// own stretch for F, g = g0 (R/r)^2 rho/rho0. In a uniform swelling it is the
/// kernel with h swollen.
template <int dim>
struct KernelAt<KeptSlope, dim>
{
  double tiny;

  explicit KernelAt(double h)
    : tiny(1e-24 * h * h)
  {}
  template <class T>
  T inverse_distance(const T &r2) const
  {
    return reciprocal_root(T(r2 + tiny));
  }
};

/// Viscous pair forces in two parts, F = psi Pi(v_ij) + (1 - psi) Pi(limited
/// jump), psi the larger shock share of the two ends. The second part is weak
/// viscosity: it goes to the correction (Sweep::keep_weak 0) or acts as it is
/// (1). What acts as it is is kept pair by pair for the energy sweep.
template <int dim, class Kernel, class Viscosity, bool limited>
[[gnu::flatten]] void viscous_sweep(const Sweep &s)
{
  using L                = ViscousLayout<dim>;
  constexpr int law      = L::extra, rate = L::extra + Viscosity::n_fields;
  constexpr int n_fields = rate + (limited ? L::n_sym : 0), n = Viscosity::n_terms;
  constexpr std::size_t       stride = L::stride(Viscosity::n_fields, limited);
  const KernelAt<Kernel, dim> kernel(s.h);
  const Viscosity             viscosity{s.alpha, s.beta, s.h};
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.viscous_records + i * stride;
    VDouble       sum[L::sums_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(n_fields)];
      load_records<n_fields>(s.viscous_records, stride, s.index + p, j);
      ViscousPair<dim> pair;
      pair.r2 = 0.;
      pair.vx = 0.;
      for (int a = 0; a < dim; ++a)
      {
        pair.dx[a] = own[L::x + a] - j[L::x + a];
        pair.dv[a] = own[L::v + a] - j[L::v + a];
        pair.r2 += pair.dx[a] * pair.dx[a];
        pair.vx += pair.dv[a] * pair.dx[a];
      }
      pair.inv_r = kernel.inverse_distance(pair.r2);
      pair.c2    = own[L::sound] + j[L::sound];
      pair.rho2  = own[L::density] + j[L::density];
      pair.rho_i = own[L::density];
      pair.c_i   = own[L::sound];
      // The records of zeros that fill a row have no mass, but must not divide by it.
      pair.rho_j = select(j[L::density] > 0., j[L::density], VDouble(1.));
      pair.c_j   = j[L::sound];
      if constexpr (limited)
      {
        VDouble gi = 0., gj = 0.;
        for (int a = 0; a < dim; ++a)
          for (int b = a; b < dim; ++b)
          {
            const VDouble xx = (a == b ? 1. : 2.) * (pair.dx[a] * pair.dx[b]);
            gi += own[rate + L::sym(a, b)] * xx;
            gj += j[rate + L::sym(a, b)] * xx;
          }
        pair.limited = limited_jump(pair.vx, gi, gj);
      }
      else
        pair.limited = stdx::min(pair.vx, VDouble(0.));

      VDouble slope;
      if constexpr (std::is_same_v<Kernel, KeptSlope>)
        slope = VDouble(s.pair_viscous_slope + p, stdx::vector_aligned) * pair.rho2 * (pair.inv_r * pair.inv_r);
      else
        slope = kernel.slope(VDouble(pair.r2 * pair.inv_r), pair.inv_r);
      const VDouble scale = -(own[L::mass] * j[L::mass]) * slope;
      const VDouble pull  = scale * (.5 * (own[L::strength] + j[L::strength]));
      const VDouble shock = stdx::max(VDouble(own[L::split]), j[L::split]);
      const auto    terms = viscosity(pair, own + law, j + law);
      const VDouble raw = pull * shock, rest = pull * (1. - shock);
      const VDouble kept = s.keep_weak * rest, given = (1. - s.keep_weak) * rest;
      for (int k = 0; k < n; ++k)
      {
        const VDouble direct = raw * terms.raw[k] + kept * terms.weak[k], weak = given * terms.weak[k];
        direct.copy_to(s.pair_viscosity + s.viscosity_step * (k * s.n_entries + p), stdx::vector_aligned);
        weak.copy_to(s.pair_weak + s.weak_step * (k * s.n_entries + p), stdx::vector_aligned);
        if constexpr (Viscosity::central)
          for (int a = 0; a < dim; ++a)
          {
            sum[L::direct_sum + a] += direct * pair.dx[a];
            sum[L::weak_sum + a] += weak * pair.dx[a];
          }
        else
        {
          sum[L::direct_sum + k] += direct;
          sum[L::weak_sum + k] += weak;
        }
      }
      const VDouble damping = scale * terms.rate * pair.r2;
      sum[L::direct_rate] += damping * (shock + s.keep_weak * (1. - shock));
      sum[L::weak_rate] += damping * ((1. - s.keep_weak) * (1. - shock));
    }
    store_sums<L::n_sums>(sum, s.sums + i * L::sums_stride);
  }
}

/// Heating by pair forces that were kept, -F_ij.v_ij, added to `field` of the
/// power sums; of central forces what was kept is the force over x_ij.
template <int dim, bool central>
[[gnu::flatten]] void pair_power_sweep(const Sweep &s, const double *pair_force, int field)
{
  using L = Layout<dim>;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.energy_records + i * L::energy_stride;
    VDouble       sum[padded(1)];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[L::energy_stride];
      load_records<2 * dim + 1>(s.energy_records, L::energy_stride, s.index + p, j);
      VDouble power = 0.;
      if constexpr (central)
      {
        for (int a = 0; a < dim; ++a)
          power += (own[L::x + a] - j[L::x + a]) * (own[L::v + a] - j[L::v + a]);
        power *= VDouble(pair_force + p, stdx::vector_aligned);
      }
      else
        for (int a = 0; a < dim; ++a)
          power += VDouble(pair_force + a * s.n_entries + p, stdx::vector_aligned) * (own[L::v + a] - j[L::v + a]);
      sum[0] -= power;
    }
    double total[padded(1)];
    store_sums<1>(sum, total);
    s.sums[i * L::powers_stride + field] += total[0];
  }
}
} // namespace ogive::sph
