// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/damage/johnson_cook.h"
#include "core/materials/damage/none.h"
#include "core/materials/damage/plastic_strain.h"
#include "core/materials/damage/tension.h"
#include "core/materials/eos/ideal_gas.h"
#include "core/materials/eos/linear.h"
#include "core/materials/eos/mie_grueneisen.h"
#include "core/materials/strength/elastic.h"
#include "core/materials/strength/fluid.h"
#include "core/materials/strength/johnson_cook.h"
#include "core/materials/strength/linear_hardening.h"
#include "core/materials/strength/perfect_plastic.h"

#include <string>
#include <variant>
#include <vector>

/// The laws that a material may be composed of: a new one is a new file and one
/// line here. The conformance tests run over every combination of these lists.
namespace ogive::materials
{
using AnyEos = std::variant<LinearEos,
                            MieGrueneisen,
                            IdealGas>;

using AnyStrength = std::variant<Fluid,
                                 Elastic,
                                 PerfectPlastic,
                                 LinearHardening,
                                 JohnsonCook>;

using AnyDamage = std::variant<NoDamage,
                               JohnsonCookDamage,
                               PlasticStrainDamage,
                               TensionDamage>;

template <class Variant>
struct Laws;

template <class... Law>
struct Laws<std::variant<Law...>>
{
  static std::vector<std::string> names() { return {Law::name...}; }

  /// The law of that name; an InputError at `entry` if there is none.
  static std::variant<Law...> build(const std::string &name, const Parameters &p, const char *entry)
  {
    std::variant<Law...> law;
    const bool found = ((name == Law::name && (law = Law::from(p), true)) || ...);
    if (!found)
      {
        std::string list;
        for (const std::string &known : names())
          list += (list.empty() ? "" : ", ") + known;
        reject(entry, name.empty() ? "is missing" : "there is no law \"" + name + "\"", "one of " + list);
      }
    return law;
  }
};

/// Names of the registered laws, in the order of a manual.
inline std::vector<std::string> eos_laws() { return Laws<AnyEos>::names(); }
inline std::vector<std::string> strength_laws() { return Laws<AnyStrength>::names(); }
inline std::vector<std::string> damage_laws() { return Laws<AnyDamage>::names(); }
} // namespace ogive::materials
