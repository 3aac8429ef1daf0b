// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::fem
{
/// Multilinear element with two Gauss points along each axis: plane strain or
/// ring (x = r) quadrilateral, brick. Every point keeps its own volume: it locks
/// where the material flows without changing volume, and ships for that
/// comparison. Corners in VTK order.
template <int dim_, bool ring>
struct Full
{
  static constexpr int  dim = dim_, nodes = 1 << dim, points = 1 << dim, degree = 1;
  static constexpr bool hoop = ring, mean_dilatation = false, collocated = false;

  static constexpr double sign(int k, int a)
  {
    return k == 0 ? ((a & 3) == 1 || (a & 3) == 2 ? 1 : -1) : k == 1 ? ((a & 3) >= 2 ? 1 : -1) : (a >= 4 ? 1 : -1);
  }
  static constexpr double weight(int) { return 1; }
  /// Shape function a at point q.
  static constexpr double value(int q, int a)
  {
    double n = 1;
    for (int k = 0; k < dim; ++k)
      n *= .5 * (1 + sign(k, a) * sign(k, q) * root);
    return n;
  }
  /// Its slope by reference coordinate k.
  static constexpr double slope(int k, int q, int a)
  {
    double n = .5 * sign(k, a);
    for (int l = 0; l < dim; ++l)
      if (l != k)
        n *= .5 * (1 + sign(l, a) * sign(l, q) * root);
    return n;
  }

  /// g[i][k] = d field_i / d xi_k at point q.
  template <class T>
  static void slopes(const T (&field)[nodes][dim], int q, T (&g)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k)
      {
        T sum = field[0][i] * table.slope[q][0][k];
        for (int a = 1; a < nodes; ++a)
          sum += field[a][i] * table.slope[q][a][k];
        g[i][k] = sum;
      }
  }
  /// The transpose: field_a,i += sum_k dN_a/dxi_k p[i][k].
  template <class T>
  static void add_slopes(int q, const T (&p)[dim][dim], T (&field)[nodes][dim])
  {
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          field[a][i] += p[i][k] * table.slope[q][a][k];
  }

private:
  static constexpr double root = .57735026918962576451; // 1/sqrt 3

  struct Table
  {
    double slope[points][nodes][dim];
    constexpr Table()
      : slope{}
    {
      for (int q = 0; q < points; ++q)
        for (int a = 0; a < nodes; ++a)
          for (int k = 0; k < dim; ++k)
            slope[q][a][k] = Full::slope(k, q, a);
    }
  };
  static constexpr Table table{};
};
} // namespace ogive::fem
