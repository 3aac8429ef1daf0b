// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/mesh.h"

namespace ogive::fem
{
/// Makes each cell of a multilinear mesh a spectral element of this degree with
/// straight edges: nodes at the Gauss-Lobatto points, shared by neighbours; the
/// cells and facets between them become those of the mesh. Before velocities.
template <int dim>
void raise_degree(BodyMesh<dim> &, int degree);
} // namespace ogive::fem
