// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/geometry.h"

#include <numbers>

namespace ogive::fem
{
/// Four-node quadrilateral turned about x = 0 (x = r, y = axis), "full" form:
/// the mean gradient is weighted with the volume 2 pi r dA of the whole ring.
/// Its trace is then the exact rate of the ring's volume, its transpose gives
/// exact axial momentum and energy, and a uniform stress makes no inner force.
/// The integrands are of second order in each parameter: 2 x 2 points are exact.
struct Quad4Axisymmetric
{
  static constexpr int    dim = 2, corners = 4, modes = 1;
  static constexpr bool   hoop            = true;
  static constexpr double hourglass[1][4] = {{1, -1, 1, -1}};

  template <class T>
  static void gradient(const T (&x)[corners][dim], Geometry<Quad4Axisymmetric, T> &g)
  {
    for (int a = 0; a < corners; ++a)
      g.B[a][0] = g.B[a][1] = g.hoop[a] = T(0.);
    g.volume = T(0.);
    for (int p = 0; p < 4; ++p)
      add_point(x, p, g);
  }

  /// Row sums of the ring's volume, int N_a 2 pi r dA: with them a uniform
  /// traction moves every node of a face alike.
  static void corner_volumes(const double (&x)[corners][dim], double (&share)[corners])
  {
    for (double &s : share)
      s = 0;
    for (int p = 0; p < 4; ++p)
    {
      Geometry<Quad4Axisymmetric, double> g{};
      add_point(x, p, g);
      for (int a = 0; a < corners; ++a)
        share[a] += shape(p, a) * g.volume;
    }
  }

private:
  static constexpr double shape(int p, int a)
  {
    return .25 * (1 + sign(0, a) * point(0, p)) * (1 + sign(1, a) * point(1, p));
  }
  static constexpr double sign(int d, int a)
  {
    constexpr double s[2][4] = {{-1, 1, 1, -1}, {-1, -1, 1, 1}};
    return s[d][a];
  }
  static constexpr double point(int d, int p) { return sign(d, p) * .57735026918962576451; }
  static constexpr double slope(int d, int p, int a)
  {
    return .25 * sign(d, a) * (1 + sign(1 - d, a) * point(1 - d, p));
  }

  template <class T>
  static void add_point(const T (&x)[corners][dim], int p, Geometry<Quad4Axisymmetric, T> &g)
  {
    T r(0.), j[2][2] = {{T(0.), T(0.)}, {T(0.), T(0.)}};
    for (int a = 0; a < corners; ++a)
    {
      r += shape(p, a) * x[a][0];
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
          j[i][k] += slope(k, p, a) * x[a][i];
    }
    const T area = 2 * std::numbers::pi * (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
    const T ring = 2 * std::numbers::pi * r;
    g.volume += r * area;
    for (int a = 0; a < corners; ++a)
    {
      g.B[a][0] += ring * (slope(0, p, a) * j[1][1] - slope(1, p, a) * j[1][0]);
      g.B[a][1] += ring * (slope(1, p, a) * j[0][0] - slope(0, p, a) * j[0][1]);
      g.hoop[a] += shape(p, a) * area;
    }
  }
};
} // namespace ogive::fem
