// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/point_geometry.h"

#include <cmath>

/// Bounds of the frequencies of integrated elements with their own lumped
/// masses, from their shape alone. The assembled mesh lies below the largest
/// element (Irons and Treharne, 1971).
namespace ogive::fem
{
template <class T>
struct ShapeBound
{
  T divergence; ///< largest eigenvalue of the mean divergence, m/kg for a unit modulus
  T gradient;   ///< of the mean gradient
  T departures; ///< of the points' departures from it
  T cross;      ///< between the two, zero for a brick
  T length;     ///< edge of the cube with the same sum |b|^2, m

  /// Square of the frequency bound, 1/s^2: lambda and shear modulus in Pa.
  T frequency2(const T &lambda, double shear, bool mean_dilatation) const
  {
    using std::sqrt, std::max;
    const T points = mean_dilatation ? T(2. * shear) : T(lambda + 2. * shear);
    return max(T(lambda * divergence + 2. * shear * gradient), T(points * departures)) +
           sqrt((3. * lambda + 2. * shear) * points) * cross;
  }
};

/// Points with masses that the nodes share. The gradient is parted into the mean
/// of the element and the points' departures from it, whose quadratic forms add
/// up without a cross term; for a brick their ranges are orthogonal, so the
/// larger one counts, and `cross` bounds what a distorted shape adds.
template <class Element, class T>
ShapeBound<T> shape_bound(const T (&x)[Element::nodes][Element::dim],
                          const PointGeometry<Element, T> (&g)[Element::points], const T (&inverse_mass)[Element::nodes])
{
  constexpr int dim = Element::dim, nodes = Element::nodes, points = Element::points;
  constexpr int rows = dim + (Element::hoop ? 1 : 0); // gradient along each axis, hoop
  T             volume(0.), mean[nodes][rows];
  T             row[points][nodes][rows];
  for (auto &node : mean)
    std::fill(std::begin(node), std::end(node), T(0.));
  for (int q = 0; q < points; ++q)
  {
    volume += g[q].volume;
    for (int a = 0; a < nodes; ++a)
    {
      for (int i = 0; i < dim; ++i)
      {
        T sum = g[q].inverse[0][i] * Element::slope(0, q, a);
        for (int k = 1; k < dim; ++k)
          sum += g[q].inverse[k][i] * Element::slope(k, q, a);
        row[q][a][i] = sum;
      }
      if constexpr (Element::hoop)
        row[q][a][dim] = Element::value(q, a) / g[q].radius;
      for (int i = 0; i < rows; ++i)
        mean[a][i] += g[q].volume * row[q][a][i];
    }
  }
  const T inverse = 1. / volume;
  T       unit(0.);
  T       gram[rows][rows];
  for (auto &line : gram)
    std::fill(std::begin(line), std::end(line), T(0.));
  for (int a = 0; a < nodes; ++a)
  {
    for (int i = 0; i < rows; ++i)
      mean[a][i] = mean[a][i] * inverse;
    for (int i = 0; i < dim; ++i)
      unit += mean[a][i] * mean[a][i];
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j)
        gram[i][j] += inverse_mass[a] * mean[a][i] * mean[a][j];
  }
  T trace(0.), squares(0.);
  for (int i = 0; i < rows; ++i)
    trace += gram[i][i];
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j)
    {
      const T entry = i == j ? T(gram[i][i] - trace * (1. / rows)) : gram[i][j];
      squares += entry * entry;
    }
  ShapeBound<T> bound;
  using std::sqrt;
  bound.length     = sqrt((dim == 3 ? 1.5 : 2.) / unit);
  bound.divergence = trace;
  if constexpr (Element::hoop)
    bound.divergence += 2. * gram[0][dim];
  bound.divergence = bound.divergence * volume;
  bound.gradient   = volume * (trace * (1. / rows) + sqrt(squares * (1. - 1. / rows)));

  T departures(0.), cross(0.);
  for (int q = 0; q < points; ++q)
  {
    T product[rows][rows];
    for (auto &line : product)
      std::fill(std::begin(line), std::end(line), T(0.));
    for (int a = 0; a < nodes; ++a)
      for (int j = 0; j < rows; ++j)
      {
        const T off = row[q][a][j] - mean[a][j], weighted = inverse_mass[a] * off;
        departures += g[q].volume * off * weighted;
        for (int i = 0; i < rows; ++i)
          product[i][j] += mean[a][i] * weighted;
      }
    for (const auto &line : product)
      for (const T &entry : line)
        cross += g[q].volume * entry * entry;
  }
  bound.departures = departures;
  bound.cross      = sqrt(volume * cross);
  return bound;
}

/// Nodes at the points, tensor numbering. With H_jk = grad xi_j . grad xi_k and
/// `line`, the largest eigenvalue of a line of unit modulus and density on
/// [-1, 1], a point's part is bounded by line sum |H_jk|, up to second order in
/// what is skew. `weight_mass`: least node mass over reference weight, kg.
template <class Element, class T>
T point_bound(int q, const PointGeometry<Element, T> &g, double line, const T &weight_mass)
{
  constexpr int dim = Element::dim;
  T             H[dim][dim], sum(0.);
  using std::abs;
  for (int j = 0; j < dim; ++j)
    for (int k = 0; k < dim; ++k)
    {
      H[j][k] = g.inverse[j][0] * g.inverse[k][0];
      for (int i = 1; i < dim; ++i)
        H[j][k] += g.inverse[j][i] * g.inverse[k][i];
      sum += abs(H[j][k]);
    }
  for (int j = 0; j < dim; ++j)
    for (int k = 0; k < dim; ++k)
      if (j != k)
        sum += (dim - 1.) * H[j][k] * H[j][k] / (H[j][j] + H[k][k]);
  return sum * g.volume * (line / Element::weight(q)) / weight_mass;
}

/// Edge of the cube with the same sum of |grad xi|^2 as the cell around a point
/// of a spectral element, m.
template <class Element, class T>
T point_length(const PointGeometry<Element, T> &g)
{
  T sum(0.);
  for (const auto &line : g.inverse)
    for (const T &entry : line)
      sum += entry * entry;
  using std::sqrt;
  return 2. / Element::degree * sqrt(double(Element::dim) / sum);
}
} // namespace ogive::fem
