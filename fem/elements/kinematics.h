// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::fem
{
/// Inverse of a dim x dim matrix, and its determinant.
template <int dim, class T>
T invert(const T (&m)[dim][dim], T (&inverse)[dim][dim])
{
  if constexpr (dim == 1)
  {
    inverse[0][0] = 1. / m[0][0];
    return m[0][0];
  }
  else if constexpr (dim == 2)
  {
    const T det = m[0][0] * m[1][1] - m[0][1] * m[1][0], d = 1. / det;
    inverse[0][0] = d * m[1][1], inverse[0][1] = -d * m[0][1];
    inverse[1][0] = -d * m[1][0], inverse[1][1] = d * m[0][0];
    return det;
  }
  else
  {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
        inverse[i][j] = m[p][r] * m[q][s] - m[p][s] * m[q][r];
      }
    const T det = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0], d = 1. / det;
    for (auto &row : inverse)
      for (T &entry : row)
        entry = entry * d;
    return det;
  }
}

/// L <- L (I - dt/2 L)^-1: the gradient at the middle of the step from that at
/// its end, exact for affine motion, so that a rigid turn strains nothing.
template <int dim, class T>
void to_middle(T (&L)[dim][dim], T half_dt)
{
  T m[dim][dim], inverse[dim][dim], end[dim][dim];
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      m[i][j]   = T(i == j ? 1. : 0.) - half_dt * L[i][j];
      end[i][j] = L[i][j];
    }
  invert<dim, T>(m, inverse);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      T sum(0.);
      for (int k = 0; k < dim; ++k)
        sum += end[i][k] * inverse[k][j];
      L[i][j] = sum;
    }
}

/// Strain and spin of a step at one point (order of materials::Increments).
template <class T>
struct PointIncrement
{
  T strain[6], spin[3];
};

/// From the velocity gradient at the end of the step, rates across the plane
/// included (`normal`: those of z in the plane, of the hoop in axial symmetry),
/// to what the middle of the step saw.
template <int dim, class T>
void increments_of(T (&L)[dim][dim], const T &normal, T dt, PointIncrement<T> &out)
{
  to_middle<dim, T>(L, .5 * dt);
  for (T &s : out.strain)
    s = T(0.);
  for (T &s : out.spin)
    s = T(0.);
  for (int i = 0; i < dim; ++i)
    out.strain[i] = L[i][i] * dt;
  if constexpr (dim == 2)
    out.strain[2] = dt * normal / (1. - .5 * dt * normal);
  if constexpr (dim >= 2)
  {
    out.strain[3] = .5 * dt * (L[0][1] + L[1][0]);
    out.spin[0]   = .5 * dt * (L[0][1] - L[1][0]);
  }
  if constexpr (dim == 3)
  {
    out.strain[4] = .5 * dt * (L[1][2] + L[2][1]);
    out.strain[5] = .5 * dt * (L[0][2] + L[2][0]);
    out.spin[1]   = .5 * dt * (L[1][2] - L[2][1]);
    out.spin[2]   = .5 * dt * (L[2][0] - L[0][2]);
  }
}
} // namespace ogive::fem
