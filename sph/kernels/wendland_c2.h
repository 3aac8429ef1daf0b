// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

#include <numbers>

namespace ogive::sph
{
/// Wendland C2, support 2h. Dehnen and Aly, MNRAS 425 (2012) 1068, table 1,
/// doi:10.1111/j.1365-2966.2012.21439.x (their 1-D form differs from 2-D, 3-D).
struct WendlandC2
{
  static constexpr const char *name    = "wendland-c2";
  static constexpr double      support = 2;

  template <int dim>
  static constexpr double norm()
  {
    return dim == 1 ? 5. / 8 : dim == 2 ? 7 / (4 * std::numbers::pi) : 21 / (16 * std::numbers::pi);
  }

  template <int dim, class T>
  static T value(const T &q)
  {
    const T a = positive_part(1. - .5 * q);
    if constexpr (dim == 1)
      return a * a * a * (1. + 1.5 * q);
    else
      return (a * a) * (a * a) * (1. + 2. * q);
  }

  template <int dim, class T>
  static T slope_over_q(const T &q, const T &)
  {
    const T a = positive_part(1. - .5 * q);
    if constexpr (dim == 1)
      return -3. * (a * a);
    else
      return -5. * (a * a * a);
  }
};
} // namespace ogive::sph
