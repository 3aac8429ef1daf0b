// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"

#include <array>

namespace ogive::materials
{
/// Turns the symmetric tensor s (xx yy zz xy yz zx) by
/// R = I + (I - w/2)^-1 w, s <- R s R^T (Hughes and Winget, Int. J. Numer. Meth.
/// Eng. 15 (1980) 1862), with w the midpoint spin times dt, w_xy = w(0, 1) and so
/// on. R is exactly orthogonal, for any w.
///
/// With the axial vector a of w/2, R = ((1 - a.a) I + 2 a a^T + 2 [a])/(1 + a.a).
template <class T>
void rotate_hughes_winget(std::array<T, 6> &s, T w_xy, T w_yz, T w_zx)
{
  const T x = T(-.5) * w_yz, y = T(-.5) * w_zx, z = T(-.5) * w_xy;
  const T f   = T(2) / (T(1) + x * x + y * y + z * z);
  const T fx = f * x, fy = f * y, fz = f * z;
  const T rxx = T(1) - fy * y - fz * z, ryy = T(1) - fx * x - fz * z, rzz = T(1) - fx * x - fy * y;
  const T rxy = fx * y - fz, ryx = fx * y + fz;
  const T rxz = fx * z + fy, rzx = fx * z - fy;
  const T ryz = fy * z - fx, rzy = fy * z + fx;

  const auto [sxx, syy, szz, sxy, syz, szx] = s;
  const T axx = rxx * sxx + rxy * sxy + rxz * szx, axy = rxx * sxy + rxy * syy + rxz * syz,
          axz = rxx * szx + rxy * syz + rxz * szz;
  const T ayx = ryx * sxx + ryy * sxy + ryz * szx, ayy = ryx * sxy + ryy * syy + ryz * syz,
          ayz = ryx * szx + ryy * syz + ryz * szz;
  const T azx = rzx * sxx + rzy * sxy + rzz * szx, azy = rzx * sxy + rzy * syy + rzz * syz,
          azz = rzx * szx + rzy * syz + rzz * szz;
  s = {axx * rxx + axy * rxy + axz * rxz,
       ayx * ryx + ayy * ryy + ayz * ryz,
       azx * rzx + azy * rzy + azz * rzz,
       axx * ryx + axy * ryy + axz * ryz,
       ayx * rzx + ayy * rzy + ayz * rzz,
       azx * rxx + azy * rxy + azz * rxz};
}

/// Turns s by the Jaumann increment s <- s + w s - s w, first order in w: the
/// form of the SPH literature, for comparison. It does not keep the invariants
/// of s in a finite step.
inline Sym3 rotate_jaumann(const Sym3 &s, double w_xy, double w_yz, double w_zx)
{
  Mat3 w;
  w << 0, w_xy, -w_zx, -w_xy, 0, w_yz, w_zx, -w_yz, 0;
  const Mat3 m = s.matrix();
  return Sym3::from_matrix(m + w * m - m * w);
}
} // namespace ogive::materials
