// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <memory>

namespace ogive::coupling
{
/// One place of an exact solution along x.
struct ExactState
{
  double density;  ///< kg/m^3
  double velocity; ///< along x, m/s
  double pressure; ///< Pa
};

/// An exact plane solution of the motion that a body starts with.
class ExactProfile
{
public:
  virtual ~ExactProfile() = default;

  /// 0 < t <= until().
  virtual ExactState at(double x, double t) const = 0;

  /// When the first wave reaches an end of the body and the solution ends, s.
  virtual double until() const = 0;

  /// Greatest pressure of the solution, Pa.
  virtual double greatest_pressure() const = 0;
};

/// Of the velocity field "closing" (a shock each way from the middle, from the
/// material's own equation of state; needs a fluid) or of a gas with a step
/// plane (the Riemann problem of an ideal gas at rest). Walls at the ends and
/// symmetry planes along the way change nothing before until().
/// InputError at `entry` for a body that starts otherwise.
std::unique_ptr<ExactProfile> exact_profile(const input::Body &, const input::Scene &,
                                            const std::string &entry);

/// Gas at rest on both sides of x = 0; each side has density > 0, pressure > 0.
struct GasAtRest
{
  double density, pressure;
};

/// Self-similar solution of the shock tube: exact Riemann problem of an ideal
/// gas (textbook form, e.g. Toro, Riemann Solvers and Numerical Methods for
/// Fluid Dynamics, ch. 4). p* by bisection to rounding.
class ShockTube
{
public:
  ShockTube(double gamma, GasAtRest left, GasAtRest right);

  /// At x/t = s, m/s.
  ExactState at(double s) const;

  double pressure() const { return pressure_; } ///< between the waves, Pa
  double velocity() const { return velocity_; } ///< between the waves, m/s
  /// Of the outermost part of the wave to the right and to the left, m/s, > 0.
  double reach_right() const { return reach(right_); }
  double reach_left() const { return reach(left_); }

private:
  double sound(const GasAtRest &) const;
  double jump(const GasAtRest &, double pressure) const; ///< velocity it gives, m/s
  double reach(const GasAtRest &) const;
  /// On the right of the contact, for a wave that runs into `ahead`.
  ExactState behind(const GasAtRest &ahead, double contact, double s) const;

  double    gamma_;
  GasAtRest left_, right_;
  double    pressure_ = 0, velocity_ = 0;
};
} // namespace ogive::coupling
