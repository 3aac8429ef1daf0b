// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "fem/mesh.h"

namespace ogive::fem
{
/// Fills mesh.v with translation, spin about the centre of mass of the whole
/// body (of which symmetry planes may have kept a part), and velocity field.
template <int dim>
void set_initial_velocity(const input::Body &, const input::Scene &, BodyMesh<dim> &mesh);
} // namespace ogive::fem
