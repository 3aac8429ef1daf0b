// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "sph/viscosity/hernquist_katz.h"
#include "sph/viscosity/monaghan.h"
#include "sph/viscosity/owen.h"

#include <string>
#include <tuple>

namespace ogive::sph
{
/// Every viscosity: one file and one entry here.
template <int dim>
using Viscosities = std::tuple<Monaghan<dim>, HernquistKatz<dim>, Owen<dim>>;

/// Calls f(Viscosity{}) with the one of that name; InputError if there is none.
template <int dim, class F, std::size_t k = 0>
decltype(auto) with_viscosity(const std::string &name, F &&f)
{
  using Law = std::tuple_element_t<k, Viscosities<dim>>;
  if (name == Law::name)
    return f(Law{});
  if constexpr (k + 1 < std::tuple_size_v<Viscosities<dim>>)
    return with_viscosity<dim, F, k + 1>(name, std::forward<F>(f));
  else
    throw InputError({"", 0, "SPH/viscosity"}, "unknown viscosity \"" + name + "\"",
                     "monaghan, hernquist-katz or owen");
}
} // namespace ogive::sph
