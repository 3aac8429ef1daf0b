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
  /// Force: motion, then P, sound speed (with the shock share, see half/half.h, where
  /// sweeps are joint), the symmetric gradient. In space that is three lines: an even
  /// number would leave most of the first-level cache's sets without a first line.
  static constexpr int         p = n_motion, sound = p + dim * dim, rate = sound + 1, n_force = rate + n_sym;
  static constexpr std::size_t force_stride = padded(n_force);
  /// Correction: x, the weak viscous acceleration, volume, kappa = rho/shepard;
  /// the wide one also h_c.
  static constexpr int         da = dim, volume = 2 * dim, kappa = 2 * dim + 1, reach = 2 * dim + 2;
  static constexpr std::size_t correction_stride = padded(2 * dim + 2), wide_correction_stride = padded(2 * dim + 3);
  /// Energy: x, mean velocity of the kick, weight; the last of P where the sweep is half.
  static constexpr int         last_p        = 2 * dim + 1;
  static constexpr std::size_t energy_stride = padded(2 * dim + 2);

  /// Sums of the gradient sweep: moment matrix M, G = sum w_j (v_j - v_i) (x)
  /// gradW, the Shepard sum without self, sum V_j |gradW|, sum V_j gradW, and
  /// (standard form) d(rho)/dt.
  static constexpr int m_sum = 0, g_sum = n_sym, shepard_sum = g_sum + dim * dim, stiffness_sum = shepard_sum + 1,
                       normal_sum = stiffness_sum + 1, continuity_sum = normal_sum + dim,
                       n_gradient = continuity_sum + 1;
  static constexpr std::size_t gradient_stride = padded(n_gradient);
  /// Sums of the force sweep: force, damping rate of the hourglass control (1/s,
  /// times the mass). Joint sweeps (half/forces.h) have all damping rates there,
  /// weighed for the step bound, then the viscous force for the correction.
  static constexpr int         f_sum = 0, hourglass_rate = dim, n_forces = dim + 1;
  static constexpr int         damping = dim, weak_sum = dim + 1, n_joint = 2 * dim + 1;
  static constexpr std::size_t forces_stride = padded(n_joint);
  /// Sums of the energy sweep: stress power over w_i, twice the viscous and twice the hourglass heating, W.
  static constexpr int         stress_power = 0, viscous_power = 1, hourglass_power = 2;
  static constexpr std::size_t powers_stride = padded(3);
  /// Sums of the mean sweep (correction_sweep.h).
  static constexpr int         share_mean = 0, field_mean = 1, variation = 2, along = 3, along_size = 4, n_means = 5;
  static constexpr std::size_t means_stride = padded(n_means);

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

/// Records and sums of the viscous sweep: motion, mass, density, sound speed,
/// the switch's factor and the shock share psi, then the fields of the
/// viscosity and, with the limiter, the symmetric velocity gradient. Sums:
/// forces that act as they are and forces for the correction, and their damping
/// rates (1/s, times the mass).
template <int dim>
struct ViscousLayout : Layout<dim>
{
  static constexpr int mass = 2 * dim, density = mass + 1, sound = mass + 2, strength = mass + 3, split = mass + 4,
                       extra = mass + 5;
  /// A record is as long as the viscosity and the limiter need.
  static constexpr std::size_t stride(int n_fields_of_viscosity, bool limited)
  {
    return padded(extra + n_fields_of_viscosity + (limited ? Layout<dim>::n_sym : 0));
  }
  static constexpr int direct_sum = 0, weak_sum = dim, direct_rate = 2 * dim, weak_rate = 2 * dim + 1,
                       n_sums = 2 * dim + 2;
  static constexpr std::size_t sums_stride = padded(n_sums);
};

/// Records of the sensor sweep (correction/sensor.h).
template <int dim>
struct SensorLayout
{
  static constexpr int         x = 0, volume = dim, divergence = dim + 1, n_fields = dim + 2;
  static constexpr std::size_t stride = padded(n_fields);
  static constexpr int jump = 0, size = 1, bend = 2, slope = 3, offset = dim + 3, n_sums = 2 * dim + 3;
  static constexpr std::size_t sums_stride = padded(n_sums);
};

/// Records of the artificial stress: x, volume, R.
template <int dim>
struct StressLayout
{
  static constexpr int         x = 0, volume = dim, r = dim + 1, n_fields = r + Layout<dim>::n_sym;
  static constexpr std::size_t stride = padded(n_fields);
};

/// One body's share of a sweep over its directed pairs. Row i of `index` is
/// [row[i], row[i+1]), a whole number of registers; entries that fill it up
/// name a record of zeros.
struct Sweep
{
  std::size_t          begin = 0, end = 0; ///< owned particles
  const std::size_t   *row   = nullptr;
  const std::uint32_t *index = nullptr;
  const std::size_t   *half = nullptr, *half_at = nullptr; ///< see NeighbourRows, where sweeps take each pair once
  const double        *force_records      = nullptr; ///< motion and force
  const double        *damage             = nullptr; ///< by record
  const double        *viscous_records    = nullptr;
  const double        *sensor_records     = nullptr;
  const double        *stress_records     = nullptr;
  const double        *correction_records = nullptr;
  const double        *energy_records     = nullptr;
  const double        *reference_records  = nullptr; ///< of the reference configuration (reference/), like the next three
  const double        *deformation        = nullptr; ///< F of the owned particles, column by column
  const double        *pair_slope         = nullptr; ///< g0 of each directed pair, gradW0 = X_ij g0
  const double        *pair_viscous_slope = nullptr; ///< g0 R^2/(rho0_i + rho0_j), see viscous_sweep.h
  double              *sums               = nullptr; ///< one record of sums a particle
  /// Kept from the force sweeps to the energy sweep, one number a directed pair
  /// and component, components n_entries apart: central force over x_ij of the
  /// hourglass control, of the viscosity that acts as it is, and (where the
  /// energy form asks) of the weak one, N/m; of a viscosity with forces that are
  /// not central their components, N.
  double     *pair_hourglass = nullptr, *pair_viscosity = nullptr, *pair_weak = nullptr;
  std::size_t n_entries = 0;
  /// 0 where nobody asks for the numbers: all go to one register's worth of room.
  std::size_t hourglass_step = 1, viscosity_step = 0, weak_step = 0;

  double h = 0, spacing = 0, alpha = 0, beta = 0, hourglass = 0;
  double support   = 1; ///< h_c/h of the correction
  double keep_weak = 1; ///< 1: weak viscosity acts as it is, 0: it is corrected
  /// LatticeShares of the joint damping rate.
  double direct_share = 0, weak_share = 0, hourglass_share = 0;
  bool   compressed_only = false; ///< sensor sums of particles that expand are asked for by nobody
};

/// Sweeps for one choice of methods; null where the choice does not need one.
struct SweepFunctions
{
  using Function = void (*)(const Sweep &);
  Function gradient = nullptr;
  Function reference_gradient = nullptr; ///< after the first gradient of the reference configuration
  Function density  = nullptr; ///< sums of m W
  Function sensor   = nullptr;
  Function force    = nullptr; ///< stress and hourglass control
  Function artificial_stress = nullptr; ///< adds to the f_sum of the force sums
  Function viscous    = nullptr;
  Function correction = nullptr; ///< adds to the f_sum of the force sums
  Function mean       = nullptr; ///< what support rules and energy forms ask for
  Function energy     = nullptr;
  Function artificial_stress_power = nullptr; ///< these add to the power sums
  Function correction_power        = nullptr;
  Function viscous_power           = nullptr; ///< of pair_viscosity, where energy leaves it out
  Function weak_power              = nullptr; ///< of pair_weak
  Function joint_force = nullptr; ///< force and viscous in one (half/forces.h), directed
  /// Each pair once (half/).
  Function half_force = nullptr, half_energy = nullptr;
};

/// Names as in SphOptions.
struct SweepChoice
{
  bool        standard   = false;
  bool        damage     = false;
  std::string kernel     = "cubic";
  std::string viscosity  = "monaghan";
  bool        limited    = false;
  std::string correction = "none"; ///< "none", "pairwise", "shepard"
  bool        variable   = false;  ///< support of the correction
  bool        direct     = true;   ///< some of the viscosity acts as it is
  bool        reference  = false;  ///< configuration
  bool        joint      = false;  ///< each pair once, forces joint (see joint_possible())
};

/// Instantiated for dim 1, 2, 3; InputError for an unknown name.
template <int dim>
SweepFunctions choose_sweeps(const SweepChoice &);
} // namespace ogive::sph
