// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/eos/response.h"
#include "core/materials/parameters.h"

namespace ogive::materials
{
/// Mie-Grueneisen about the Hugoniot U_s = c0 + s u_p with constant Gamma:
///   p = p_H + Gamma rho (e - e_H),  eta = 1 - rho0/rho,
///   p_H = rho0 c0^2 eta/(1 - s eta)^2,  e_H = p_H eta/(2 rho0).
/// The factor is Gamma rho and not Gamma0 rho0 (Udaykumar et al., J. Comput.
/// Phys. 186 (2003) 136).
///
/// Tension (eta < 0) is the same with s = 0. That curve, p = rho0 c0^2 eta and
/// e = c0^2 eta^2/2, obeys de = p drho/rho^2: it is the isentrope through the
/// undeformed state, joins the compression branch with the same slope, and
/// c^2 = (c0 rho0/rho)^2 + Gamma (1 + Gamma)(e - e_H) stays real for every
/// state at or above it.
///
/// Outside its domain (1 - s eta <= 0) it returns a negative c^2.
struct MieGrueneisen
{
  static constexpr const char *name = "mie-grueneisen";

  double rho0;  ///< kg/m^3
  double c0;    ///< m/s
  double s;
  double gamma;

  static MieGrueneisen from(const Parameters &p)
  {
    const char *why = "EOS law \"mie-grueneisen\"";
    return {p.density,
            positive(p.eos.bulk_sound_speed, "EOS/bulk sound speed", why),
            not_negative(p.eos.slope, "EOS/slope", why),
            not_negative(p.eos.gamma, "EOS/gamma", why)};
  }

  template <class T>
  EosResponse<T> at(T density, T energy) const
  {
    const T v     = T(1) / density;
    const T eta   = (density - T(rho0)) * v; // exactly zero at rest
    const T slope = select(eta > T(0), T(s), T(0));
    const T gap   = T(1) - slope * eta;
    const T k     = T(rho0 * c0 * c0) / (gap * gap);
    const T p_h   = k * eta;
    const T e_h   = p_h * eta * T(.5 / rho0);

    const T d_eta = T(rho0) * v * v;
    const T d_p_h = k * (T(1) + slope * eta) / gap * d_eta;
    const T d_e_h = (d_p_h * eta + p_h * d_eta) * T(.5 / rho0);

    const T g   = T(gamma) * density;
    const T p   = p_h + g * (energy - e_h);
    const T c_2 = d_p_h + T(gamma) * (energy - e_h) - g * d_e_h + T(gamma) * p * v;
    return {p, select(gap > T(0), c_2, T(-1))};
  }
};
} // namespace ogive::materials
