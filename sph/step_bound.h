// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

namespace ogive::sph
{
/// Shares of the Gershgorin sums that the worst wave on the particle lattice
/// reaches, from a scan of the Brillouin zone. The sums alone are a bound
/// without proof of sharpness (in 3-D they give less than half of the step that
/// is stable); scaled by these shares they are exact on the lattice and follow
/// density, compression and missing neighbours particle by particle.
///  frequency  max_k |sum V sin(k.x) gradW| / sum V |gradW|
///  viscosity  max_k lambda_max(sum c_j n n^T (1 - cos k.x)) / sum c_j, c_j of
///             the viscous pair force
///  weak       the same for viscosity that the correction filters
///  hourglass  the same for the hourglass control, which no filter touches
struct LatticeShares
{
  double frequency = 1, viscosity = 1, weak = 1, hourglass = 1;
  /// sum W dx^dim without self, and the mean of |x_1|/h with these weights.
  double weight = 1, offset = 1;
};
template <int dim>
LatticeShares lattice_shares(const input::SphOptions &);

/// w_i = c_i frequency (|B_i| sum V |gradW| + surface_share |B_i sum V gradW|):
/// the second part is the diagonal of the gradient operator, nothing inside a
/// body; at free surfaces the corrected form is up to twice as stiff as inside.
/// The share is fitted: highest frequencies of free blocks, from a dense
/// eigensolver, cubic kernel, h = 1.3 dx, Poisson's ratio .37, in c/dx (with
/// jitter .2 dx): 1-D 1.236 (1.224), 2-D 1.447 (1.671), 3-D 1.618 (1.694),
/// where it gives 1.27 and more; interior alone .81, .82, .85.
inline constexpr double surface_share = .6;

/// Largest dt with dt^2 w^2/4 + dt D/2 <= 1; w in rad/s, D in 1/s.
double largest_step(double w, double damping);
} // namespace ogive::sph
