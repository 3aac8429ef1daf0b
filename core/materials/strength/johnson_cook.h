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
  PowerSeries hardening_series, thermal_series;

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
    j.hardening_series = PowerSeries(j.n);
    j.thermal_series   = PowerSeries(j.m);
    return j;
  }

  /// A cheap lower bound of the yield stress: eps^n >= min(eps, 1) for n <= 1,
  /// T*^m <= T* for m >= 1 and <= the tangent at T* = 1 for m < 1.
  template <class T>
  T elastic_up_to(const T &plastic_strain, const T &temperature) const
  {
    const T t_star = homologous(temperature);
    const T heat   = m >= 1 ? t_star : select(t_star > T(0), T(1) - T(m) * (T(1) - t_star), T(0));
    const T strain = n <= 1 ? select(plastic_strain < T(1), plastic_strain, T(1)) : T(0);
    return (T(a) + T(b) * strain) * (T(1) - heat);
  }

  double stress(double plastic_strain, double rate, double temperature) const
  {
    const double relative = rate * inverse_rate;
    Functions<double> f(*this);
    return cold(plastic_strain, temperature, f) * (relative > 1 ? 1 + c * std::log(relative) : 1);
  }

  /// Solves q - 3 G x = Y(eps + x, x/dt, T + heating (q - 3 G x) x) by Newton,
  /// held inside a bracket that a bisection closes where Newton leaves it. No
  /// lane sees its neighbours: one that has converged holds still.
  template <class T>
  Flow<T> flow(const Trial<T> &t) const
  {
    Functions<T> f(*this);
    const T      start  = cold(t.plastic_strain, t.temperature, f);
    const auto   yields = t.stress > start;
    if (!any(yields))
      return {T(0), T(0)};
    T lo(0), hi = t.stress / T(t.three_g);
    T x = (t.stress - t.old_stress) / T(t.three_g);
    x   = select(x > lo && x < hi, x, least((t.stress - start) / T(t.three_g), T(.5) * hi));
    auto open = yields;
    for (int i = 0; i < max_iterations && any(open); ++i)
      {
        const Residual<T> r     = residual(t, x, open, f);
        const auto        below = r.value >= T(0);
        lo         = select(open && below, x, lo);
        hi         = select(open && !below, x, hi);
        using std::abs;
        open       = open && !(abs(r.value) <= T(tolerance) * t.stress || hi - lo <= T(tolerance) * hi);
        const T step   = r.value / r.slope;
        const T newton = x - step;
        // With lo = 0 the root may be many decades down: x^n with small n.
        const T inside = select(lo > T(0), T(.5) * (lo + hi), T(1e-3) * hi);
        const auto held = newton > lo && newton < hi;
        x = select(open, select(held, newton, inside), x);
        // What is left after a step is about (step/x)^2 x for powers and logarithms.
        open = open && !(held && abs(step) <= T(last_step) * x);
      }
    x = select(yields, x, T(0));
    return {x, (t.stress - T(t.three_g) * x) * x};
  }

private:
  static constexpr int    max_iterations = 100;
  static constexpr double tolerance = 1e-12, last_step = 5e-7;

  template <class T>
  struct Functions
  {
    NearbyPower<T> hardening, thermal;
    NearbyLog<T>   rate;

    explicit Functions(const JohnsonCook &law)
      : hardening(law.hardening_series)
      , thermal(law.thermal_series)
    {}
  };

  template <class T>
  struct Residual
  {
    T value, slope;
  };

  template <class T>
  static T least(const T &a, const T &b)
  {
    return select(a < b, a, b);
  }

  template <class T>
  T homologous(const T &temperature) const
  {
    const T t = (temperature - T(reference)) * T(inverse_range);
    return select(t > T(0), least(t, T(1)), T(0));
  }

  /// The yield stress below the reference rate.
  template <class T>
  T cold(const T &plastic_strain, const T &temperature, Functions<T> &f) const
  {
    const T    t_star = homologous(temperature);
    const auto strained = plastic_strain > T(0), warm = t_star > T(0);
    const T    hard     = select(strained, T(b) * f.hardening(plastic_strain, strained), T(0));
    return (T(a) + hard) * (T(1) - select(warm, f.thermal(t_star, warm), T(0)));
  }

  template <class T, class Mask>
  Residual<T> residual(const Trial<T> &t, const T &x, const Mask &open, Functions<T> &f) const
  {
    const T strain = t.plastic_strain + x;
    const T power  = T(b) * f.hardening(strain, open);
    const T h = T(a) + power, dh = T(n) * power / strain;

    T r(1), dr(0);
    if (c > 0 && t.dt > 0)
      {
        const T    relative = x * T(inverse_rate / t.dt);
        const auto fast     = relative > T(1);
        r                   = select(fast, T(1) + T(c) * f.rate(relative, open && fast), T(1));
        dr                  = select(fast, T(c) / x, T(0));
      }

    const T    q      = t.stress - T(t.three_g) * x;
    const T    t_star = homologous(t.temperature + t.heating * q * x);
    const auto warm   = t_star > T(0);
    const T    heat   = select(warm, f.thermal(t_star, open && warm), T(0));
    const T    w      = T(1) - heat;
    const T    dw     = select(warm && t_star < T(1),
                               T(-m * inverse_range) * heat / t_star * t.heating * (q - T(t.three_g) * x), T(0));
    return {q - h * r * w, T(-t.three_g) - dh * r * w - h * dr * w - h * r * dw};
  }
};
} // namespace ogive::materials
