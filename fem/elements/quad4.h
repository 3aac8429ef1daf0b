// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/geometry.h"

namespace ogive::fem
{
/// Four-node quadrilateral in plane strain; volumes and forces are per metre of
/// thickness. Mean gradient: Flanagan and Belytschko, Int. J. Numer. Meth. Eng.
/// 17 (1981) 679, doi 10.1002/nme.1620170504.
struct Quad4
{
  static constexpr int    dim = 2, corners = 4, modes = 1;
  static constexpr bool   hoop            = false;
  static constexpr double hourglass[1][4] = {{1, -1, 1, -1}};

  template <class T>
  static void gradient(const T (&x)[corners][dim], Geometry<Quad4, T> &g)
  {
    const T half(.5);
    const T x20 = half * (x[2][0] - x[0][0]), y20 = half * (x[2][1] - x[0][1]);
    const T x31 = half * (x[3][0] - x[1][0]), y31 = half * (x[3][1] - x[1][1]);
    g.B[0][0] = -y31, g.B[0][1] = x31;
    g.B[1][0] = y20, g.B[1][1] = -x20;
    g.B[2][0] = y31, g.B[2][1] = -x31;
    g.B[3][0] = -y20, g.B[3][1] = x20;
    g.volume = 2. * (x20 * y31 - x31 * y20);
  }
};
} // namespace ogive::fem
