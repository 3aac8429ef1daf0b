// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::fem
{
/// Gauss-Lobatto-Legendre points and weights on [-1, 1] and slopes of the
/// Lagrange polynomials through them: Canuto, Hussaini, Quarteroni and Zang,
/// Spectral Methods, Springer 2006, section 2.3.
template <int degree>
struct Lobatto
{
  static_assert(degree >= 2 && degree <= 4);
  static constexpr int n = degree + 1;
  double               point[n], weight[n];
  double               slope[n][n]; ///< [q][a]: slope of polynomial a at point q

  constexpr Lobatto()
    : point{}
    , weight{}
    , slope{}
  {
    constexpr double inner3 = .44721359549995793928, inner4 = .65465367070797714380; // 1/sqrt 5, sqrt(3/7)
    const double     points[3][5]  = {{-1, 0, 1}, {-1, -inner3, inner3, 1}, {-1, -inner4, 0, inner4, 1}};
    const double     weights[3][5] = {
      {1. / 3, 4. / 3, 1. / 3}, {1. / 6, 5. / 6, 5. / 6, 1. / 6}, {.1, 49. / 90, 32. / 45, 49. / 90, .1}};
    for (int a = 0; a < n; ++a)
      point[a] = points[degree - 2][a], weight[a] = weights[degree - 2][a];
    for (int a = 0; a < n; ++a)
    {
      double scale = 1;
      for (int b = 0; b < n; ++b)
        if (b != a)
          scale *= point[a] - point[b];
      for (int q = 0; q < n; ++q)
        for (int left = 0; left < n; ++left)
          if (left != a)
          {
            double product = 1;
            for (int b = 0; b < n; ++b)
              if (b != a && b != left)
                product *= point[q] - point[b];
            slope[q][a] += product / scale;
          }
    }
  }
};

/// Line, quadrilateral (plane strain) or brick of polynomial degree 2 to 4 with
/// its nodes at the quadrature points, so that the mass is lumped without loss:
/// waves over long ways. Patera, J. Comput. Phys. 54 (1984) 468,
/// doi 10.1016/0021-9991(84)90128-1. Nodes are numbered x fastest. No ring:
/// quadrature points on the axis would have no mass.
template <int dim_, int degree_>
struct Spectral
{
  static constexpr int dim = dim_, degree = degree_, side = degree + 1;
  static constexpr int nodes = dim == 1 ? side : dim == 2 ? side * side : side * side * side, points = nodes;
  static constexpr bool hoop = false, mean_dilatation = false, collocated = true;
  static constexpr Lobatto<degree> line{};

  static constexpr int stride(int k) { return k == 0 ? 1 : k == 1 ? side : side * side; }
  static constexpr int    along(int k, int q) { return table.along[k][q]; }
  static constexpr double weight(int q) { return table.weight[q]; }
  static constexpr double value(int q, int a) { return q == a; }

  template <class T>
  static void slopes(const T (&field)[nodes][dim], int q, T (&g)[dim][dim])
  {
    for (int k = 0; k < dim; ++k)
    {
      const int at = along(k, q), first = q - at * stride(k);
      for (int i = 0; i < dim; ++i)
      {
        T sum = field[first][i] * line.slope[at][0];
        for (int b = 1; b < side; ++b)
          sum += field[first + b * stride(k)][i] * line.slope[at][b];
        g[i][k] = sum;
      }
    }
  }
  template <class T>
  static void add_slopes(int q, const T (&p)[dim][dim], T (&field)[nodes][dim])
  {
    for (int k = 0; k < dim; ++k)
    {
      const int at = along(k, q), first = q - at * stride(k);
      for (int b = 0; b < side; ++b)
        for (int i = 0; i < dim; ++i)
          field[first + b * stride(k)][i] += p[i][k] * line.slope[at][b];
    }
  }

private:
  struct Table
  {
    int    along[dim][points];
    double weight[points];
    constexpr Table()
      : along{}
      , weight{}
    {
      for (int q = 0; q < points; ++q)
      {
        weight[q] = 1;
        for (int k = 0; k < dim; ++k)
        {
          along[k][q] = q / stride(k) % side;
          weight[q] *= line.weight[along[k][q]];
        }
      }
    }
  };
  static constexpr Table table{};
};
} // namespace ogive::fem
