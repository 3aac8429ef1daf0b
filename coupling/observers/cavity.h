// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// A spherical cavity in an elastic solid without end whose wall feels a pressure
/// from t = 0 on: Blake, J. Acoust. Soc. Am. 24 (1952) 211,
/// doi 10.1121/1.1906882. With the potential f(tau)/r of the displacement,
/// tau = t - (r - a)/c, the wall asks f'' + 2 d f' + b^2 f = -p a/rho, where
/// b^2 = 4 G/(rho a^2) and d = 2 G/(rho c a).
struct BlakeCavity
{
  double radius = 0, pressure = 0;            ///< m, Pa
  double density = 0, lambda = 0, shear = 0; ///< kg/m^3, Pa, Pa

  double speed() const; ///< of longitudinal waves, m/s
  /// Outward displacement at the place that began at r, m.
  double displacement(double r, double t) const;
  /// The same for the pressure times a history, by superposition.
  double displacement(double r, double t, const input::History &) const;
  double radial_stress(double r, double t) const; ///< Pa, tension positive
  double hoop_stress(double r, double t) const;   ///< Pa

private:
  struct Potential
  {
    double f, slope, curvature; ///< m^3, m^3/s, m^3/s^2
  };
  Potential at(double r, double t) const;
  double    displacement_integral(double r, double t) const; ///< over time from 0 on, m s
};

/// Root mean square distance of the displacement from that of Blake's cavity,
/// over its root mean square, by mass, of the nodes that began closer to the
/// centre than the parameter. A linear elastic shell under one pressure inside,
/// with or without a history.
class CavityError : public BodyObserver
{
public:
  CavityError(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  BlakeCavity    cavity_;
  input::History history_;
  Vec3           centre_;
};
} // namespace ogive::coupling
