// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/viscosity/pair.h"

#include <algorithm>

namespace ogive::sph
{
/// Bulk and von Neumann-Richtmyer viscosity of Hernquist and Katz, Astrophys.
/// J. Suppl. 70 (1989) 419: Pi = q_i/rho_i^2 + q_j/rho_j^2 where the pair
/// approaches, q = alpha rho c h |div v| + beta rho h^2 (div v)^2 where div v < 0.
template <int dim>
struct HernquistKatz
{
  static constexpr const char *name       = "hernquist-katz";
  static constexpr bool        dissipates = true;
  static constexpr bool        central    = true;
  static constexpr int         n_terms    = 1;
  static constexpr int         n_fields   = 2; ///< q/rho^2, h |div v|

  double alpha = 1, beta = 2, h = 0;

  void prepare(const ViscousPoint<dim> &p, double *fields) const
  {
    const double jump = p.h * std::max(0., -p.divergence());
    fields[0]         = jump * (alpha * p.sound + beta * jump) / p.density;
    fields[1]         = jump;
  }

  ViscousTerms<1> operator()(const ViscousPair<dim> &p, const double *own, const VDouble *other) const
  {
    const VDouble q = select(p.vx < 0., VDouble(own[0] + other[0]), VDouble(0.));
    return {{q}, {q * p.jump_share()},
            viscous_rate(alpha, beta, h, stdx::max(VDouble(own[1]), other[1]), p.r2, p.c2, p.rho2)};
  }
};
} // namespace ogive::sph
