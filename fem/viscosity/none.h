// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/viscosity/neumann_richtmyer.h"

namespace ogive::fem
{
/// No bulk viscosity: for motions without shocks, and to see what the others do.
struct NoBulkViscosity
{
  static constexpr const char *name = "none";

  double quadratic = 0, linear = 0; ///< not read

  template <class T>
  BulkViscosity<T> operator()(const T &, const T &, const T &, const T &) const
  {
    return {T(0.), T(0.)};
  }
  template <class T>
  T damping(const T &, const T &, const T &, const T &) const
  {
    return T(0.);
  }
};
} // namespace ogive::fem
