// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/lanes.h"

namespace ogive::materials
{
/// What an equation of state says at (density, specific energy).
template <class T>
struct EosResponse
{
  T pressure;            ///< Pa, compression positive
  T sound_speed_squared; ///< bulk and isentropic, (dp/drho)_s, m^2/s^2
};

/// Tension carried by a material that gives way at mean stress `limit` >= 0 and
/// keeps the share `intact` of what is left of it. Where tension is cut, voids
/// open: the sound speed of the stretched solid means nothing there, so it is
/// held at or under `rest` (its square at rest); it is not let fall with the
/// true tangent, which is zero, because step bounds and viscosities scale on it.
/// Far out, where an equation of state of the solid has no real one, it is `rest`.
template <class T>
EosResponse<T> carry_tension(EosResponse<T> r, double limit, T intact, double rest)
{
  const T    carried = select(r.pressure < T(-limit), T(-limit), r.pressure);
  const T    kept    = select(carried < T(0), carried * intact, carried);
  const auto cut     = kept > r.pressure;
  const T    real    = select(r.sound_speed_squared < T(0), T(rest), r.sound_speed_squared);
  const T    capped  = select(real > T(rest), T(rest), real);
  return {kept, select(cut, capped, r.sound_speed_squared)};
}
} // namespace ogive::materials
