// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::fem
{
/// What a one-point element keeps of its shape, for one scalar or one lane
/// group T. Corners are in VTK order: quads counter-clockwise, hexes the
/// bottom counter-clockwise seen from above, then the top.
///
/// B is the volume integral of the shape function gradients, so that B/volume
/// is their exact mean and sum_a x_a (x) B_a = volume I. In axial symmetry the
/// integrals run over the whole ring (2 pi r) and hoop_a is that of N_a/r.
template <class Element, class T>
struct Geometry
{
  static constexpr int modes = Element::modes > 0 ? Element::modes : 1;

  T volume;
  T B[Element::corners][Element::dim];
  T hoop[Element::hoop ? Element::corners : 1];
  T skew[modes][Element::dim]; ///< hourglass pattern times corner positions, m
};
} // namespace ogive::fem
