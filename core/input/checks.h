// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/declarations.h"
#include "core/input/scene.h"

/// What a scene must satisfy beyond entries that are right one by one. Each
/// throws InputError at the entry that is at fault.
namespace ogive::input
{
/// Vectors have as many components as the dimension, or three with the rest zero.
void check_vectors(const Declarations &, const Listing &, Dimension);

/// Every listed name has its subsection.
void check_lists(const Scene &, const Listing &);

/// Bodies named by boundaries, interfaces, contacts, observers and the stop rule
/// exist and suit their part.
void check_names(const Scene &, const Listing &);

/// Shapes suit the dimension, are not empty, do not overlap, and lie on the
/// right side of symmetry planes and walls.
void check_geometry(const Scene &, const Listing &);

/// Something moves, where it may move, and towards something.
void check_motion(const Scene &, const Listing &);

/// Velocity fields of waves and states at the start suit the body.
void check_start(const Scene &, const Listing &);
} // namespace ogive::input
