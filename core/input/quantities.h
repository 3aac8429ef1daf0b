// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/units.h"

#include <span>
#include <string>
#include <vector>

namespace ogive::input
{
/// What an observer may measure, as far as the reader must know it.
struct ObservedQuantity
{
  const char      *name;
  units::Dimension dimension;          ///< of its value and its reference
  bool             needs_body;
  bool             needs_parameter;
  units::Dimension parameter;          ///< dimension of its parameter
  const char      *meaning;
};

std::span<const ObservedQuantity> observed_quantities();

/// Null for an unknown name.
const ObservedQuantity *find_quantity(const std::string &name);

std::vector<std::string> quantity_names();

/// SI unit as in the summary: "1" for a pure number.
std::string summary_unit(units::Dimension);
} // namespace ogive::input
