// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/geometry.h"

namespace ogive::fem
{
/// Eight-node brick with the exact mean gradient of its trilinear map:
/// Flanagan and Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679, eqs. 72-79,
/// doi 10.1002/nme.1620170504.
struct Hex8
{
  static constexpr int    dim = 3, corners = 8, modes = 4;
  static constexpr bool   hoop            = false;
  static constexpr double hourglass[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},
                                             {1, -1, -1, 1, -1, 1, 1, -1},
                                             {1, -1, 1, -1, 1, -1, 1, -1},
                                             {-1, 1, -1, 1, 1, -1, 1, -1}};

  template <class T>
  static void gradient(const T (&x)[corners][dim], Geometry<Hex8, T> &g)
  {
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < 3; ++i)
        g.B[a][i] = derivative(x, neighbours[a], (i + 1) % 3, (i + 2) % 3);
    T v(0.);
    for (int a = 0; a < corners; ++a)
      v += x[a][0] * g.B[a][0];
    g.volume = v;
  }

private:
  /// The six corners that share a face but no space diagonal with corner a, in
  /// the order in which the formula of corner 0 reads corners 1 2 3 4 5 7.
  static constexpr int neighbours[8][6] = {{1, 2, 3, 4, 5, 7},
                                           {2, 3, 0, 5, 6, 4},
                                           {3, 0, 1, 6, 7, 5},
                                           {0, 1, 2, 7, 4, 6},
                                           {7, 6, 5, 0, 3, 1},
                                           {4, 7, 6, 1, 0, 2},
                                           {5, 4, 7, 2, 1, 3},
                                           {6, 5, 4, 3, 2, 0}};

  /// Volume derivative by the coordinate that completes (y, z) to a
  /// right-handed triad.
  template <class T>
  static T derivative(const T (&x)[corners][dim], const int (&n)[6], int y, int z)
  {
    const T z24 = x[n[0]][z] - x[n[2]][z], z52 = x[n[3]][z] - x[n[0]][z], z45 = x[n[2]][z] - x[n[3]][z];
    const T s = x[n[0]][y] * ((x[n[4]][z] - x[n[1]][z]) - z45) + x[n[1]][y] * z24 +
                x[n[2]][y] * ((x[n[1]][z] - x[n[5]][z]) - z52) +
                x[n[3]][y] * ((x[n[5]][z] - x[n[4]][z]) - z24) + x[n[4]][y] * z52 + x[n[5]][y] * z45;
    return s * (1. / 12);
  }
};
} // namespace ogive::fem
