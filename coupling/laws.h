// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/surfaces.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
/// Penalty stiffness of one contact, N/m: `share` * m_eff/dt^2. `inverse_mass`
/// is 1/m_eff = 1/m_point + sum w_I^2/m_I over the points that carry the other
/// side, 1/kg; `dt` a time step, s. With share <= .1 a single contact has
/// (w dt)^2 <= .1 against the limit 4 of the leapfrog.
inline double penalty_stiffness(double share, double inverse_mass, double dt)
{
  return share / (inverse_mass * dt * dt);
}

/// The part of `vector` across the unit vector `normal`.
template <int dim>
Point<dim> across(const Point<dim> &vector, const Point<dim> &normal)
{
  return vector - vector.dot(normal) * normal;
}

/// `spring` turned into the plane across `normal`, its length kept.
template <int dim>
Point<dim> turned_into_plane(const Point<dim> &spring, const Point<dim> &normal)
{
  const double length = spring.norm();
  if (length == 0)
    return spring;
  const Point<dim> flat   = across<dim>(spring, normal);
  const double     inside = flat.norm();
  return inside > 0 ? Point<dim>(flat * (length / inside)) : Point<dim>(Point<dim>::Zero());
}

/// Result of Coulomb's law for one step.
template <int dim>
struct FrictionStep
{
  Point<dim> spring = Point<dim>::Zero(); ///< elastic part of the slip, m; the force is -k * spring
  double     heat   = 0;                  ///< J
};

/// Stick-slip by return mapping: the tangential spring is stretched by the
/// relative displacement `slide` (m, across the normal) since the last step;
/// beyond |k spring| = limit (N) the rest of the stretch is slip.
///
/// Heat is slip times the mean of the forces before and after. That is what
/// leaves the books of the leapfrog exactly: with the stored energy
/// 1/2 k s_n.s_{n+1} the work of the force over one kick is the change of the
/// stored energy plus this heat. A limit of 0 (contact opens) turns all that is
/// stored into heat.
template <int dim>
FrictionStep<dim> coulomb(const Point<dim> &spring, const Point<dim> &slide, double stiffness, double limit)
{
  const Point<dim>  trial  = spring + slide;
  const double      length = stiffness * trial.norm();
  FrictionStep<dim> result;
  result.spring = length > limit ? Point<dim>(trial * (limit / length)) : trial;
  result.heat   = .5 * stiffness * (result.spring + spring).dot(trial - result.spring);
  return result;
}
} // namespace ogive::coupling
