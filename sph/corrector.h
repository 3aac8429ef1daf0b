// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Dense>

namespace ogive::sph
{
/// M^-1, or the unit matrix where M is close to singular: too few neighbours,
/// or all of them on a line or in a plane. The bound on |M^-1| keeps the pair
/// stiffness, and with it the step, bounded.
template <int dim>
bool corrector(const Eigen::Matrix<double, dim, dim> &m, Eigen::Matrix<double, dim, dim> &b)
{
  constexpr double largest = 10;
  const double     det     = m.determinant();
  const double     scale   = m.trace() / dim;
  double           cube    = 1;
  for (int d = 0; d < dim; ++d)
    cube *= scale;
  if (det > 1e-4 * cube && scale > .05)
  {
    b = m.inverse();
    b = (.5 * (b + b.transpose())).eval();
    if (b.cwiseAbs().rowwise().sum().maxCoeff() < largest)
      return true;
  }
  b.setIdentity();
  return false;
}
} // namespace ogive::sph
