// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/reference/sweeps.h"
#include "sph/viscosity/viscosities.h"
#include "sph/viscosity/viscous_sweep.h"

namespace ogive::sph
{
template <int dim>
void choose_reference(const SweepChoice &c, SweepFunctions &f)
{
  f.reference_gradient = &reference_gradient_sweep<dim>;
  f.force              = &reference_force_sweep<dim>;
  f.energy             = &reference_energy_sweep<dim>;
  with_viscosity<dim>(c.viscosity, [&](auto v) {
    using Viscosity = decltype(v);
    f.viscous       = c.limited ? &viscous_sweep<dim, KeptSlope, Viscosity, true> :
                                  &viscous_sweep<dim, KeptSlope, Viscosity, false>;
    if (c.direct)
      f.viscous_power = [](const Sweep &s) {
        pair_power_sweep<dim, Viscosity::central>(s, s.pair_viscosity, Layout<dim>::viscous_power);
      };
  });
}

template void choose_reference<1>(const SweepChoice &, SweepFunctions &);
template void choose_reference<2>(const SweepChoice &, SweepFunctions &);
template void choose_reference<3>(const SweepChoice &, SweepFunctions &);
} // namespace ogive::sph
