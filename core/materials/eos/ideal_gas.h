// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/eos/response.h"
#include "core/materials/parameters.h"

namespace ogive::materials
{
/// p = (gamma - 1) rho e, so c^2 = gamma (gamma - 1) e. The undeformed state has
/// no energy and hence no pressure: whoever owns the energy sets it.
struct IdealGas
{
  static constexpr const char *name = "ideal-gas";

  double gamma; ///< adiabatic exponent, > 1

  static IdealGas from(const Parameters &p)
  {
    const double gamma = given(p.eos.gamma, "EOS/gamma", "EOS law \"ideal-gas\"");
    if (gamma <= 1)
      reject("EOS/gamma", "is " + std::to_string(gamma), "a value > 1");
    return {gamma};
  }

  template <class T>
  EosResponse<T> at(T density, T energy) const
  {
    return {T(gamma - 1) * density * energy, T(gamma * (gamma - 1)) * energy};
  }
};
} // namespace ogive::materials
