// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

namespace ogive::fem
{
/// What a bulk viscosity gives an element.
template <class T>
struct BulkViscosity
{
  T pressure; ///< Pa, added to the pressure
  T damping;  ///< Pa s: bound of its slope by the rate of volume strain, now and in the next step
};

/// q = rho L (c1 L D^2 + c2 c |D|) where the volume strain rate D < 0: the
/// quadratic term of von Neumann and Richtmyer, J. Appl. Phys. 21 (1950) 232,
/// doi 10.1063/1.1699639, and a linear one.
struct NeumannRichtmyer
{
  static constexpr const char *name = "neumann-richtmyer";

  double quadratic = 1.5, linear = .06; ///< c1, c2

  /// density kg/m^3, sound speed m/s, length m, compression = max(-D, 0) 1/s.
  template <class T>
  BulkViscosity<T> operator()(const T &density, const T &sound_speed, const T &length, const T &compression) const
  {
    const T mass = density * length, square = quadratic * length * compression, line = linear * sound_speed;
    // A node may be compressed next without warning: the linear part always counts.
    return {mass * compression * (square + line), mass * (2. * square + line)};
  }

  /// The damping that goes with a pressure given before, Pa s.
  template <class T>
  T damping(const T &density, const T &sound_speed, const T &length, const T &pressure) const
  {
    using std::sqrt;
    const T line = linear * sound_speed;
    return density * length * sqrt(line * line + 4. * quadratic * pressure / density);
  }
};
} // namespace ogive::fem
