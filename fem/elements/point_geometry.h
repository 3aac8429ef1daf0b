// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/kinematics.h"

#include <algorithm>
#include <numbers>

namespace ogive::fem
{
/// Map of an integrated element (full.h, b_bar.h, spectral.h) at one of its
/// points. T is double (set-up, tests) or a register of doubles.
template <class Element, class T>
struct PointGeometry
{
  T inverse[Element::dim][Element::dim]; ///< [k][i]: d xi_k / d x_i, 1/m
  T volume;                              ///< quadrature weight in space, m^3 (per m^2, per m, whole ring)
  T radius;                              ///< m, rings only
};

template <class Element, class T>
void map_point(const T (&x)[Element::nodes][Element::dim], int q, PointGeometry<Element, T> &g)
{
  T J[Element::dim][Element::dim];
  Element::slopes(x, q, J);
  g.volume = Element::weight(q) * invert<Element::dim, T>(J, g.inverse);
  if constexpr (Element::hoop)
  {
    g.radius = x[0][0] * Element::value(q, 0);
    for (int a = 1; a < Element::nodes; ++a)
      g.radius += x[a][0] * Element::value(q, a);
    g.volume = g.volume * (2 * std::numbers::pi) * g.radius;
  }
}

/// L_ij = dv_i/dx_j at point q.
template <class Element, class T>
void velocity_gradient(const T (&v)[Element::nodes][Element::dim], int q, const PointGeometry<Element, T> &g,
                       T (&L)[Element::dim][Element::dim])
{
  constexpr int dim = Element::dim;
  T             slope[dim][dim];
  Element::slopes(v, q, slope);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      T sum = slope[i][0] * g.inverse[0][j];
      for (int k = 1; k < dim; ++k)
        sum += slope[i][k] * g.inverse[k][j];
      L[i][j] = sum;
    }
}

/// v_r/r at point q of a ring.
template <class Element, class T>
T hoop_rate(const T (&v)[Element::nodes][Element::dim], int q, const PointGeometry<Element, T> &g)
{
  T sum = v[0][0] * Element::value(q, 0);
  for (int a = 1; a < Element::nodes; ++a)
    sum += v[a][0] * Element::value(q, a);
  return sum / g.radius;
}

/// Takes the forces of Cauchy stress sigma (xx yy zz xy yz zx) at point q from
/// the nodes: the transpose of velocity_gradient and hoop_rate.
template <class Element, class T>
void add_forces(const T (&sigma)[6], int q, const PointGeometry<Element, T> &g,
                T (&force)[Element::nodes][Element::dim])
{
  constexpr int dim        = Element::dim;
  constexpr int slot[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  T             p[dim][dim];
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k)
    {
      T sum = sigma[slot[i][0]] * g.inverse[k][0];
      for (int j = 1; j < dim; ++j)
        sum += sigma[slot[i][j]] * g.inverse[k][j];
      p[i][k] = -g.volume * sum;
    }
  Element::add_slopes(q, p, force);
  if constexpr (Element::hoop)
    for (int a = 0; a < Element::nodes; ++a)
      force[a][0] -= sigma[2] * g.volume / g.radius * Element::value(q, a);
}

/// Lumped masses over density: row sums of the mass matrix, the quadrature
/// weights where nodes and points are one.
template <class Element>
void node_volumes(const double (&x)[Element::nodes][Element::dim], double (&share)[Element::nodes])
{
  std::fill(std::begin(share), std::end(share), 0.);
  for (int q = 0; q < Element::points; ++q)
  {
    PointGeometry<Element, double> g{};
    map_point(x, q, g);
    for (int a = 0; a < Element::nodes; ++a)
      share[a] += Element::value(q, a) * g.volume;
  }
}
} // namespace ogive::fem
