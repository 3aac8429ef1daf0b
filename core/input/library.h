// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/declarations.h"
#include "core/materials/parameters.h"

#include <string>

namespace ogive::input
{
/// Fills the elastic constants that follow from others (shear modulus, and the
/// bulk modulus of the linear equation of state) and builds the material once,
/// so that what its laws miss is reported here: InputError with file and line.
/// @param section where the material stands in the listing, empty for a file of
///   its own.
void complete_material(materials::Parameters &, const Listing &, const std::string &section);

/// Throws the error again with the file and line of its entry, which it names
/// as "Strength/yield stress" within `section`.
[[noreturn]] void rethrow_at(const Listing &, const std::string &section, const InputError &);
} // namespace ogive::input
