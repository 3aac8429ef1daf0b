// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/axis_factor.h"

#include "sph/kernels/kernels.h"

#include <Eigen/Dense>

#include <cmath>

namespace ogive::sph
{
namespace
{
constexpr int nodes_per_h = 32; ///< of the table
constexpr int points      = 4;  ///< of the quadrature, between two nodes
constexpr int reach       = 6;  ///< h at which the factor is held at 1

/// d/dr of the kernel summed over z, h = 1, at (m + 1/2) points of the quadrature.
template <class Kernel>
std::vector<double> line_slopes()
{
  constexpr double          step = 1. / (nodes_per_h * points), dz = 1. / 256;
  const KernelAt<Kernel, 2> kernel(1.);
  std::vector<double>       slopes;
  for (double s = .5 * step; s < Kernel::support; s += step)
  {
    double sum = 0;
    for (double z = .5 * dz; z < Kernel::support; z += dz)
    {
      const double r = std::hypot(s, z);
      if (r < Kernel::support)
        sum += 2 * dz * s * kernel.slope(r, 1 / r);
    }
    slopes.push_back(sum);
  }
  return slopes;
}

template <class Kernel>
std::vector<double> solve()
{
  constexpr double    step   = 1. / (nodes_per_h * points);
  const auto          slopes = line_slopes<Kernel>();
  const int           n      = reach * nodes_per_h; // node n holds 1
  Eigen::MatrixXd     a      = -Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd     b      = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < n; ++k)
    for (int m = -static_cast<int>(slopes.size()); m < static_cast<int>(slopes.size()); ++m)
    {
      // Source at r_k - (m + 1/2) step; slopes are odd in the distance.
      const double distance = (m + .5) * step;
      const double source   = std::abs(static_cast<double>(k) / nodes_per_h - distance);
      const double weight   = step * source * (m < 0 ? -slopes[-m - 1] : slopes[m]);
      const int    left     = std::min(static_cast<int>(source * nodes_per_h), n);
      const double share    = std::min(source * nodes_per_h - left, 1.);
      const auto   add      = [&](int node, double w) {
        if (node < n)
          a(k, node) += w;
        else
          b(k) -= w;
      };
      add(left, weight * (1 - share));
      add(left + 1, weight * share);
    }
  const Eigen::VectorXd phi = a.partialPivLu().solve(b);
  std::vector<double>   table(phi.begin(), phi.end());
  table.push_back(1);
  return table;
}
} // namespace

AxisFactor::AxisFactor(const std::string &kernel)
  : per_unit_(nodes_per_h)
  , phi_(with_kernel(kernel, [](auto k) { return solve<decltype(k)>(); }))
{}
} // namespace ogive::sph
