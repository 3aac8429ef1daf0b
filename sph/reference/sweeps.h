// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"
#include "sph/reference/layout.h"

/// Pair sums over the lattice of t = 0. With X, V0 the positions and volumes of
/// t = 0, g0 = W'/R of a pair then, w_ij = -V0_j g0 >= 0 and B0 the inverse of
/// sum_j w_ij X_ij (x) X_ij:
///  gradient    F_i = [sum_j w_ij x_ij (x) X_ij] B0_i, and dF/dt with v for x;
///  stress      f_ij = V0_i V0_j g0 (P_i B0_i + P_j B0_j) X_ij, P = J sigma F^-T,
///              the transpose of the gradient;
///  hourglass   of what the gradient does not see, z^i_ij = x_ij - F_i X_ij,
///              with the potential 1/2 sum_i V0_i c_i sum_j w_ij |z^i_ij|^2:
///              f_ij = V0_i V0_j g0 (c_i z^i_ij + c_j z^j_ij).
/// F_i X_ij is the least-squares fit of x_ij with the weights w_ij, so that
/// sum_j w_ij z^i_ij (x) X_ij = 0: the change of F with x adds nothing to the
/// force, and each particle's sum of torques is nothing. Momentum, angular
/// momentum and the potential are exact; a turned body has turned forces.
/// The potential is that of S. A. Silling, Comput. Methods Appl. Mech. Eng. 322
/// (2017) 42, for peridynamics, where w_ij is any weight.
/// Where B0 fell back to the unit matrix F is no fit, and these claims fail.
namespace ogive::sph
{
/// sum_j V0_j (v_j - v_i) (x) gradW0 into the g_sum of the gradient sums.
template <int dim>
[[gnu::flatten]] void reference_gradient_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.force_records + i * L::force_stride;
    VDouble       sum[padded(dim * dim)];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(L::weight + 1)];
      load_records<L::weight + 1>(s.force_records, L::force_stride, s.index + p, j);
      const VDouble vg = j[L::weight] * VDouble(s.pair_slope + p, stdx::vector_aligned);
      for (int b = 0; b < dim; ++b)
      {
        const VDouble f = vg * (own[L::x + b] - j[L::x + b]);
        for (int a = 0; a < dim; ++a)
          sum[a * dim + b] += f * (j[L::v + a] - own[L::v + a]);
      }
    }
    double total[padded(dim * dim)];
    store_sums<dim * dim>(sum, total);
    for (int k = 0; k < dim * dim; ++k)
      s.sums[i * L::gradient_stride + L::g_sum + k] = total[k];
  }
}

/// Pair forces: T_i = P_i B0_i - c_i F_i, so that both come from one product,
/// and the viscous hourglass control of force.h on present velocities. As there
/// the force of a pair is antisymmetric to the bit.
template <int dim>
[[gnu::flatten]] void reference_force_sweep(const Sweep &s)
{
  using L        = Layout<dim>;
  using R        = ReferenceLayout<dim>;
  const double z = .25 * s.hourglass * s.h;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.reference_records + i * R::stride;
    VDouble       sum[L::forces_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[padded(R::n_fields)];
      load_records<R::n_fields>(s.reference_records, R::stride, s.index + p, j);
      VDouble dX[dim], dx[dim], r2 = 0., vx = 0., stretch = 0.;
      for (int a = 0; a < dim; ++a)
      {
        dX[a] = own[R::reference + a] - j[R::reference + a];
        dx[a] = own[R::x + a] - j[R::x + a];
        r2 += dx[a] * dx[a];
        vx += (own[R::v + a] - j[R::v + a]) * dx[a];
      }
      for (int a = 0; a < dim; ++a)
      {
        VDouble d = 0.;
        for (int b = 0; b < dim; ++b)
          d += (own[R::rate + L::sym(a, b)] + j[R::rate + L::sym(a, b)]) * dx[b];
        stretch += d * dx[a];
      }
      const VDouble pull    = (own[R::volume] * j[R::volume]) * VDouble(s.pair_slope + p, stdx::vector_aligned);
      const VDouble inv_r2  = 1. / (r2 + 1e-24 * s.h * s.h);
      const VDouble rate    = (z * pull) * ((own[R::sound] + j[R::sound]) * (own[R::density] + j[R::density])) * inv_r2;
      const VDouble modulus = own[R::modulus] + j[R::modulus];
      VDouble       hourglass = rate * (vx - .5 * stretch);
      hourglass               = select(hourglass * vx > 0., VDouble(0.), hourglass);
      hourglass.copy_to(s.pair_hourglass + p, stdx::vector_aligned);
      for (int a = 0; a < dim; ++a)
      {
        VDouble t = modulus * dx[a];
        for (int b = 0; b < dim; ++b)
          t += (own[R::t + a * dim + b] + j[R::t + a * dim + b]) * dX[b];
        sum[L::f_sum + a] += pull * t + hourglass * dx[a];
      }
      sum[L::hourglass_rate] -= rate * r2;
    }
    store_sums<L::n_forces>(sum, s.sums + i * L::forces_stride);
  }
}

/// Powers of the forces of t_n on the mean velocity of the kick, as in energy.h:
/// a particle's own stress and its own share of the hourglass potential. Heat of
/// the viscosity has sweeps of its own.
template <int dim>
[[gnu::flatten]] void reference_energy_sweep(const Sweep &s)
{
  using L = Layout<dim>;
  using R = ReferenceLayout<dim>;
  for (std::size_t i = s.begin; i < s.end; ++i)
  {
    const double *own = s.energy_records + i * L::energy_stride, *own_reference = s.reference_records + i * R::stride;
    const double *stress = s.force_records + i * L::force_stride + L::p;
    const double *f      = s.deformation + i * dim * dim; // column by column
    const double  twice  = 2 * own[L::weight] * own_reference[R::modulus];
    VDouble       sum[L::powers_stride];
    for (auto &a : sum)
      a = 0.;
    for (std::size_t p = s.row[i]; p < s.row[i + 1]; p += simd_width)
    {
      VDouble j[L::energy_stride], reference[padded(dim)], dX[dim], vx = 0., stress_part = 0., unseen = 0.;
      load_records<L::weight + 1>(s.energy_records, L::energy_stride, s.index + p, j);
      load_records<dim>(s.reference_records, R::stride, s.index + p, reference);
      for (int a = 0; a < dim; ++a)
        dX[a] = own_reference[R::reference + a] - reference[a];
      for (int a = 0; a < dim; ++a)
      {
        const VDouble dx = own[L::x + a] - j[L::x + a], dv = own[L::v + a] - j[L::v + a];
        VDouble       t = 0., fit = 0.;
        for (int b = 0; b < dim; ++b)
        {
          t += stress[a * dim + b] * dX[b];
          fit += f[b * dim + a] * dX[b];
        }
        stress_part += t * dv;
        unseen += (dx - fit) * dv;
        vx += dx * dv;
      }
      const VDouble wg = j[L::weight] * VDouble(s.pair_slope + p, stdx::vector_aligned);
      sum[L::stress_power] -= wg * stress_part;
      sum[L::hourglass_power] -= twice * (wg * unseen) + VDouble(s.pair_hourglass + p, stdx::vector_aligned) * vx;
    }
    store_sums<3>(sum, s.sums + i * L::powers_stride);
  }
}
} // namespace ogive::sph
