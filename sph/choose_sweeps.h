// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/correction/pairwise.h"
#include "sph/energy.h"
#include "sph/force.h"
#include "sph/gradient.h"

/// Instantiates the sweeps; included once a dimension.
namespace ogive::sph
{
namespace detail
{
template <int dim, class Kernel, bool standard, bool correction, bool damage>
SweepFunctions sweeps()
{
  return {&gradient_sweep<dim, Kernel, standard>, &force_sweep<dim, Kernel, standard, correction, damage>,
          correction ? &correction_sweep<dim, Kernel> : nullptr, &energy_sweep<dim, Kernel, correction>};
}

template <int dim, class Kernel>
SweepFunctions sweeps_of(const SweepChoice &c)
{
  static constexpr SweepFunctions (*table[8])() = {
    &sweeps<dim, Kernel, false, false, false>, &sweeps<dim, Kernel, false, false, true>,
    &sweeps<dim, Kernel, false, true, false>,  &sweeps<dim, Kernel, false, true, true>,
    &sweeps<dim, Kernel, true, false, false>,  &sweeps<dim, Kernel, true, false, true>,
    &sweeps<dim, Kernel, true, true, false>,   &sweeps<dim, Kernel, true, true, true>};
  return table[4 * c.standard + 2 * c.correction + c.damage]();
}
} // namespace detail

template <int dim>
SweepFunctions choose_sweeps(const SweepChoice &c, const std::string &kernel)
{
  return with_kernel(kernel, [&](auto k) { return detail::sweeps_of<dim, decltype(k)>(c); });
}
} // namespace ogive::sph
