// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

namespace ogive::sph
{
/// Monaghan's pair viscosity, Annu. Rev. Astron. Astrophys. 30 (1992) 543:
/// Pi = (-alpha c mu + beta mu^2)/rho, mu = h v_ij.x_ij/(r^2 + .01 h^2) where
/// the pair approaches, else 0; c and rho are the means of the pair.
struct Monaghan
{
  static constexpr const char *name = "monaghan";

  double alpha = 1, beta = 2, h = 0;

  struct Pair
  {
    VDouble pi;   ///< Pi, m^5/(kg s^2)
    VDouble rate; ///< bound of -dPi/d(v_ij.x_ij), for the step bound
  };

  /// vx = v_ij.x_ij, r2 = |x_ij|^2, c2 and rho2 twice the means.
  Pair operator()(const VDouble &vx, const VDouble &r2, const VDouble &c2, const VDouble &rho2) const
  {
    const VDouble distance = r2 + .01 * h * h;
    const VDouble inverse  = 1. / (distance * rho2);
    const VDouble mu       = stdx::min(vx, VDouble(0.)) * (h * inverse * rho2);
    const VDouble ac       = .5 * alpha * c2;
    const VDouble two_over_rho = 2. * inverse * distance;
    // The linear part may act on any pair in the next step, so it counts always.
    return {mu * (beta * mu - ac) * two_over_rho, (ac - 2. * beta * mu) * (2. * h * inverse)};
  }
};
} // namespace ogive::sph
