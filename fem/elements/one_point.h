// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/geometry.h"
#include "fem/elements/kinematics.h"

#include <cmath>

namespace ogive::fem
{
/// The mechanics that all one-point elements share: mean strain at the middle
/// of the step, Flanagan-Belytschko hourglass rates, corner forces, and the
/// bound of the frequency. T is double (tests) or a register of doubles.

/// Strain and spin increments of one step (order of materials::Increments), the
/// increment of volume strain, the hourglass rates (m/s), and the rate of strain
/// in the shape at the end (1/s, shear components twice: dual to the stress).
template <class Element, class T>
struct Deformation
{
  T strain[6], spin[3], trace, dual[6];
  T rate[Geometry<Element, T>::modes][Element::dim];
};

template <class Element, class T>
void hourglass_rates(const T (&x)[Element::corners][Element::dim], const T (&v)[Element::corners][Element::dim],
                     const T (&L)[Element::dim][Element::dim], Geometry<Element, T> &g,
                     Deformation<Element, T> &d)
{
  for (int m = 0; m < Element::modes; ++m)
    for (int i = 0; i < Element::dim; ++i)
    {
      T sx(0.), sv(0.);
      for (int a = 0; a < Element::corners; ++a)
        if (Element::hourglass[m][a] > 0)
          sx += x[a][i], sv += v[a][i];
        else
          sx -= x[a][i], sv -= v[a][i];
      g.skew[m][i] = sx;
      d.rate[m][i] = sv;
    }
  // Patterns made orthogonal to linear fields: gamma = Gamma - (Gamma.x) B/V.
  for (int m = 0; m < Element::modes; ++m)
    for (int i = 0; i < Element::dim; ++i)
      for (int j = 0; j < Element::dim; ++j)
        d.rate[m][i] -= g.skew[m][j] * L[i][j];
}

/// The rate of strain that the corner forces of this shape are dual to.
template <int dim, class T>
void dual_rate(const T (&L)[dim][dim], T (&dual)[6])
{
  for (T &component : dual)
    component = T(0.);
  for (int i = 0; i < dim; ++i)
    dual[i] = L[i][i];
  if constexpr (dim >= 2)
    dual[3] = L[0][1] + L[1][0];
  if constexpr (dim == 3)
  {
    dual[4] = L[1][2] + L[2][1];
    dual[5] = L[0][2] + L[2][0];
  }
}

/// Shape at the end of the step and what happened during it. x (m) and v (m/s)
/// at the corners, dt in s.
template <class Element, class T>
void deform(const T (&x)[Element::corners][Element::dim], const T (&v)[Element::corners][Element::dim], T dt,
            Geometry<Element, T> &g, Deformation<Element, T> &d)
{
  constexpr int dim = Element::dim;
  Element::gradient(x, g);
  const T inverse = 1. / g.volume;
  T       L[dim][dim];
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      T sum = v[0][i] * g.B[0][j];
      for (int a = 1; a < Element::corners; ++a)
        sum += v[a][i] * g.B[a][j];
      L[i][j] = sum * inverse;
    }
  hourglass_rates<Element, T>(x, v, L, g, d);
  dual_rate<dim, T>(L, d.dual);
  to_middle<dim, T>(L, .5 * dt);

  for (T &s : d.strain)
    s = T(0.);
  for (T &s : d.spin)
    s = T(0.);
  d.trace = T(0.);
  for (int i = 0; i < dim; ++i)
  {
    d.strain[i] = L[i][i] * dt;
    d.trace += d.strain[i];
  }
  if constexpr (dim >= 2)
  {
    d.strain[3] = .5 * dt * (L[0][1] + L[1][0]);
    d.spin[0]   = .5 * dt * (L[0][1] - L[1][0]);
  }
  if constexpr (dim == 3)
  {
    d.strain[4] = .5 * dt * (L[1][2] + L[2][1]);
    d.strain[5] = .5 * dt * (L[0][2] + L[2][0]);
    d.spin[1]   = .5 * dt * (L[1][2] - L[2][1]);
    d.spin[2]   = .5 * dt * (L[2][0] - L[0][2]);
  }
  if constexpr (Element::hoop)
  {
    T rate(0.);
    for (int a = 0; a < Element::corners; ++a)
      rate += v[a][0] * g.hoop[a];
    rate        = rate * inverse;
    d.dual[2]   = rate;
    d.strain[2] = dt * rate / (1. - .5 * dt * rate);
    d.trace += d.strain[2];
  }
}

/// Turns the generalised hourglass forces Q with the spin of the step by the
/// same rotation (Cayley's) that the materials give to the stress.
template <class Element, class T>
void turn(const T (&spin)[3], T (&Q)[Geometry<Element, T>::modes][Element::dim])
{
  if constexpr (Element::dim == 2)
  {
    const T w = -.5 * spin[0], f = 2. / (1. + w * w); // axial vector of half the spin
    for (auto &q : Q)
    {
      const T ax = -w * q[1], ay = w * q[0];
      q[0] += f * (ax - w * ay);
      q[1] += f * (ay + w * ax);
    }
  }
  else if constexpr (Element::dim == 3)
  {
    const T w[3] = {-.5 * spin[1], -.5 * spin[2], -.5 * spin[0]};
    const T f    = 2. / (1. + w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    for (auto &q : Q)
    {
      const T a[3] = {w[1] * q[2] - w[2] * q[1], w[2] * q[0] - w[0] * q[2], w[0] * q[1] - w[1] * q[0]};
      q[0] += f * (a[0] + w[1] * a[2] - w[2] * a[1]);
      q[1] += f * (a[1] + w[2] * a[0] - w[0] * a[2]);
      q[2] += f * (a[2] + w[0] * a[1] - w[1] * a[0]);
    }
  }
}

/// What turns B_a into the linear part of the force on corner a, Pa.
template <class Element, class T, class Shape>
void force_density(const Shape &g, const T (&sigma)[6], const T (&Q)[Geometry<Element, T>::modes][Element::dim],
                   T (&P)[Element::dim][Element::dim])
{
  constexpr int slot[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  const T       inverse    = 1. / g.volume;
  for (int i = 0; i < Element::dim; ++i)
    for (int j = 0; j < Element::dim; ++j)
    {
      T sum(0.);
      for (int m = 0; m < Element::modes; ++m)
        sum += Q[m][i] * g.skew[m][j];
      P[i][j] = sum * inverse - sigma[slot[i][j]];
    }
}

/// Forces (N) that an element with Cauchy stress sigma (xx yy zz xy yz zx,
/// bulk viscosity already in it) puts on its corners.
template <class Element, class T>
void corner_forces(const Geometry<Element, T> &g, const T (&sigma)[6],
                   const T (&Q)[Geometry<Element, T>::modes][Element::dim],
                   T (&force)[Element::corners][Element::dim])
{
  constexpr int dim = Element::dim;
  T             P[dim][dim];
  force_density<Element, T>(g, sigma, Q, P);
  for (int a = 0; a < Element::corners; ++a)
    for (int i = 0; i < dim; ++i)
    {
      T f = P[i][0] * g.B[a][0];
      for (int j = 1; j < dim; ++j)
        f += P[i][j] * g.B[a][j];
      for (int m = 0; m < Element::modes; ++m)
        if (Element::hourglass[m][a] > 0)
          f -= Q[m][i];
        else
          f += Q[m][i];
      force[a][i] = f;
    }
  if constexpr (Element::hoop)
    for (int a = 0; a < Element::corners; ++a)
      force[a][0] -= sigma[2] * g.hoop[a];
}

/// sum_a w_a b_a (x) b_a with b = B/volume and what follows from it.
/// w_a = 1 gives lengths, w_a = 1/corner mass gives frequencies.
template <class Element, class T>
struct Gram
{
  T largest;    ///< bound of the largest eigenvalue of sum w b (x) b (plus the hoop part)
  T divergence; ///< sum w |grad N + hoop e_r|^2: the same for the divergence
  T trace;      ///< sum w |b|^2
};

template <class Element, class T>
Gram<Element, T> bounds_of(const T (&G)[Element::dim][Element::dim], T hoop_part, T cross)
{
  constexpr int dim = Element::dim;
  T trace = G[0][0];
  for (int i = 1; i < dim; ++i)
    trace += G[i][i];
  // Largest eigenvalue <= mean + sqrt((d-1)/d) |deviator|: exact where all but
  // one agree, and independent of the frame.
  T deviator(0.);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      const T entry = i == j ? T(G[i][i] - trace * (1. / dim)) : G[i][j];
      deviator += entry * entry;
    }
  using std::sqrt;
  Gram<Element, T> result;
  result.trace      = trace;
  result.largest    = trace * (1. / dim) + sqrt(deviator * (1. - 1. / dim)) + hoop_part;
  result.divergence = trace + hoop_part + 2. * cross;
  return result;
}

template <class Element, class T>
Gram<Element, T> gram(const Geometry<Element, T> &g, const T *weight)
{
  constexpr int dim     = Element::dim;
  const T       inverse = 1. / (g.volume * g.volume);
  T             G[dim][dim], hoop_part(0.), cross(0.);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j <= i; ++j)
    {
      T sum(0.);
      for (int a = 0; a < Element::corners; ++a)
        if constexpr (Element::hoop)
          sum += weight[a] * g.B[a][i] * g.B[a][j];
        else
          sum += g.B[a][i] * g.B[a][j];
      G[i][j] = G[j][i] = (Element::hoop ? sum : sum * weight[0]) * inverse;
    }
  if constexpr (Element::hoop)
    for (int a = 0; a < Element::corners; ++a)
    {
      hoop_part += weight[a] * g.hoop[a] * g.hoop[a] * inverse;
      cross += weight[a] * g.hoop[a] * g.B[a][0] * inverse;
    }
  return bounds_of<Element, T>(G, hoop_part, cross);
}

/// Edge length of the cube with the same sum |b|^2 (of the unit Gram matrix).
/// It follows the short direction of a flat element.
template <class Element, class T>
T length_of(T unit_trace)
{
  using std::sqrt;
  constexpr double cube = Element::dim == 1 ? 2. : Element::dim == 2 ? 2. : 1.5;
  return sqrt(cube / unit_trace);
}
} // namespace ogive::fem
