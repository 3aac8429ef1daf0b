// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/parameters.h"
#include "core/materials/strength/flow.h"
#include "core/materials/strength/nearby.h"

#include <algorithm>
#include <cmath>

namespace ogive::materials
{
/// Y = (A + B eps_p^n)(1 + C ln max(rate/rate0, 1))(1 - T*^m),
/// T* = (T - T_ref)/(T_melt - T_ref) held in [0, 1] (Johnson and Cook, 7th Int.
/// Symp. Ballistics, The Hague 1983). The rate is the plastic strain increment
/// over the step; below the reference rate the law is rate independent.
struct JohnsonCook
{
  static constexpr const char *name   = "johnson-cook";
  static constexpr bool        solid  = true;
  static constexpr bool        yields = true;

  double a, b, n;           ///< Pa, Pa, -
  double c, inverse_rate;   ///< -, s
  double m;
  double reference, inverse_range; ///< K, 1/K
  NearbyPower::Series hardening_series, thermal_series;

  static JohnsonCook from(const Parameters &p)
  {
    const char *why = "strength law \"johnson-cook\"";
    JohnsonCook j;
    j.a = positive(p.strength.yield_stress, "Strength/yield stress", why);
    j.b = not_negative(p.strength.hardening, "Strength/hardening", why);
    j.n = positive(p.strength.exponent, "Strength/exponent", why);
    j.c = not_negative(p.strength.rate_coefficient, "Strength/rate coefficient", why);
    j.inverse_rate = 1 / positive(p.strength.reference_rate, "Strength/reference rate", why);
    j.m            = positive(p.strength.thermal_exponent, "Strength/thermal exponent", why);
    j.reference =
      positive(p.thermal.reference_temperature, "Thermal/reference temperature", why);
    const double melt = positive(p.thermal.melt_temperature, "Thermal/melt temperature", why);
    positive(p.thermal.specific_heat, "Thermal/specific heat", why);
    if (melt <= j.reference)
      reject("Thermal/melt temperature", "is not above the reference temperature",
             "a higher temperature");
    j.inverse_range    = 1 / (melt - j.reference);
    j.hardening_series = NearbyPower::Series(j.n);
    j.thermal_series   = NearbyPower::Series(j.m);
    return j;
  }

  /// A cheap lower bound of the yield stress: eps^n >= min(eps, 1) for n <= 1,
  /// T*^m <= T* for m >= 1 and <= the tangent at T* = 1 for m < 1.
  double elastic_up_to(double plastic_strain, double temperature) const
  {
    const double t_star = homologous(temperature);
    const double heat   = m >= 1 || t_star <= 0 ? t_star : 1 - m * (1 - t_star);
    const double strain = n <= 1 ? std::min(plastic_strain, 1.) : 0;
    return (a + b * strain) * (1 - heat);
  }

  double stress(double plastic_strain, double rate, double temperature) const
  {
    const double relative = rate * inverse_rate;
    const double t_star   = homologous(temperature);
    return (a + (plastic_strain > 0 ? b * std::pow(plastic_strain, n) : 0)) *
           (relative > 1 ? 1 + c * std::log(relative) : 1) *
           (t_star > 0 ? 1 - std::pow(t_star, m) : 1);
  }

  /// Solves q - 3 G x = Y(eps + x, x/dt, T + heating (q - 3 G x) x) by Newton,
  /// held inside a bracket that a bisection closes where Newton leaves it.
  Flow flow(const Trial &t) const
  {
    double lo = 0, hi = t.stress / t.three_g;
    double x           = (t.stress - t.old_stress) / t.three_g;
    bool   known_plastic = false;
    Functions f{NearbyPower(hardening_series), NearbyPower(thermal_series), NearbyLog()};
    for (int i = 0; i < max_iterations; ++i)
      {
        if (!(x > lo && x < hi))
          {
            if (!known_plastic && lo == 0)
              {
                const double excess = t.stress - stress(t.plastic_strain, 0, t.temperature);
                if (!(excess > 0))
                  return {};
                known_plastic = true;
                x             = std::min(excess / t.three_g, .5 * (lo + hi));
              }
            else // with lo = 0 the root may be many decades down: x^n with small n
              x = lo > 0 ? .5 * (lo + hi) : 1e-3 * hi;
          }
        const Residual r = residual(t, x, f);
        if (r.value >= 0)
          lo = x;
        else
          hi = x;
        const double step = r.value / r.slope;
        if (std::abs(r.value) <= tolerance * t.stress || hi - lo <= tolerance * hi)
          break;
        x -= step;
      }
    return {x, (t.stress - t.three_g * x) * x};
  }

private:
  static constexpr int    max_iterations = 100;
  static constexpr double tolerance      = 1e-12;

  struct Functions
  {
    NearbyPower hardening, thermal;
    NearbyLog   rate;
  };

  struct Residual
  {
    double value, slope;
  };

  double homologous(double temperature) const
  {
    return std::clamp((temperature - reference) * inverse_range, 0., 1.);
  }

  Residual residual(const Trial &t, double x, Functions &f) const
  {
    const double strain = t.plastic_strain + x;
    const double power  = b * f.hardening(strain);
    const double h = a + power, dh = n * power / strain;

    const double relative = t.dt > 0 ? x * inverse_rate / t.dt : 0;
    const double r        = relative > 1 ? 1 + c * f.rate(relative) : 1;
    const double dr       = relative > 1 ? c / x : 0;

    const double q      = t.stress - t.three_g * x;
    const double t_star = homologous(t.temperature + t.heating * q * x);
    double       w = 1, dw = 0;
    if (t_star > 0)
      {
        const double heat = f.thermal(t_star);
        w                 = 1 - heat;
        if (t_star < 1)
          dw = -m * heat / t_star * inverse_range * t.heating * (q - t.three_g * x);
      }
    return {q - h * r * w, -t.three_g - dh * r * w - h * dr * w - h * r * dw};
  }
};
} // namespace ogive::materials
