// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/damage/loading.h"
#include "core/materials/entry.h"
#include "core/materials/parameters.h"

namespace ogive::materials
{
/// Spall: fails at once when the mean stress reaches a limit.
struct TensionDamage
{
  static constexpr const char *name    = "tension";
  static constexpr bool        damages = true;

  double failure_tension; ///< Pa

  static TensionDamage from(const Parameters &p)
  {
    return {positive(p.damage.failure_tension, "Damage/failure tension", "damage law \"tension\"")};
  }

  /// Damage at the end of the step.
  double after(const Loading &l) const { return l.mean_stress >= failure_tension ? 1 : l.damage; }
};
} // namespace ogive::materials
