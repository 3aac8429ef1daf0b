// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace ogive
{
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A symmetric second-order tensor, stored xx yy zz xy yz zx. Always three
/// dimensional: plane strain and axial symmetry fill the components they have
/// (axial symmetry: x is the radius r, y the axis z, z the hoop direction).
struct Sym3
{
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  double trace() const { return xx + yy + zz; }

  /// Double contraction a:b with the off-diagonal terms counted twice.
  double contract(const Sym3 &b) const
  {
    return xx * b.xx + yy * b.yy + zz * b.zz + 2 * (xy * b.xy + yz * b.yz + zx * b.zx);
  }

  Sym3 operator+(const Sym3 &b) const
  {
    return {xx + b.xx, yy + b.yy, zz + b.zz, xy + b.xy, yz + b.yz, zx + b.zx};
  }
  Sym3 operator-(const Sym3 &b) const
  {
    return {xx - b.xx, yy - b.yy, zz - b.zz, xy - b.xy, yz - b.yz, zx - b.zx};
  }
  Sym3 operator*(double f) const { return {xx * f, yy * f, zz * f, xy * f, yz * f, zx * f}; }

  Sym3 deviator() const
  {
    const double m = trace() / 3;
    return {xx - m, yy - m, zz - m, xy, yz, zx};
  }
  Sym3 plus_isotropic(double m) const { return {xx + m, yy + m, zz + m, xy, yz, zx}; }

  Mat3 matrix() const
  {
    Mat3 m;
    m << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    return m;
  }
  static Sym3 from_matrix(const Mat3 &m)
  {
    return {m(0, 0),
            m(1, 1),
            m(2, 2),
            .5 * (m(0, 1) + m(1, 0)),
            .5 * (m(1, 2) + m(2, 1)),
            .5 * (m(0, 2) + m(2, 0))};
  }
};

inline Sym3 operator*(double f, const Sym3 &a)
{
  return a * f;
}

/// von Mises stress sqrt(3/2 s:s) of a deviator s.
inline double von_mises(const Sym3 &deviator)
{
  return std::sqrt(1.5 * deviator.contract(deviator));
}
} // namespace ogive
