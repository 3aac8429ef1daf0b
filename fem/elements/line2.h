// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/geometry.h"

namespace ogive::fem
{
/// Two-node line, uniaxial strain; volumes and forces are per square metre.
struct Line2
{
  static constexpr int    dim = 1, corners = 2, modes = 0;
  static constexpr bool   hoop            = false;
  static constexpr double hourglass[1][2] = {{0, 0}}; // a line has no zero-energy mode

  template <class T>
  static void gradient(const T (&x)[corners][dim], Geometry<Line2, T> &g)
  {
    g.volume  = x[1][0] - x[0][0];
    g.B[0][0] = T(-1.);
    g.B[1][0] = T(1.);
  }
};
} // namespace ogive::fem
