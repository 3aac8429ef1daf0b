// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <array>
#include <span>
#include <vector>

namespace ogive::sph
{
/// Lattice points inside one shape, clipped to x_axis >= 0 at symmetry planes.
struct ShapeLattice
{
  std::vector<Vec3>   points;
  double              volume  = 0; ///< exact, of the clipped shape: m^3, m^2 in 2-D, m in 1-D; of the whole ring, m^3
  double              spacing = 0; ///< (volume of a lattice cell)^(1/dim)
  Vec3                cell = Vec3::Zero(); ///< distances of the layers across each axis, m
  std::array<bool, 3> halved{};    ///< planes that pass through the shape
};

/// Boxes are filled exactly: the spacing along each edge is adjusted so that a
/// whole number fits. Round shapes fit their length and hold the points whose
/// cell centres lie inside; their lattice is centred on the axis, so a symmetry
/// plane through it lies half way between two layers.
/// InputError for shapes that dim cannot hold, or planes that cut a round shape
/// off its centre.
///
/// `turned` (dim 2): x is the radius, the points fill the half section x > 0.
ShapeLattice lattice_in(const input::Shape &, double spacing, int dim, bool turned,
                        std::span<const input::SymmetryPlane>, const std::string &body);
} // namespace ogive::sph
