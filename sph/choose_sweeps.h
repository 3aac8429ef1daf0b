// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/artificial_stress.h"
#include "sph/correction/correction_sweep.h"
#include "sph/correction/sensor.h"
#include "sph/density.h"
#include "sph/energy.h"
#include "sph/force.h"
#include "sph/gradient.h"
#include "sph/half/energy.h"
#include "sph/half/forces.h"
#include "sph/reference/layout.h"
#include "sph/viscosity/viscosities.h"
#include "sph/viscosity/viscous_sweep.h"

/// Instantiates the sweeps; included once a dimension and kernel.
namespace ogive::sph
{
namespace detail
{
template <int dim, class Kernel>
void choose_form(const SweepChoice &c, SweepFunctions &f)
{
  f.gradient = c.standard ? &gradient_sweep<dim, Kernel, true> : &gradient_sweep<dim, Kernel, false>;
  f.density  = c.standard ? &density_sweep<dim, Kernel, true> : &density_sweep<dim, Kernel, false>;
  f.sensor   = &sensor_sweep<dim, Kernel>;
  if (c.standard)
    f.force = c.damage ? &force_sweep<dim, Kernel, true, true> : &force_sweep<dim, Kernel, true, false>;
  else
    f.force = c.damage ? &force_sweep<dim, Kernel, false, true> : &force_sweep<dim, Kernel, false, false>;
  f.artificial_stress       = &artificial_stress_sweep<dim, Kernel, false>;
  f.artificial_stress_power = &artificial_stress_sweep<dim, Kernel, true>;
}

template <int dim, class Kernel>
void choose_correction(const SweepChoice &c, SweepFunctions &f)
{
  f.mean = &mean_sweep<dim, Kernel>;
  if (c.correction == "shepard")
    f.correction = c.variable ? &correction_sweep<dim, Kernel, true, true> : &correction_sweep<dim, Kernel, true, false>;
  else if (c.correction == "pairwise")
    f.correction =
      c.variable ? &correction_sweep<dim, Kernel, false, true> : &correction_sweep<dim, Kernel, false, false>;
  else if (c.correction != "none")
    throw InputError({"", 0, "SPH/correction"}, "unknown correction \"" + c.correction + "\"",
                     "none, pairwise or shepard");
  if (c.correction == "pairwise" && (c.variable || c.reference))
    f.correction_power =
      c.variable ? &correction_power_sweep<dim, Kernel, true> : &correction_power_sweep<dim, Kernel, false>;
}

template <int dim, class Kernel, class Viscosity>
void choose_viscosity(const SweepChoice &c, SweepFunctions &f)
{
  constexpr bool central = Viscosity::central;
  const bool     fixed   = c.correction == "pairwise" && !c.variable;
  f.viscous = c.limited ? &viscous_sweep<dim, Kernel, Viscosity, true> : &viscous_sweep<dim, Kernel, Viscosity, false>;
  if (central && c.direct)
    f.energy = fixed ? &energy_sweep<dim, Kernel, true, true> : &energy_sweep<dim, Kernel, true, false>;
  else
    f.energy = fixed ? &energy_sweep<dim, Kernel, false, true> : &energy_sweep<dim, Kernel, false, false>;
  if (!central && c.direct)
    f.viscous_power = [](const Sweep &s) {
      pair_power_sweep<dim, central>(s, s.pair_viscosity, Layout<dim>::viscous_power);
    };
  if (c.correction == "shepard")
    f.weak_power = [](const Sweep &s) {
      pair_power_sweep<dim, central>(s, s.pair_weak, Layout<dim>::viscous_power);
    };
}

template <int dim, class Kernel, bool limited, bool damage>
void choose_joint_forces(SweepFunctions &f)
{
  f.joint_force = &joint_force_sweep<dim, Kernel, limited, damage, false>;
  f.half_force  = &joint_force_sweep<dim, Kernel, limited, damage, true>;
}

/// In space alone: elsewhere neighbours are few.
template <int dim, class Kernel>
void choose_joint(const SweepChoice &c, SweepFunctions &f)
{
  if constexpr (dim == 3)
  {
    if (c.limited)
      c.damage ? choose_joint_forces<dim, Kernel, true, true>(f) : choose_joint_forces<dim, Kernel, true, false>(f);
    else
      c.damage ? choose_joint_forces<dim, Kernel, false, true>(f) : choose_joint_forces<dim, Kernel, false, false>(f);
    f.half_energy = &half_energy_sweep<dim, Kernel>;
  }
}

template <int dim, class Kernel>
SweepFunctions sweeps_of(const SweepChoice &c)
{
  SweepFunctions f;
  choose_form<dim, Kernel>(c, f);
  choose_correction<dim, Kernel>(c, f);
  with_viscosity<dim>(c.viscosity, [&](auto v) { choose_viscosity<dim, Kernel, decltype(v)>(c, f); });
  if (c.reference)
    choose_reference<dim>(c, f);
  if (c.joint)
    choose_joint<dim, Kernel>(c, f);
  return f;
}
} // namespace detail
} // namespace ogive::sph
