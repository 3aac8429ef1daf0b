// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/fields.h"
#include "core/input/scene.h"

/// The entries of a scene, subject by subject. See fields.h.
namespace ogive::input
{
void body_fields(Fields &, Body &, Dimension);
void wall_fields(Fields &, RigidWall &);
void boundary_fields(Fields &, Boundary &);
void interface_fields(Fields &, Interface &);
void contact_fields(Fields &, Contact &);
void observer_fields(Fields &, Observer &);
void option_fields(Fields &, Scene &); ///< SPH, FEM, Stop, Limits, Output

/// Entries of a material, in a file of the library or in Materials/NAME.
void material_fields(Fields &, materials::Parameters &);

/// Everything. The scene's lists must hold as many named items as there will be
/// subsections; `inline_materials` of scene.materials, the first ones, are its own.
void scene_fields(Fields &, Scene &, std::size_t inline_materials);
} // namespace ogive::input
