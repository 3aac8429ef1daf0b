// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/damage/loading.h"
#include "core/materials/entry.h"
#include "core/materials/parameters.h"

#include <algorithm>
#include <cmath>

namespace ogive::materials
{
/// Fracture strain of Johnson and Cook (Eng. Fract. Mech. 21 (1985) 31):
///   eps_f = (D1 + D2 exp(D3 sigma_m/sigma_eq))(1 + D4 ln max(rate/rate0, 1))(1 + D5 T*).
/// Damage grows by dD = D_c d_eps_p/eps_f and the point fails (D = 1) when D
/// reaches D_c = `critical`: at constant triaxiality, rate and temperature it
/// fails at eps_p = eps_f whatever D_c, which says only how far the material
/// softens before (Boervik, Hopperstad, Berstad and Langseth, Eur. J. Mech.
/// A/Solids 20 (2001) 685, with no damage threshold).
struct JohnsonCookDamage
{
  static constexpr const char *name    = "johnson-cook";
  static constexpr bool        damages = true;

  double d1, d2, d3, d4, d5;
  double critical;
  double inverse_rate;             ///< s
  double reference, inverse_range; ///< K, 1/K

  static JohnsonCookDamage from(const Parameters &p)
  {
    const char       *why = "damage law \"johnson-cook\"";
    JohnsonCookDamage d;
    d.d1       = given(p.damage.d1, "Damage/d1", why);
    d.d2       = given(p.damage.d2, "Damage/d2", why);
    d.d3       = given(p.damage.d3, "Damage/d3", why);
    d.d4       = given(p.damage.d4, "Damage/d4", why);
    d.d5       = given(p.damage.d5, "Damage/d5", why);
    d.critical = fraction(positive(p.damage.critical, "Damage/critical", why), "Damage/critical", why);
    d.inverse_rate  = d.d4 != 0 ? 1 / positive(p.damage.reference_rate, "Damage/reference rate", why) : 0;
    d.reference     = 0;
    d.inverse_range = 0;
    if (d.d5 != 0)
      {
        d.reference = positive(p.thermal.reference_temperature, "Thermal/reference temperature", why);
        const double melt = positive(p.thermal.melt_temperature, "Thermal/melt temperature", why);
        if (melt <= d.reference)
          reject("Thermal/melt temperature", "is not above the reference temperature",
                 "a higher temperature");
        d.inverse_range = 1 / (melt - d.reference);
      }
    return d;
  }

  double fracture_strain(double triaxiality, double rate, double temperature) const
  {
    const double t_star   = std::clamp((temperature - reference) * inverse_range, 0., 1.);
    const double relative = rate * inverse_rate;
    return (d1 + d2 * std::exp(d3 * triaxiality)) * (relative > 1 ? 1 + d4 * std::log(relative) : 1) *
           (1 + d5 * t_star);
  }

  /// Damage at the end of the step. A fracture strain that is not positive
  /// fails the point as soon as it flows.
  double after(const Loading &l) const
  {
    if (!(l.plastic_increment > 0))
      return l.damage;
    // Molten: no deviator left, so no finite triaxiality to measure.
    const double triaxiality = l.von_mises > 0 ? l.mean_stress / l.von_mises : 0;
    const double rate        = l.dt > 0 ? l.plastic_increment / l.dt : 0;
    const double strain      = fracture_strain(triaxiality, rate, l.temperature);
    if (!(strain > 0))
      return 1;
    const double grown = l.damage + critical * l.plastic_increment / strain;
    return grown >= critical ? 1 : grown;
  }
};
} // namespace ogive::materials
