// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/neighbours.h"

namespace ogive::sph
{
/// Directed pairs and what the energy sweep takes over from the force sweep.
struct Pairs
{
  NeighbourRows         rows;
  AlignedVector<double> hourglass, viscosity, weak; ///< see Sweep
};

/// Mirror images behind one wall, or, in the corners, behind several: those
/// that are reflected at each of `wall`, and, next to symmetry planes, their
/// reflections there. Rigid walls whose normal lies along an axis have them;
/// they make a wall what it is to a body that lies on it, a plane of symmetry,
/// where the landing of single particles would leave the first layer without
/// neighbours below.
///
/// They act in pairs i-image(j) of which both i and j stand where every wall of
/// the set is touched: within one spacing along the wall of a touching particle
/// (cells of one spacing and their neighbours). A particle touches once it
/// arrives at its rest gap (rest_gap()) and is not receding; it lets go
/// when it recedes beyond that gap and its normal stress is a pull. So a wall
/// presses and does not pull, but where only part of a neighbourhood has let
/// go. No particle comes closer than the rest gap (land_on_walls): without
/// that the first layer is squeezed to a film that runs out along the wall.
///
/// The operator is symmetric in i and j, so that the power of the forces and
/// the power of the stresses differ by the force on the walls times their
/// velocity, to rounding: the work that is booked.
struct Images
{
  std::array<int, 3>                      wall{-1, -1, -1}; ///< by axis
  std::int64_t                            bits = 0;         ///< of the walls
  std::vector<std::array<std::size_t, 2>> range;            ///< in Ghosts, of each body
  Pairs                                   pairs;
  AlignedVector<double>                   sums;   ///< of any sweep but those of forces
  AlignedVector<double>                   forces; ///< of the force sweep, zero where they do not act
};
} // namespace ogive::sph
