// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"
#include "coupling/observers/exact_profile.h"

namespace ogive::coupling
{
/// Greatest axial pressure over that of the exact plateau behind the shocks of
/// two closing halves, less 1: ringing counts, hot material at the right
/// pressure does not. The greatest of all rows from when the exact front is a
/// third through, until it reaches the end: the start of a shock is no part of it.
class Overshoot : public BodyObserver
{
public:
  Overshoot(const input::Observer &, const input::Scene &);

protected:
  double              measure(const Sample &, double time) override;
  std::vector<double> memory() const override { return {worst_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  std::unique_ptr<ExactProfile> exact_;
  double                        worst_ = std::numeric_limits<double>::quiet_NaN();
};

/// Mean distance from the exact profile along x over the mean of that profile's
/// size, of the axial pressure, density (both weighed by volume) or velocity
/// (by mass). Once the exact solution has ended, what it last was.
class ProfileError : public BodyObserver
{
public:
  ProfileError(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  std::unique_ptr<ExactProfile> exact_;
  std::string                   quantity_;
};

/// How fast a front spreads from the point: the distance from it within which
/// lies as much mass as has a pressure along the direction above the parameter,
/// over time. Asks for no shape and no symmetry, and one odd particle ahead of
/// the front or behind it moves it by no more than its mass.
class ShockSpeed : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// How much the density about the point lacks of the parameter, as a share: mean
/// of the particles that are no farther than twice the nearest one.
class DensityDeficit : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};
} // namespace ogive::coupling
