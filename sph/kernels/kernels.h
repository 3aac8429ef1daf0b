// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "sph/kernels/cubic.h"
#include "sph/kernels/quintic.h"
#include "sph/kernels/wendland_c2.h"
#include "sph/kernels/wendland_c4.h"

#include <string>
#include <tuple>
#include <utility>

namespace ogive::sph
{
/// Every kernel: one file and one entry here.
using Kernels = std::tuple<CubicSpline, QuinticSpline, WendlandC2, WendlandC4>;

/// Calls f(Kernel{}) with the kernel of that name; InputError if there is none.
template <class F>
decltype(auto) with_kernel(const std::string &name, F &&f)
{
  if (name == CubicSpline::name)
    return f(CubicSpline{});
  if (name == QuinticSpline::name)
    return f(QuinticSpline{});
  if (name == WendlandC2::name)
    return f(WendlandC2{});
  if (name == WendlandC4::name)
    return f(WendlandC4{});
  throw InputError({"", 0, "SPH/kernel"}, "unknown kernel \"" + name + "\"",
                   "cubic, quintic, wendland-c2 or wendland-c4");
}

/// A kernel at one smoothing length: constants folded, for whole registers.
template <class Kernel, int dim>
struct KernelAt
{
  double inv_h, value_scale, slope_scale, tiny;

  explicit KernelAt(double h)
    : inv_h(1 / h)
    , value_scale(Kernel::template norm<dim>())
  {
    for (int d = 0; d < dim; ++d)
      value_scale /= h;
    slope_scale = value_scale / (h * h);
    tiny        = 1e-24 * h * h;
  }

  /// 1/r that stays finite where two particles coincide.
  template <class T>
  T inverse_distance(const T &r2) const
  {
    return reciprocal_root(T(r2 + tiny));
  }
  template <class T>
  T value(const T &r) const
  {
    return value_scale * Kernel::template value<dim>(T(r * inv_h));
  }
  /// g with gradW = x_ij g.
  template <class T>
  T slope(const T &r, const T &inv_r) const
  {
    return slope_scale * Kernel::template slope_over_q<dim>(T(r * inv_h), T(inv_r * (1 / inv_h)));
  }
};
} // namespace ogive::sph
