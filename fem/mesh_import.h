// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "fem/mesh.h"

#include <deal.II/grid/tria.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ogive::fem
{
/// What a mesh file says beyond the triangulation.
struct MeshImport
{
  /// Words for the facets of boundary id k of the triangulation: one for all
  /// ("hole", "hole+rim" if in two groups), names and numbers of the groups. Id 0
  /// is "rest", also "0": facets in no group.
  std::vector<std::vector<std::string>> faces;
  std::vector<std::int64_t>             cell_numbers; ///< as the file counts, empty if unknown
  std::vector<std::string>              notes;
};

/// Reads the mesh file of a body, or the part of it that the body names. Cells
/// become right-handed if all are left-handed. Throws InputError for a file that
/// cannot be read, lacks the part, or holds other cells than lines,
/// quadrilaterals, hexahedra.
template <int dim>
MeshImport import_mesh(const input::Body &, dealii::Triangulation<dim> &);

/// Names the boundaries of a mesh, so far called by the ids of its triangulation.
template <int dim>
void name_boundaries(const MeshImport &, const std::string &body, BodyMesh<dim> &);
} // namespace ogive::fem
