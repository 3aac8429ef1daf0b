// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"
#include "core/base/tensor.h"

#include <array>
#include <cstddef>

namespace ogive::materials
{
/// The explicit state of n material points, structure of arrays, SI units.
/// Both solvers own one; laws read and write it and keep nothing themselves.
struct Points
{
  AlignedVector<double>                density;      ///< kg/m^3
  AlignedVector<double>                energy;       ///< specific internal energy, J/kg, owned by the solver
  std::array<AlignedVector<double>, 6> sigma;        ///< Cauchy stress xx yy zz xy yz zx, Pa, tension positive
  AlignedVector<double>                plastic_strain;
  AlignedVector<double>                plastic_work; ///< J/kg, all of it (heat and stored)
  AlignedVector<double>                damage;       ///< 0 .. 1, 1: failed (no deviator, no tension)
  AlignedVector<double>                temperature;  ///< K
  AlignedVector<double>                sound_speed;  ///< longitudinal, sqrt((K_s + 4/3 G)/rho), m/s

  std::size_t size() const { return density.size(); }

  template <class F>
  void for_each_array(F &&f)
  {
    f("density", density);
    f("energy", energy);
    static constexpr const char *names[6] = {
      "sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_yz", "sigma_zx"};
    for (int c = 0; c < 6; ++c)
      f(names[c], sigma[c]);
    f("plastic_strain", plastic_strain);
    f("plastic_work", plastic_work);
    f("damage", damage);
    f("temperature", temperature);
    f("sound_speed", sound_speed);
  }

  void resize(std::size_t n)
  {
    for_each_array([n](const char *, AlignedVector<double> &a) { a.resize(n, 0.); });
  }

  Sym3 stress(std::size_t i) const
  {
    return {sigma[0][i], sigma[1][i], sigma[2][i], sigma[3][i], sigma[4][i], sigma[5][i]};
  }
};

/// What moved during the step t_{n-1} -> t_n, one entry a point of the block.
/// Measured at the middle of the step: with the gradient L taken at the end of
/// the step, L_mid = L (I - dt/2 L)^-1, so that a rigid turn strains nothing.
struct Increments
{
  std::array<const double *, 6> strain;  ///< D dt, tensor components (not engineering shear)
  std::array<const double *, 3> spin;    ///< W dt: w_xy, w_yz, w_zx with w_ij = 1/2 (dv_i/dx_j - dv_j/dx_i) dt
  const double                 *density; ///< at the end of the step
  double                        dt = 0;  ///< s
};
} // namespace ogive::materials
