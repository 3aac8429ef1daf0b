// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "fem/mesh_blocks.h"

#include <functional>
#include <string>

namespace ogive::fem
{
/// A generated mesh in space, with the rule that names its faces.
template <int dim>
struct ShapeMesh
{
  blocks::Raw<dim> raw;
  /// Name of the boundary facet with these corners.
  std::function<std::string(const std::vector<dealii::Point<dim>> &)> face_name;
};

/// Meshes a shape in the scene's dimension, kept side of the symmetry planes
/// only. Throws InputError for a shape that the dimension lacks.
template <int dim>
ShapeMesh<dim> mesh_shape(const input::Body &, const input::Scene &);

/// Height of a nose over the base of the nose at distance r from the axis, m.
double nose_height(const input::Shape &, double r);
} // namespace ogive::fem
