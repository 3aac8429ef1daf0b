// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

#include <numbers>

namespace ogive::sph
{
/// Cubic spline, support 2h. Monaghan and Lattanzio, Astron. Astrophys. 149
/// (1985) 135. W(r) = norm/h^dim value(r/h); gradW = x norm/h^(dim+2)
/// slope_over_q(r/h).
struct CubicSpline
{
  static constexpr const char *name    = "cubic";
  static constexpr double      support = 2;

  template <int dim>
  static constexpr double norm()
  {
    return dim == 1 ? 2. / 3 : dim == 2 ? 10 / (7 * std::numbers::pi) : 1 / std::numbers::pi;
  }

  template <int dim, class T>
  static T value(const T &q)
  {
    const T a = positive_part(2. - q), b = positive_part(1. - q);
    return .25 * (a * a * a) - b * b * b;
  }

  /// value'(q)/q; inv_q may be infinite at q = 0.
  template <int dim, class T>
  static T slope_over_q(const T &q, const T &inv_q)
  {
    const T a = positive_part(2. - q);
    return select(q < 1., T(2.25 * q - 3.), T(-.75 * (a * a) * inv_q));
  }
};
} // namespace ogive::sph
