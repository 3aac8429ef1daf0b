// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ogive::materials
{
/// The numbers of one material, SI, before any law is built. `none` marks a
/// number that the chosen laws do not need; building a law that needs it is an
/// InputError.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct EosParameters
{
  std::string law;                 ///< "linear", "mie-grueneisen", "ideal-gas"
  double bulk_modulus     = none;  ///< linear; by default from the elastic constants, Pa
  double bulk_sound_speed = none;  ///< mie-grueneisen c0, m/s
  double slope            = none;  ///< mie-grueneisen s
  double gamma            = none;  ///< Grueneisen parameter, or the adiabatic exponent of a gas
  double tension_cutoff   = none;  ///< greatest tensile mean stress, Pa, > 0; none: no cutoff
};

struct StrengthParameters
{
  std::string law;                  ///< "fluid", "elastic", "perfect-plastic", "linear-hardening", "johnson-cook"
  double yield_stress      = none;  ///< Y or A, Pa
  double hardening_modulus = none;  ///< linear-hardening: d(yield)/d(eps_p), Pa
  double hardening         = none;  ///< B, Pa
  double exponent          = none;  ///< n
  double rate_coefficient  = none;  ///< C
  double thermal_exponent  = none;  ///< m
  double reference_rate    = none;  ///< 1/s
};

struct DamageParameters
{
  std::string law = "none";         ///< "none", "johnson-cook", "plastic-strain", "tension"
  double d1 = none, d2 = none, d3 = none, d4 = none, d5 = none;
  double critical          = none;  ///< damage at which a point has failed, 0 < . <= 1
  double reference_rate    = none;  ///< 1/s
  double failure_strain    = none;  ///< plastic-strain
  double failure_tension   = none;  ///< tension: mean stress, Pa
};

struct ThermalParameters
{
  double specific_heat         = none; ///< J/(kg K)
  double reference_temperature = none; ///< K, also the initial one
  double melt_temperature      = none; ///< K
  double taylor_quinney        = none; ///< share of plastic work that heats

  double heated_share() const { return std::isnan(taylor_quinney) ? 0. : taylor_quinney; }
};

/// One sentence on where one entry comes from.
struct Source
{
  std::string entry; ///< as in the file, e.g. "Strength/yield stress"
  std::string kind;  ///< "exact", "test", "code", "handbook", "memory" (quoted second-hand)
  std::string text;
};

struct Range
{
  std::string what; ///< "strain rate", "temperature", "pressure", "plastic strain"
  double      low = none, high = none;
};

struct Parameters
{
  std::string name, title;
  double      density        = none; ///< kg/m^3
  double      shear_modulus  = none; ///< Pa
  double      young_modulus  = none; ///< Pa, as given (for the reader)
  double      poisson_ratio  = none;
  EosParameters       eos;
  StrengthParameters  strength;
  DamageParameters    damage;
  ThermalParameters   thermal;
  std::vector<Source> sources;
  std::vector<Range>  ranges;
};
} // namespace ogive::materials
