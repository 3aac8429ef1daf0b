// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

#include <numbers>

namespace ogive::sph
{
/// Quintic spline, support 3h. Morris, Fox and Zhu, J. Comput. Phys. 136 (1997)
/// 214, doi:10.1006/jcph.1997.5776.
struct QuinticSpline
{
  static constexpr const char *name    = "quintic";
  static constexpr double      support = 3;

  template <int dim>
  static constexpr double norm()
  {
    return dim == 1 ? 1. / 120 : dim == 2 ? 7 / (478 * std::numbers::pi) : 1 / (120 * std::numbers::pi);
  }

  template <int dim, class T>
  static T value(const T &q)
  {
    const T a = positive_part(3. - q), b = positive_part(2. - q), c = positive_part(1. - q);
    const T a2 = a * a, b2 = b * b, c2 = c * c;
    return a2 * a2 * a - 6. * (b2 * b2 * b) + 15. * (c2 * c2 * c);
  }

  template <int dim, class T>
  static T slope_over_q(const T &q, const T &inv_q)
  {
    const T a = positive_part(3. - q), b = positive_part(2. - q), a2 = a * a, b2 = b * b;
    return select(q < 1., T((120. - 50. * q) * (q * q) - 120.), T((30. * (b2 * b2) - 5. * (a2 * a2)) * inv_q));
  }
};
} // namespace ogive::sph
