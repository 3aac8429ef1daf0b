// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/parameters.h"
#include "core/materials/strength/flow.h"

namespace ogive::materials
{
/// Hypoelastic without yield.
struct Elastic
{
  static constexpr const char *name   = "elastic";
  static constexpr bool        solid  = true;
  static constexpr bool        yields = false;

  static Elastic from(const Parameters &) { return {}; }
};
} // namespace ogive::materials
