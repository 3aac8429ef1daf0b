// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/viscosity/pair.h"

namespace ogive::sph
{
/// Monaghan's pair viscosity, Annu. Rev. Astron. Astrophys. 30 (1992) 543:
/// Pi = (-alpha c mu + beta mu^2)/rho, mu = h v_ij.x_ij/(r^2 + .01 h^2) where
/// the pair approaches, else 0; c and rho are the means of the pair.
template <int dim>
struct Monaghan
{
  static constexpr const char *name       = "monaghan";
  static constexpr bool        dissipates = true; ///< every pair, whatever moves
  static constexpr bool        central    = true;
  static constexpr int         n_terms    = 1;
  static constexpr int         n_fields   = 0;

  double alpha = 1, beta = 2, h = 0;

  void prepare(const ViscousPoint<dim> &, double *) const {}

  ViscousTerms<1> operator()(const ViscousPair<dim> &p, const double *, const VDouble *) const
  {
    const VDouble distance = p.r2 + .01 * h * h;
    const VDouble inverse  = 1. / (distance * p.rho2);
    const VDouble ac       = .5 * alpha * p.c2;
    const VDouble scale    = 2. * inverse * distance; // 1/rho
    const auto    pi       = [&](const VDouble &mu) { return VDouble(mu * (beta * mu - ac) * scale); };
    const VDouble per_jump = h * inverse * p.rho2, mu = stdx::min(p.vx, VDouble(0.)) * per_jump;
    return {{pi(mu)}, {pi(p.limited * per_jump)}, viscous_rate(alpha, beta, h, -mu, p.r2, p.c2, p.rho2)};
  }
};
} // namespace ogive::sph
