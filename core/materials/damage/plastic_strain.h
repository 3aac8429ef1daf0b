// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/damage/loading.h"
#include "core/materials/entry.h"
#include "core/materials/parameters.h"

namespace ogive::materials
{
/// Fails at once at a plastic strain, without softening before.
struct PlasticStrainDamage
{
  static constexpr const char *name    = "plastic-strain";
  static constexpr bool        damages = true;

  double failure_strain;

  static PlasticStrainDamage from(const Parameters &p)
  {
    return {positive(p.damage.failure_strain, "Damage/failure strain",
                     "damage law \"plastic-strain\"")};
  }

  /// Damage at the end of the step.
  double after(const Loading &l) const { return l.plastic_strain >= failure_strain ? 1 : l.damage; }
};
} // namespace ogive::materials
