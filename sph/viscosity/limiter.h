// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

namespace ogive::sph
{
/// The part of v_ij.x_ij that is a jump: what is left when the linear fields of
/// both ends are continued to the middle of the pair,
///   delta = vx - 1/2 phi (g_i + g_j), g = x_ij.grad v.x_ij,
///   phi = 4 r/(1 + r)^2 with r = g_i/g_j > 0, else 0,
/// van Leer's form of phi, guarded to approach and to |delta| <= |vx|. Zero in
/// uniform compression and in every smooth flow to second order, the whole jump
/// where the gradients disagree.
inline VDouble limited_jump(const VDouble &vx, const VDouble &gi, const VDouble &gj)
{
  const VDouble product = gi * gj, sum = gi + gj;
  const VDouble smooth  = select(product > 0., VDouble(2. * product * reciprocal(sum)), VDouble(0.)); // phi sum/2
  const VDouble approach = stdx::min(vx, VDouble(0.));
  return stdx::min(VDouble(0.), stdx::max(approach, VDouble(vx - smooth)));
}
} // namespace ogive::sph
