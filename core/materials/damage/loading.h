// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::materials
{
/// What a point went through in one step. Stresses are those of the undamaged
/// material (the stored ones divided by 1 - D), Pa.
///
/// Damage and stress, for every law: the stored deviator is (1 - D) times the
/// undamaged one, tension likewise; pressure is not reduced. A point with
/// D = 1 has failed: no deviator, no tension, for good.
struct Loading
{
  double damage;            ///< before the step, < 1
  double plastic_strain;    ///< after the step
  double plastic_increment; ///< of this step, >= 0
  double mean_stress;       ///< tension positive
  double von_mises;
  double temperature;       ///< K
  double dt;                ///< s
};
} // namespace ogive::materials
