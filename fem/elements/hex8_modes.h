// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/hex8.h"
#include "fem/elements/one_point.h"

/// The one-point brick by the modes of its map instead of its corners: the same
/// element as Hex8 in fewer operations.
///
/// x = 1/8 (X + R xi + S eta + T zeta + H1 eta zeta + H2 zeta xi + H3 xi eta + H4 xi eta zeta)
/// with R = sum s_a x_a and so on. Products of the column vectors of its Jacobian
/// that are odd in a coordinate have no mean, so
///   64 V = [R S T] + 1/3 ([R H3 H2] + [S H1 H3] + [T H2 H1])
/// and the mean gradient is B_a = sum_m s_ma dV/dX_m; H4 takes no part. The signs
/// s_m are orthogonal, so what sums over corners sums over modes.
namespace ogive::fem
{
/// Modes in this order: R S T, then H1 .. H4 as the rows of Hex8::hourglass.
template <class T>
struct ModalShape
{
  static constexpr int modes = 4;

  T volume;         ///< m^3
  T area[6][3];     ///< dV/dX_m, m^2, R S T H1 H2 H3
  T skew[modes][3]; ///< H1 .. H4, m
};

/// Sums over the corners with the signs of each mode but the constant one.
template <class T>
void modes_of(const T (&x)[8][3], T (&X)[7][3])
{
  for (int i = 0; i < 3; ++i)
  {
    const T d0 = x[1][i] - x[0][i], d1 = x[2][i] - x[3][i], d2 = x[5][i] - x[4][i], d3 = x[6][i] - x[7][i];
    const T s0 = x[1][i] + x[0][i], s1 = x[2][i] + x[3][i], s2 = x[5][i] + x[4][i], s3 = x[6][i] + x[7][i];
    const T bottom = d1 + d0, top = d3 + d2, bottom_skew = d1 - d0, top_skew = d3 - d2;
    const T bottom_rise = s1 - s0, top_rise = s3 - s2;
    X[0][i] = top + bottom;
    X[1][i] = top_rise + bottom_rise;
    X[2][i] = (s2 - s0) + (s3 - s1);
    X[3][i] = top_rise - bottom_rise;
    X[4][i] = top - bottom;
    X[5][i] = top_skew + bottom_skew;
    X[6][i] = top_skew - bottom_skew;
  }
}

/// The transpose: f_a = sum_m s_ma F_m.
template <class T>
void corners_of(const T (&F)[7][3], T (&f)[8][3])
{
  for (int i = 0; i < 3; ++i)
  {
    const T bottom = F[0][i] - F[4][i], top = F[0][i] + F[4][i];
    const T bottom_rise = F[1][i] - F[3][i], top_rise = F[1][i] + F[3][i];
    const T bottom_skew = F[5][i] - F[6][i], top_skew = F[5][i] + F[6][i];
    const T d0 = bottom - bottom_skew, d1 = bottom + bottom_skew, d2 = top - top_skew, d3 = top + top_skew;
    const T s0 = -bottom_rise - F[2][i], s1 = bottom_rise - F[2][i];
    const T s2 = F[2][i] - top_rise, s3 = F[2][i] + top_rise;
    f[0][i] = s0 - d0, f[1][i] = s0 + d0, f[2][i] = s1 + d1, f[3][i] = s1 - d1;
    f[4][i] = s2 - d2, f[5][i] = s2 + d2, f[6][i] = s3 + d3, f[7][i] = s3 - d3;
  }
}

/// dV/dX of the first six modes; returns V.
template <class T>
T areas_of(const T (&X)[7][3], T (&area)[6][3])
{
  const T(&R)[3] = X[0], (&S)[3] = X[1], (&U)[3] = X[2], (&H1)[3] = X[3], (&H2)[3] = X[4], (&H3)[3] = X[5];
  for (int i = 0; i < 3; ++i)
  {
    const int  j = (i + 1) % 3, k = (i + 2) % 3;
    const auto cross = [j, k](const T(&a)[3], const T(&b)[3]) { return a[j] * b[k] - a[k] * b[j]; };
    area[0][i] = (cross(S, U) + cross(H3, H2) * (1. / 3)) * (1. / 64);
    area[1][i] = (cross(U, R) + cross(H1, H3) * (1. / 3)) * (1. / 64);
    area[2][i] = (cross(R, S) + cross(H2, H1) * (1. / 3)) * (1. / 64);
    area[3][i] = (cross(H3, S) + cross(U, H2)) * (1. / 192);
    area[4][i] = (cross(H1, U) + cross(R, H3)) * (1. / 192);
    area[5][i] = (cross(S, H1) + cross(H2, R)) * (1. / 192);
  }
  T volume = X[0][0] * area[0][0];
  for (int m = 1; m < 6; ++m)
    volume += X[m][0] * area[m][0];
  return volume;
}

/// sum_a v_a (x) B_a.
template <class T>
void flux_of(const T (&V)[7][3], const T (&area)[6][3], T (&W)[3][3])
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      T sum = V[0][i] * area[0][j];
      for (int m = 1; m < 6; ++m)
        sum += V[m][i] * area[m][j];
      W[i][j] = sum;
    }
}

/// Power (W) that the element with stress sigma and hourglass forces Q in the
/// shape of modes X takes from corners with the velocities of modes V.
template <class T>
T power_taken(const T (&X)[7][3], const T (&V)[7][3], const T (&sigma)[6], const T (&Q)[4][3])
{
  T       area[6][3], W[3][3];
  const T inverse = 1. / areas_of(X, area);
  flux_of(V, area, W);
  T power = sigma[0] * W[0][0] + sigma[1] * W[1][1] + sigma[2] * W[2][2] + sigma[3] * (W[0][1] + W[1][0]) +
            sigma[4] * (W[1][2] + W[2][1]) + sigma[5] * (W[0][2] + W[2][0]);
  T patterns(0.), linear(0.);
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
    {
      patterns += Q[m][i] * V[3 + m][i];
      linear += Q[m][i] * (X[3 + m][0] * W[i][0] + X[3 + m][1] * W[i][1] + X[3 + m][2] * W[i][2]);
    }
  return power + (patterns - linear * inverse);
}

/// Shape and motion from the modes of positions at the end and of velocities.
template <class T>
void deform_modes(const T (&X)[7][3], const T (&V)[7][3], T dt, ModalShape<T> &g, Deformation<Hex8, T> &d)
{
  g.volume = areas_of(X, g.area);
  T L[3][3];
  flux_of(V, g.area, L);
  const T inverse = 1. / g.volume;
  for (auto &row : L)
    for (T &entry : row)
      entry = entry * inverse;
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
      g.skew[m][i] = X[3 + m][i];
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
      d.rate[m][i] =
        V[3 + m][i] - (g.skew[m][0] * L[i][0] + g.skew[m][1] * L[i][1] + g.skew[m][2] * L[i][2]);
  dual_rate<3, T>(L, d.dual);
  PointIncrement<T> inc;
  increments_of<3, T>(L, T(0.), dt, inc);
  for (int c = 0; c < 6; ++c)
    d.strain[c] = inc.strain[c];
  for (int c = 0; c < 3; ++c)
    d.spin[c] = inc.spin[c];
  d.trace = inc.strain[0] + inc.strain[1] + inc.strain[2];
}

template <class Element, class T>
void deform(const T (&x)[8][3], const T (&v)[8][3], T dt, ModalShape<T> &g, Deformation<Element, T> &d)
{
  T X[7][3], V[7][3];
  modes_of(x, X);
  modes_of(v, V);
  deform_modes(X, V, dt, g, d);
}

/// As for Geometry; one weight for all corners.
template <class Element, class T>
Gram<Element, T> gram(const ModalShape<T> &g, const T *weight)
{
  const T scale = 8. * weight[0] / (g.volume * g.volume);
  T       G[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
    {
      T sum = g.area[0][i] * g.area[0][j];
      for (int m = 1; m < 6; ++m)
        sum += g.area[m][i] * g.area[m][j];
      G[i][j] = G[j][i] = sum * scale;
    }
  return bounds_of<Element, T>(G, T(0.), T(0.));
}

template <class Element, class T>
void corner_forces(const ModalShape<T> &g, const T (&sigma)[6], const T (&Q)[4][3], T (&force)[8][3])
{
  T P[3][3], F[7][3];
  force_density<Element, T>(g, sigma, Q, P);
  for (int m = 0; m < 7; ++m)
    for (int i = 0; i < 3; ++i)
    {
      F[m][i] = m < 3 ? T(0.) : -Q[m < 3 ? 0 : m - 3][i];
      for (int j = 0; j < 3 && m < 6; ++j)
        F[m][i] += P[i][j] * g.area[m][j];
    }
  corners_of(F, force);
}

/// Integral of the gradient of a corner's shape function.
template <class T>
void corner_areas(const ModalShape<T> &g, T (&B)[8][3])
{
  T F[7][3];
  for (int m = 0; m < 7; ++m)
    for (int i = 0; i < 3; ++i)
      F[m][i] = m < 6 ? g.area[m][i] : T(0.);
  corners_of(F, B);
}
template <class Element, class T>
void corner_areas(const Geometry<Element, T> &g, T (&B)[Element::corners][Element::dim])
{
  for (int a = 0; a < Element::corners; ++a)
    for (int i = 0; i < Element::dim; ++i)
      B[a][i] = g.B[a][i];
}

/// What a group of one-point elements keeps of their shapes.
template <class Element, class T>
struct ShapeOf
{
  using type = Geometry<Element, T>;
};
template <class T>
struct ShapeOf<Hex8, T>
{
  using type = ModalShape<T>;
};
} // namespace ogive::fem
