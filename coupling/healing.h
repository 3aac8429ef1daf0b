// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/contact.h"
#include "fem/mesh.h"
#include "sph/solver.h"

#include <vector>

namespace ogive::coupling
{
/// Makes the moves of ContactSet::healing on bodies that no solver has yet, so
/// that what is moved is at rest there. Velocities stay; a mesh takes its mass
/// from its new shape, particles keep theirs. InputError if an element folds.
template <int dim>
void move_points(const std::vector<Move> &, const input::Scene &, std::vector<fem::BodyMesh<dim>> &,
                 std::vector<sph::BodyParticles<dim>> &);
} // namespace ogive::coupling
