// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/step_bound.h"

#include "sph/kernels/kernels.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <vector>

namespace ogive::sph
{
namespace
{
template <int dim>
using Vec = Eigen::Matrix<double, dim, 1>;

/// A lattice neighbour at unit spacing and what it weighs in each sum.
template <int dim>
struct Neighbour
{
  Vec<dim> x;
  double   gradient, viscosity, hourglass, filter, value;
};

template <int dim, class Kernel>
std::vector<Neighbour<dim>> lattice_neighbours(const input::SphOptions &o)
{
  const double                h = o.h_over_dx, wide = h * o.correction_support;
  const KernelAt<Kernel, dim> kernel(h), filter(wide);
  const int                   reach = static_cast<int>(std::ceil(Kernel::support * std::max(h, wide)));
  std::vector<Neighbour<dim>> all;
  double                      shepard = filter.value(0.);
  int                         count   = 1;
  for (int d = 0; d < dim; ++d)
    count *= 2 * reach + 1;
  for (int k = 0; k < count; ++k)
  {
    Vec<dim> x;
    for (int d = 0, rest = k; d < dim; ++d, rest /= 2 * reach + 1)
      x[d] = rest % (2 * reach + 1) - reach;
    const double r = x.norm();
    if (r == 0)
      continue;
    const double g = -kernel.slope(r, 1 / r) * r;
    all.push_back({x, g, g * r / (r * r + .01 * h * h), g / r, filter.value(r), kernel.value(r)});
    shepard += filter.value(r);
  }
  for (auto &n : all)
    n.filter /= shepard;
  return all;
}

template <int dim>
LatticeShares scan(const std::vector<Neighbour<dim>> &neighbours, double h)
{
  const int     m      = dim == 3 ? 12 : 48; // k from 0 to pi along each axis
  double        sum[3] = {0, 0, 0};
  LatticeShares best{0, 0, 0, 0, 0, 0};
  for (const auto &n : neighbours)
  {
    sum[0] += n.gradient;
    sum[1] += n.viscosity;
    sum[2] += n.hourglass;
    best.weight += n.value;
    best.offset += n.value * std::abs(n.x[0]) / h;
  }
  best.offset /= best.weight;
  int count = 1;
  for (int d = 0; d < dim; ++d)
    count *= m + 1;
  for (int q = 0; q < count; ++q)
  {
    Vec<dim> k, gradient = Vec<dim>::Zero();
    for (int d = 0, rest = q; d < dim; ++d, rest /= m + 1)
      k[d] = (rest % (m + 1)) * M_PI / m;
    using Matrix   = Eigen::Matrix<double, dim, dim>;
    Matrix viscous = Matrix::Zero(), hourglass = Matrix::Zero();
    double filter = 0;
    for (const auto &n : neighbours)
    {
      const double   phase = k.dot(n.x), away = 1 - std::cos(phase);
      const Vec<dim> e = n.x.normalized();
      gradient += n.gradient * std::sin(phase) * e;
      viscous += n.viscosity * away * e * e.transpose();
      hourglass += n.hourglass * away * e * e.transpose();
      filter += n.filter * away;
    }
    const auto top = [](const Matrix &a) {
      return Eigen::SelfAdjointEigenSolver<Matrix>(a, Eigen::EigenvaluesOnly).eigenvalues()[dim - 1];
    };
    best.frequency = std::max(best.frequency, gradient.norm() / sum[0]);
    const double viscosity = top(viscous) / sum[1];
    best.viscosity = std::max(best.viscosity, viscosity);
    best.weak      = std::max(best.weak, viscosity * filter);
    best.hourglass = std::max(best.hourglass, top(hourglass) / sum[2]);
  }
  return best;
}
} // namespace

template <int dim>
LatticeShares lattice_shares(const input::SphOptions &o)
{
  return with_kernel(o.kernel, [&](auto kernel) {
    return scan<dim>(lattice_neighbours<dim, decltype(kernel)>(o), o.h_over_dx);
  });
}

double largest_step(double w, double damping)
{
  const double a = .25 * w * w, b = .5 * damping;
  // The root of a dt^2 + b dt = 1, in the form that survives a -> 0.
  const double below = b + std::sqrt(b * b + 4 * a);
  return below > 0 ? 2 / below : std::numeric_limits<double>::infinity();
}

template LatticeShares lattice_shares<1>(const input::SphOptions &);
template LatticeShares lattice_shares<2>(const input::SphOptions &);
template LatticeShares lattice_shares<3>(const input::SphOptions &);
} // namespace ogive::sph
