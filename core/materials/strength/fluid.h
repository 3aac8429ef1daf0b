// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/parameters.h"
#include "core/materials/strength/flow.h"

namespace ogive::materials
{
/// No resistance to shear.
struct Fluid
{
  static constexpr const char *name   = "fluid";
  static constexpr bool        solid  = false;
  static constexpr bool        yields = false;

  static Fluid from(const Parameters &) { return {}; }
};
} // namespace ogive::materials
