// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace ogive::sph
{
/// Where the fields of a packed neighbour record lie, in doubles.
template <int dim>
struct Layout
{
  static constexpr int n_sym = dim * (dim + 1) / 2;

  /// Motion: all that the gradient needs.
  static constexpr int x = 0, v = dim, weight = 2 * dim, density = 2 * dim + 1, n_motion = 2 * dim + 2;
  /// Force: motion, then sound speed, P, the symmetric gradient, damage.
  static constexpr int         sound = n_motion, p = sound + 1, rate = p + dim * dim, damage = rate + n_sym;
  static constexpr int         n_force      = damage + 1;
  static constexpr std::size_t force_stride = padded(n_force);
  /// Correction: x, the viscous acceleration, volume, kappa = rho/shepard.
  static constexpr int         da = dim, volume = 2 * dim, kappa = 2 * dim + 1;
  static constexpr std::size_t correction_stride = padded(2 * dim + 2);
  /// Energy: x, mean velocity of the kick, weight.
  static constexpr std::size_t energy_stride = padded(2 * dim + 1);

  /// Sums of the gradient sweep: moment matrix M, G = sum w_j (v_j - v_i) (x)
  /// gradW, the Shepard sum without self, sum V_j |gradW|, sum V_j gradW, and
  /// (standard form) d(rho)/dt.
  static constexpr int m_sum = 0, g_sum = n_sym, shepard_sum = g_sum + dim * dim, stiffness_sum = shepard_sum + 1,
                       normal_sum = stiffness_sum + 1, continuity_sum = normal_sum + dim,
                       n_gradient = continuity_sum + 1;
  static constexpr std::size_t gradient_stride = padded(n_gradient);
  /// Sums of the force sweep: force, viscous force, damping rates of the
  /// viscosity and of the hourglass control (1/s, times the mass).
  static constexpr int f_sum = 0, viscous_sum = dim, viscous_rate = 2 * dim, hourglass_rate = 2 * dim + 1,
                       n_forces = 2 * dim + 2;
  static constexpr std::size_t forces_stride = padded(n_forces);
  /// Sums of the energy sweep: stress power over w_i, twice the viscous and twice the hourglass heating, W.
  static constexpr int         stress_power = 0, viscous_power = 1, hourglass_power = 2;
  static constexpr std::size_t powers_stride = padded(3);

  /// Index of (a, b) in a symmetric tensor: xx yy zz xy yz zx; 2-D: xx yy xy.
  static constexpr int sym(int a, int b)
  {
    if (a == b)
      return a;
    if constexpr (dim == 2)
      return 2;
    return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
  }
};

/// One body's share of a sweep over its directed pairs. Row i of `index` is
/// [row[i], row[i+1]), a whole number of registers; entries that fill it up
/// name a record of zeros.
struct Sweep
{
  std::size_t          begin = 0, end = 0; ///< owned particles
  const std::size_t   *row   = nullptr;
  const std::uint32_t *index = nullptr;
  const double        *force_records      = nullptr; ///< motion and force
  const double        *correction_records = nullptr;
  const double        *energy_records     = nullptr;
  double              *sums               = nullptr; ///< one record of sums a particle
  /// One number a directed pair, kept from the force to the energy sweep:
  /// central force over x_ij of viscosity and of hourglass control, N/m.
  double *pair_viscosity = nullptr, *pair_hourglass = nullptr;

  double h = 0, alpha = 0, beta = 0, hourglass = 0;
  double support = 1; ///< h_c/h of the correction
};

/// Sweeps for one choice of kernel, form, correction and damage.
struct SweepFunctions
{
  void (*gradient)(const Sweep &)   = nullptr;
  void (*force)(const Sweep &)      = nullptr;
  void (*correction)(const Sweep &) = nullptr; ///< adds to the f_sum of the force sums
  void (*energy)(const Sweep &)     = nullptr;
};

struct SweepChoice
{
  bool standard   = false;
  bool correction = false;
  bool damage     = false;
};

/// Instantiated for dim 1, 2, 3; InputError for an unknown kernel.
template <int dim>
SweepFunctions choose_sweeps(const SweepChoice &, const std::string &kernel);
} // namespace ogive::sph
