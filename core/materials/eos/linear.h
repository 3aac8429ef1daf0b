// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/elastic_constants.h"
#include "core/materials/eos/response.h"

namespace ogive::materials
{
/// p = K (rho/rho0 - 1), independent of energy, so c^2 = K/rho0.
struct LinearEos
{
  static constexpr const char *name = "linear";

  double bulk_modulus;    ///< Pa
  double inverse_density; ///< of the undeformed state, m^3/kg
  double rest;            ///< kg/m^3

  static LinearEos from(const Parameters &p)
  {
    return {given(ElasticConstants::of(p).bulk, "EOS/bulk modulus",
                  "EOS law \"linear\" (or a young modulus and poisson ratio)"),
            1 / p.density, p.density};
  }

  template <class T>
  EosResponse<T> at(T density, T) const
  {
    return {T(bulk_modulus) * ((density - T(rest)) * T(inverse_density)),
            T(bulk_modulus * inverse_density)};
  }
};
} // namespace ogive::materials
