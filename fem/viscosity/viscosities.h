// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/input/scene.h"
#include "fem/viscosity/kuropatenko.h"
#include "fem/viscosity/neumann_richtmyer.h"
#include "fem/viscosity/none.h"

#include <string>
#include <variant>
#include <vector>

/// The bulk viscosities of elements: a new one is a new file, one line here and
/// its name among the choices of core/input/fields_options.cc. The conformance
/// tests run over all of this list.
namespace ogive::fem
{
using AnyBulkViscosity = std::variant<NeumannRichtmyer, Kuropatenko, NoBulkViscosity>;

template <std::size_t k = 0>
AnyBulkViscosity bulk_viscosity(const input::FemOptions &options)
{
  if constexpr (k < std::variant_size_v<AnyBulkViscosity>)
  {
    using Law = std::variant_alternative_t<k, AnyBulkViscosity>;
    if (options.bulk_viscosity == Law::name)
      return Law{options.bulk_quadratic, options.bulk_linear};
    return bulk_viscosity<k + 1>(options);
  }
  throw InputError("there is no bulk viscosity \"" + options.bulk_viscosity + "\"");
}

template <class T>
BulkViscosity<T> evaluate(const AnyBulkViscosity &law, const T &density, const T &sound_speed, const T &length,
                          const T &compression)
{
  return std::visit([&](const auto &l) { return l(density, sound_speed, length, compression); }, law);
}

/// The damping that goes with a pressure given before, Pa s.
template <class T>
T damping_of(const AnyBulkViscosity &law, const T &density, const T &sound_speed, const T &length, const T &pressure)
{
  return std::visit([&](const auto &l) { return l.damping(density, sound_speed, length, pressure); }, law);
}
} // namespace ogive::fem
