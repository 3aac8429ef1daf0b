// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/parameters.h"
#include "core/materials/strength/flow.h"

namespace ogive::materials
{
/// Constant yield stress. The return factor is f = min(Y/sqrt(3 J2), 1) with
/// J2 = s:s/2, and the plastic strain increment (1 - f) sqrt(3/2 s:s)/(3 G).
struct PerfectPlastic
{
  static constexpr const char *name   = "perfect-plastic";
  static constexpr bool        solid  = true;
  static constexpr bool        yields = true;

  double yield; ///< Pa

  static PerfectPlastic from(const Parameters &p)
  {
    return {positive(p.strength.yield_stress, "Strength/yield stress",
                     "strength law \"perfect-plastic\"")};
  }

  /// A stress that surely does not yield at this plastic strain and temperature, Pa.
  template <class T>
  T elastic_up_to(const T &, const T &) const
  {
    return T(yield);
  }

  /// Yield stress, Pa.
  double stress(double, double, double) const { return yield; }

  template <class T>
  Flow<T> flow(const Trial<T> &t) const
  {
    const T x = select(t.stress > T(yield), (t.stress - T(yield)) / T(t.three_g), T(0));
    return {x, T(yield) * x};
  }
};
} // namespace ogive::materials
