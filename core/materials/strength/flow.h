// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/lanes.h"

namespace ogive::materials
{
/// An elastic trial that may lie outside the yield surface. Stresses are those
/// of the undamaged material, in von Mises measure, Pa. T is one point or a
/// register of them.
template <class T>
struct Trial
{
  T      stress;         ///< after the elastic step
  T      old_stress;     ///< before it
  double three_g;        ///< 3 G, Pa
  T      plastic_strain; ///< before the step
  T      temperature;    ///< before the step, K
  double dt;             ///< s
  T      heating;        ///< K per J/m^3 of plastic work
};

/// The answer of a strength law: stress = trial.stress - 3 G increment lies on
/// the yield surface, or increment = 0.
template <class T>
struct Flow
{
  T increment; ///< of the effective plastic strain
  T work;      ///< plastic work, J/m^3
};
} // namespace ogive::materials
