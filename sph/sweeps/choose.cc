// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/kernels/kernels.h"
#include "sph/sweep.h"

namespace ogive::sph
{
namespace detail
{
// One file of this folder a kernel instantiates it.
template <int dim, class Kernel>
SweepFunctions sweeps_of(const SweepChoice &);
} // namespace detail

template <int dim>
SweepFunctions choose_sweeps(const SweepChoice &c)
{
  return with_kernel(c.kernel, [&](auto k) { return detail::sweeps_of<dim, decltype(k)>(c); });
}

template SweepFunctions choose_sweeps<1>(const SweepChoice &);
template SweepFunctions choose_sweeps<2>(const SweepChoice &);
template SweepFunctions choose_sweeps<3>(const SweepChoice &);
} // namespace ogive::sph
