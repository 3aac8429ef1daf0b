// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "fem/mesh.h"
#include "fem/mesh_shapes.h"

#include <deal.II/grid/tria.h>

#include <array>
#include <string>
#include <vector>

namespace ogive::fem
{
/// Generated meshes whose edges double with the distance from the impact: a
/// coarse mesh, refined where it is near. Serial deal.II triangulations: the
/// mesh becomes plain arrays at once, so a distributed forest would hold the
/// same cells, balanced 2:1 across corners alike, and would need MPI for it.

/// Builds the coarse mesh (edge spacing 2^coarsen) and refines it. The
/// triangulation must limit level differences at vertices. Returns the names of
/// its boundary ids. New points of curved faces lie on the true shape.
template <int dim>
std::vector<std::string> make_coarsened(const input::Body &, const input::Scene &,
                                        dealii::Triangulation<dim> &);

/// Names the boundaries of a reduced mesh, so far called by their ids.
template <int dim>
void name_boundaries(const std::vector<std::string> &names, BodyMesh<dim> &);

/// A vertex in the middle of an edge or face of a coarser active cell.
struct HangingVertex
{
  unsigned int                vertex = 0;
  std::size_t                 n      = 0;
  std::array<unsigned int, 4> master{};
};
template <int dim>
std::vector<HangingVertex> hanging_vertices(const dealii::Triangulation<dim> &);
} // namespace ogive::fem
