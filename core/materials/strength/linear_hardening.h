// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/parameters.h"
#include "core/materials/strength/flow.h"

namespace ogive::materials
{
/// Yield stress Y + H eps_p. H is the plastic modulus: with a tangent modulus
/// E_t of the uniaxial curve it is H = E E_t/(E - E_t).
struct LinearHardening
{
  static constexpr const char *name   = "linear-hardening";
  static constexpr bool        solid  = true;
  static constexpr bool        yields = true;

  double yield;   ///< Pa
  double modulus; ///< H, Pa

  static LinearHardening from(const Parameters &p)
  {
    const char *why = "strength law \"linear-hardening\"";
    return {positive(p.strength.yield_stress, "Strength/yield stress", why),
            not_negative(p.strength.hardening_modulus, "Strength/hardening modulus", why)};
  }

  template <class T>
  T elastic_up_to(const T &plastic_strain, const T &) const
  {
    return T(yield) + T(modulus) * plastic_strain;
  }

  double stress(double plastic_strain, double, double) const
  {
    return yield + modulus * plastic_strain;
  }

  template <class T>
  Flow<T> flow(const Trial<T> &t) const
  {
    const T now = T(yield) + T(modulus) * t.plastic_strain;
    const T x   = select(t.stress > now, (t.stress - now) / T(t.three_g + modulus), T(0));
    return {x, (now + T(.5 * modulus) * x) * x};
  }
};
} // namespace ogive::materials
