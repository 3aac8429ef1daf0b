// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cmath>

namespace ogive::fem
{
/// Signs of the corners of the reference cell [-1,1]^dim in VTK order.
inline constexpr double corner_sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Shape functions of the multilinear cell at xi and their slopes d/dxi_k.
template <int dim>
void shape_functions(const Eigen::Matrix<double, dim, 1> &xi, std::array<double, 1 << dim> &weight,
                     std::array<Eigen::Matrix<double, dim, 1>, 1 << dim> &slope)
{
  for (int a = 0; a < 1 << dim; ++a)
  {
    weight[a] = 1;
    slope[a].setOnes();
    for (int i = 0; i < dim; ++i)
    {
      const double factor = .5 * (1 + corner_sign[a][i] * xi[i]);
      weight[a] *= factor;
      for (int k = 0; k < dim; ++k)
        slope[a][k] *= k == i ? .5 * corner_sign[a][i] : factor;
    }
  }
}

/// Inverse of the multilinear map by Newton's method. Returns false where it
/// does not converge or ends beyond |xi_k| = 1 + reach.
template <int dim>
bool weights_of_point(const std::array<std::array<double, dim>, 1 << dim> &x,
                      const std::array<double, dim> &point, double reach,
                      std::array<double, 1 << dim> &weight)
{
  using Vector = Eigen::Matrix<double, dim, 1>;
  Vector                            xi = Vector::Zero();
  std::array<Vector, 1 << dim>      slope;
  constexpr int                     most = 30;
  for (int k = 0; k < most; ++k)
  {
    shape_functions<dim>(xi, weight, slope);
    Vector                          miss;
    Eigen::Matrix<double, dim, dim> J = Eigen::Matrix<double, dim, dim>::Zero();
    for (int i = 0; i < dim; ++i)
    {
      miss[i] = point[i];
      for (int a = 0; a < 1 << dim; ++a)
      {
        miss[i] -= weight[a] * x[a][i];
        J.row(i) += x[a][i] * slope[a].transpose();
      }
    }
    const Vector change = J.partialPivLu().solve(miss);
    if (!change.allFinite() || xi.cwiseAbs().maxCoeff() > 100)
      return false;
    xi += change;
    if (change.cwiseAbs().maxCoeff() < 1e-13)
    {
      shape_functions<dim>(xi, weight, slope);
      return xi.cwiseAbs().maxCoeff() <= 1 + reach;
    }
  }
  return false;
}
} // namespace ogive::fem
