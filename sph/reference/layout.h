// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/sweep.h"

namespace ogive::sph
{
/// Records of the force sweep in the reference configuration: X, x, v, V0,
/// density, sound speed, modulus of the hourglass stiffness, T and the
/// symmetric velocity gradient (reference/sweeps.h).
template <int dim>
struct ReferenceLayout
{
  static constexpr int reference = 0, x = dim, v = 2 * dim, volume = 3 * dim, density = volume + 1, sound = volume + 2,
                       modulus = volume + 3, t = volume + 4, rate = t + dim * dim,
                       n_fields = rate + Layout<dim>::n_sym;
  static constexpr std::size_t stride = padded(n_fields);
};

/// Stands for a kernel where the slopes of the pairs are kept: in the reference
/// configuration the kernel never changes (Sweep::pair_slope).
struct KeptSlope
{};

/// Sweeps of the reference configuration in place of those that differ.
template <int dim>
void choose_reference(const SweepChoice &, SweepFunctions &);
} // namespace ogive::sph
