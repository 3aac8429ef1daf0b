// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/damage/loading.h"
#include "core/materials/parameters.h"

namespace ogive::materials
{
/// The material does not fail.
struct NoDamage
{
  static constexpr const char *name    = "none";
  static constexpr bool        damages = false;

  static NoDamage from(const Parameters &) { return {}; }
  double          after(const Loading &l) const { return l.damage; }
};
} // namespace ogive::materials
