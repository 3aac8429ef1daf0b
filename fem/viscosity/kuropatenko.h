// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/viscosity/neumann_richtmyer.h"

namespace ogive::fem
{
/// q = rho du (k du + sqrt((k du)^2 + (c2 c)^2)) with the velocity jump du = L |D|
/// and k = c1/2: the form of the pressure jump of a shock, c2 = 1 and k = (Gamma + 1)/4
/// for an ideal gas (Kuropatenko 1967, as quoted by Caramana, Shashkov and Whalen, J.
/// Comput. Phys. 144 (1998) 70, doi 10.1006/jcph.1998.5989). It meets NeumannRichtmyer
/// with the same coefficients in weak and in strong shocks and lies below it between.
struct Kuropatenko
{
  static constexpr const char *name = "kuropatenko";

  double quadratic = 1.5, linear = .06; ///< c1, c2

  template <class T>
  BulkViscosity<T> operator()(const T &density, const T &sound_speed, const T &length, const T &compression) const
  {
    using std::sqrt;
    const T jump = length * compression;
    return {density * jump * (.5 * quadratic * jump + root(sound_speed, jump)),
            density * length * slope(sound_speed, jump)};
  }

  /// The damping that goes with a pressure given before, Pa s:
  /// y = q/rho gives du = y/sqrt((c2 c)^2 + c1 y).
  template <class T>
  T damping(const T &density, const T &sound_speed, const T &length, const T &pressure) const
  {
    using std::sqrt;
    const T y = pressure / density, line = linear * sound_speed;
    return density * length * slope(sound_speed, T(y / sqrt(line * line + quadratic * y + tiny)));
  }

private:
  static constexpr double tiny = 1e-200; ///< no division by zero where nothing is viscous

  template <class T>
  T root(const T &sound_speed, const T &jump) const
  {
    using std::sqrt;
    const T k = .5 * quadratic * jump, line = linear * sound_speed;
    return sqrt(k * k + line * line);
  }
  /// d(q/rho)/d(du)
  template <class T>
  T slope(const T &sound_speed, const T &jump) const
  {
    const T k = .5 * quadratic * jump, r = root(sound_speed, jump);
    return 2. * k + r + k * k / (r + tiny);
  }
};
} // namespace ogive::fem
