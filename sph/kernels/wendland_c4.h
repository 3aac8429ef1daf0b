// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

#include <numbers>

namespace ogive::sph
{
/// Wendland C4, support 2h. Dehnen and Aly, MNRAS 425 (2012) 1068, table 1,
/// doi:10.1111/j.1365-2966.2012.21439.x (their 1-D form differs from 2-D, 3-D).
struct WendlandC4
{
  static constexpr const char *name    = "wendland-c4";
  static constexpr double      support = 2;

  template <int dim>
  static constexpr double norm()
  {
    return dim == 1 ? 3. / 4 : dim == 2 ? 9 / (4 * std::numbers::pi) : 495 / (256 * std::numbers::pi);
  }

  template <int dim, class T>
  static T value(const T &q)
  {
    const T s = .5 * q, a = positive_part(1. - s), a2 = a * a;
    if constexpr (dim == 1)
      return a2 * a2 * a * (1. + s * (5. + 8. * s));
    else
      return a2 * a2 * a2 * (1. + s * (6. + 35. / 3 * s));
  }

  template <int dim, class T>
  static T slope_over_q(const T &q, const T &)
  {
    const T s = .5 * q, a = positive_part(1. - s), a4 = (a * a) * (a * a);
    if constexpr (dim == 1)
      return -3.5 * a4 * (1. + 4. * s);
    else
      return -14. / 3 * (a4 * a) * (1. + 5. * s);
  }
};
} // namespace ogive::sph
