// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/parameters.h"

namespace ogive::materials
{
/// What stands behind a plane shock that runs into the undeformed material.
struct Shock
{
  double density;  ///< kg/m^3
  double pressure; ///< Pa
  double speed;    ///< of the front, seen from the material ahead, m/s
};

/// The shock that gives a material without strength the velocity u > 0 (m/s):
/// the state of its own equation of state with e = u^2/2 and
///   p (1/rho0 - 1/rho) = u^2   (Rankine and Hugoniot, nothing ahead),
/// found by bisection to rounding; a Mie-Grueneisen law obeys it once more, and
/// without meaning, at rho/rho0 = 1 + 2/Gamma, so only shocks below that are
/// found. InputError for a material that carries shear or has no such state.
Shock hugoniot(const Parameters &, double particle_velocity);

/// Pressure without any heat, Pa.
double cold_pressure(const Parameters &, double density);

/// Specific energy, J/kg, at which the equation of state has this pressure.
/// InputError (without a place) where pressure does not hang on energy, unless it
/// is that without heat.
double energy_at(const Parameters &, double density, double pressure);

/// (dp/drho)_s at this density and energy, m^2/s^2.
double sound_speed_squared(const Parameters &, double density, double energy);
} // namespace ogive::materials
