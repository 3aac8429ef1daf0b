// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/quantities.h"

#include <array>

namespace ogive::input
{
namespace
{
constexpr std::array quantities{
  ObservedQuantity{"final_length", units::length, true, false, units::none, "extent of the body along the direction"},
  ObservedQuantity{"foot_radius", units::length, true, false, units::none,
                   "greatest distance from the axis in the lowest tenth of the body, mean over 32 sectors about it"},
  ObservedQuantity{"displacement", units::length, true, false, units::none,
                   "how far the centre of mass has moved along the direction"},
  ObservedQuantity{"residual_velocity", units::velocity, true, false, units::none,
                   "velocity of the centre of mass along the direction at the end"},
  ObservedQuantity{"rebound_velocity", units::velocity, false, false, units::none,
                   "velocity of the centre of mass along the direction at the end, of all bodies if none is named"},
  ObservedQuantity{"perforated", units::none, true, true, units::velocity,
                   "1 once the foremost point of the body has passed the point and the body still moves faster than "
                   "the parameter, else 0"},
  ObservedQuantity{"contact_time", units::time, false, false, units::none,
                   "from the first to the last force of walls and contacts"},
  ObservedQuantity{"plastic_shock_speed", units::velocity, true, true, units::pressure,
                   "speed of the foremost place where the axial pressure is the parameter, from the point"},
  ObservedQuantity{"precursor_speed", units::velocity, true, true, units::pressure,
                   "as plastic_shock_speed, with the parameter inside the precursor"},
  ObservedQuantity{"plateau_stress", units::pressure, true, true, units::pressure,
                   "median axial pressure behind the front, which lies where the pressure is the parameter"},
  ObservedQuantity{"gauge_displacement", units::length, true, false, units::none,
                   "displacement along the direction of what was nearest to the point"},
  ObservedQuantity{"gauge_velocity", units::velocity, true, false, units::none,
                   "velocity along the direction of what was nearest to the point"},
  ObservedQuantity{"gauge_stress", units::pressure, true, false, units::none,
                   "stress along the direction, tension positive, of what was nearest to the point"},
  ObservedQuantity{"angular_momentum_drift", units::none, false, false, units::none,
                   "relative change of the angular momentum of all bodies about the origin"},
  ObservedQuantity{"energy_kept", units::none, false, false, units::none,
                   "kinetic plus elastic energy over their sum at the start"},
  ObservedQuantity{"peak_stress", units::pressure, true, false, units::none, "greatest von Mises stress in the body"},
  ObservedQuantity{"period", units::time, true, false, units::none,
                   "mean period, over the whole ones seen, of the displacement along the direction of what was nearest "
                   "to the point"},
  ObservedQuantity{"amplitude_loss", units::none, true, false, units::none,
                   "1 - greatest displacement in the last whole period over that in the first; place as for period"},
  ObservedQuantity{"tip_deflection", units::length, true, false, units::none,
                   "displacement along the direction of what was nearest to the point, mean over the second half of the "
                   "time since it was greatest"},
  ObservedQuantity{"mid_deflection", units::none, true, true, units::length, "as tip_deflection, over the parameter"},
  ObservedQuantity{"greatest_deflection", units::length, true, false, units::none,
                   "greatest displacement along the direction of what was nearest to the point"},
  ObservedQuantity{"tip_rotation", units::none, true, true, units::length,
                   "turn in radians, about the direction or in the plane, of what began closer to the point than the "
                   "parameter; settled as tip_deflection"},
  ObservedQuantity{"twist", units::none, true, true, units::length,
                   "turn in radians, as tip_rotation but at the end, with its sign and over whole turns"},
  ObservedQuantity{"cavity_error", units::none, true, true, units::length,
                   "root mean square distance of the displacement from Blake's exact one, over it, of the nodes that began "
                   "closer to the centre than the parameter; needs an elastic shell with a pressure inside"},
  ObservedQuantity{"stopping_radius", units::length, true, false, units::none,
                   "least mean radius of the inner wall of a shell or ring"},
  ObservedQuantity{"stopping_time", units::time, true, false, units::none,
                   "when the mean radius of the inner wall was least"},
  ObservedQuantity{"roundness", units::none, true, false, units::none,
                   "greatest over least mean radius of the inner wall in the directions of a lattice, when the mean of "
                   "all was least"},
  ObservedQuantity{"width_at", units::length, true, true, units::length,
                   "diameter at the parameter above the lowest point along the direction"},
  ObservedQuantity{"fragments", units::none, true, false, units::none,
                   "number of pieces of the body; particles closer than 1.75 spacings hang together"},
  ObservedQuantity{"smallest_distance", units::none, true, false, units::none,
                   "least distance of two particles over their spacing, or of two nodes of an element over that at the start, "
                   "so far"},
  ObservedQuantity{"symmetry_error", units::length, false, false, units::none,
                   "greatest distance between a point and the mirror image of its partner, in the plane through the "
                   "point across the direction"},
  ObservedQuantity{"kinetic_share", units::none, false, false, units::none,
                   "kinetic energy over the kinetic and elastic energy at the start"},
  ObservedQuantity{"elastic_share", units::none, false, false, units::none,
                   "elastic energy over the kinetic and elastic energy at the start"},
  ObservedQuantity{"plastic_share", units::none, false, false, units::none,
                   "plastic work over the kinetic and elastic energy at the start"},
  ObservedQuantity{"greatest_damage", units::none, true, false, units::none, "greatest damage in the body"},
  ObservedQuantity{"overshoot", units::none, true, false, units::none,
                   "greatest axial pressure over the exact plateau of closing halves, less 1: worst since the exact "
                   "front was a third through; needs velocity field closing and a fluid"},
  ObservedQuantity{"l1_error", units::none, true, false, units::none,
                   "mean distance of the axial pressure from the exact profile over the profile's mean; needs velocity "
                   "field closing and a fluid, or an ideal gas with a step plane"},
  ObservedQuantity{"l1_density_error", units::none, true, false, units::none, "as l1_error, of the density"},
  ObservedQuantity{"l1_velocity_error", units::none, true, false, units::none,
                   "as l1_error, of the velocity along x, weighed by mass"},
  ObservedQuantity{"shock_speed", units::velocity, true, true, units::pressure,
                   "distance from the point that holds as much mass as has an axial pressure above the parameter, over "
                   "time"},
  ObservedQuantity{"density_deficit", units::none, true, true, units::density,
                   "what the density about the point lacks of the parameter, as a share of it"},
  ObservedQuantity{"fundamental_energy", units::none, true, false, units::none,
                   "share of the energy of the starting wave that is still in it, kinetic and elastic; needs velocity "
                   "field standing-wave"},
  ObservedQuantity{"wave_amplitude_loss", units::none, true, false, units::none,
                   "share of its amplitude that the starting wave loses in a wavelength of travel; needs velocity "
                   "field standing-wave"},
  ObservedQuantity{"oscillation_noise", units::none, true, false, units::none,
                   "kinetic energy of waves shorter than four spacings over all kinetic energy at the start; needs "
                   "particles in a uniaxial scene"},
  ObservedQuantity{"kinetic_energy_kept", units::none, false, false, units::none,
                   "kinetic energy of all bodies over that at the start"},
  ObservedQuantity{"viscosity_heat_share", units::none, false, false, units::none,
                   "heat of the artificial viscosity of particles over the kinetic energy at the start"},
  ObservedQuantity{"viscosity_to_plastic_work", units::none, false, false, units::none,
                   "heat of the artificial viscosity of particles over the plastic work"},
  ObservedQuantity{"patch_error", units::none, true, true, units::length,
                   "root mean square distance of the stress from the exact uniform one, over it, of what began farther "
                   "than the parameter from every face; needs velocity field stretch and a linear elastic box"},
  ObservedQuantity{"fracture_strain", units::none, true, true, units::length,
                   "growth along the direction over the parameter, the gauge length, when the mean stress along it first "
                   "falls below a tenth of the greatest so far"},
  ObservedQuantity{"crater_diameter", units::length, true, true, units::velocity,
                   "diameter about the line through the point of the hole in what is slower than the parameter, within "
                   "the body's first thickness along the direction"},
  ObservedQuantity{"cloud_shape", units::none, true, true, units::velocity,
                   "length over width of what has passed the point along the direction faster than the parameter"},
};
} // namespace

std::span<const ObservedQuantity> observed_quantities()
{
  return quantities;
}

const ObservedQuantity *find_quantity(const std::string &name)
{
  for (const ObservedQuantity &q : quantities)
    if (name == q.name)
      return &q;
  return nullptr;
}

std::vector<std::string> quantity_names()
{
  std::vector<std::string> names;
  for (const ObservedQuantity &q : quantities)
    names.emplace_back(q.name);
  return names;
}

std::string summary_unit(units::Dimension d)
{
  return d == units::none ? "1" : units::si_unit(d);
}
} // namespace ogive::input
