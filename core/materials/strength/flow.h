// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::materials
{
/// An elastic trial that may lie outside the yield surface. Stresses are those
/// of the undamaged material, in von Mises measure, Pa.
struct Trial
{
  double stress;         ///< after the elastic step
  double old_stress;     ///< before it
  double three_g;        ///< 3 G, Pa
  double plastic_strain; ///< before the step
  double temperature;    ///< before the step, K
  double dt;             ///< s
  double heating;        ///< K per J/m^3 of plastic work
};

/// The answer of a strength law: stress = trial.stress - 3 G increment lies on
/// the yield surface, or increment = 0.
struct Flow
{
  double increment = 0; ///< of the effective plastic strain
  double work      = 0; ///< plastic work, J/m^3
};
} // namespace ogive::materials
