// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <string>
#include <vector>

namespace ogive
{
/// A copy of one body's state, taken when observers or output ask for it.
/// Components that the dimension lacks are zero. Nodes carry motion, points
/// carry material; for particles they are the same.
struct Sample
{
  bool                                is_mesh = false;
  std::array<std::vector<double>, 3>  x, x0, v; ///< nodes: position, initial position (m), velocity (m/s)
  std::vector<double>                 mass;     ///< nodes, kg
  std::vector<double>                 radius;   ///< nodes, m: half the spacing of a particle, 0 for a mesh node
  /// Nodes, m: half the distance of material layers across each axis, particles
  /// only; a particle's share of a body that is squeezed or drawn.
  std::array<std::vector<double>, 3>  half_cell;
  std::vector<std::int64_t>           id;       ///< nodes

  std::array<std::vector<double>, 3>  centre, centre0; ///< points, m
  std::array<std::vector<double>, 6>  sigma;    ///< points, Pa, tension positive, xx yy zz xy yz zx
  std::vector<double>                 density, energy, plastic_strain, damage, temperature; ///< points
  std::vector<double>                 volume;   ///< points

  int                                 nodes_per_cell = 1;
  std::vector<std::uint32_t>          cells;    ///< mesh: nodes of each cell, VTK order
};
} // namespace ogive
