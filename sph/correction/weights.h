// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
/// The correction replaces the viscous acceleration da by its difference from
/// a convex mean, (1/m_i) sum_j K_ij (da_i - da_j). A reconstruction: the
/// discrete form of the source paper is not at hand.
///  pairwise  K_ij = V_i V_j W(x_ij; h_c) min(rho_i/s_i, rho_j/s_j), s the
///            Shepard sum with self. With one density this is m_i m_j W/(rho
///            max(s_i, s_j)); the minimum keeps the row sums of K/m below 1
///            whatever the densities, hence the spectrum in [0, 2). Symmetric:
///            momentum is exact. Constants die.
///  shepard   K_ij = m_i V_j W(x_ij; h_c)/s_i, the mean to the letter: da_i less
///            its Shepard mean. Constants die; momentum is not kept where the
///            sums differ.
/// The support h_c is that of the body, or the mean of the two ends' (variable).
template <int dim, class Kernel, bool shepard, bool variable>
class CorrectionWeight
{
public:
  using L                        = Layout<dim>;
  static constexpr std::size_t stride   = variable ? L::wide_correction_stride : L::correction_stride;
  static constexpr int         n_fields = variable ? 2 * dim + 3 : 2 * dim + 2;

  explicit CorrectionWeight(const Sweep &s) : kernel_(s.h * s.support) {}

  /// K, kg, for the lanes j of a correction record; r = |x_ij|.
  VDouble operator()(const double *own, const VDouble *j, const VDouble &r) const
  {
    const VDouble volumes = own[L::volume] * j[L::volume];
    const VDouble kappa   = shepard ? VDouble(own[L::kappa]) : VDouble(stdx::min(VDouble(own[L::kappa]), j[L::kappa]));
    return volumes * kappa * value(own, j, r);
  }

  /// W(x_ij; h_c), 1/m^dim.
  VDouble value(const double *own, const VDouble *j, const VDouble &r) const
  {
    if constexpr (!variable)
      return kernel_.value(r);
    else
    {
      const VDouble inverse = 2. / (own[L::reach] + j[L::reach]);
      VDouble       scale   = Kernel::template norm<dim>();
      for (int d = 0; d < dim; ++d)
        scale *= inverse;
      return scale * Kernel::template value<dim>(VDouble(r * inverse));
    }
  }

private:
  KernelAt<Kernel, dim> kernel_;
};
} // namespace ogive::sph
