// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/implementation.h"

namespace ogive::sph
{
/// One copy of all that a step changes and that does not follow from the rest.
template <int dim>
struct Solver<dim>::Implementation::State
{
  Store<dim>                store;
  AlignedVector<double>     deformation;
  std::vector<std::int64_t> near_surface;
  Works                     works;
  double                    time = 0, time_listed = 0;
  std::vector<double>       wall_forces;
  std::uint64_t             updates  = 0;
  std::uint64_t             topology = 0;
  std::uint64_t             rebuilds = 0;
  std::vector<std::int64_t> pieces{};
  std::vector<Body>         bodies{}; ///< their ranges
  Territory<dim>            territory{};
  std::size_t               cut_at = 0;
  std::uint64_t             steps  = 0;
};
} // namespace ogive::sph
