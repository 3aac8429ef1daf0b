// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::sph
{
/// A plane x_axis = at behind which the solver puts mirror images of what stands
/// in front of it. Unlike a symmetry plane of a scene it may lie anywhere, and
/// be odd: velocities and stresses change their sign behind it, so that across
/// it nothing moves along the plane, and its normal is free. A plane shear wave
/// that runs along an odd mirror does not notice it. Two mirrors of one axis
/// stand further apart than a neighbourhood. For measurements on a piece of a
/// body; material neither bounces off a mirror nor lands on it.
struct Mirror
{
  int    axis  = 0;
  double at    = 0;     ///< m
  bool   below = false; ///< the material lies at x_axis < at
  bool   odd   = false;
};
} // namespace ogive::sph
