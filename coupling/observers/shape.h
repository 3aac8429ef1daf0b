// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Extent along a unit vector, m; particles count with the half of their cell.
double extent_along(const Sample &, const Vec3 &direction);

/// Extent along the direction.
class Length : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Radius of the foot of a Taylor bar: the greatest distance from the axis in
/// the lowest tenth, taken in each of 32 sectors about the axis and averaged
/// over those that hold points (all points of an axisymmetric model lie in one).
class FootRadius : public BodyObserver
{
public:
  FootRadius(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  Vec3 base_;
};

class PeakStress : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

class GreatestDamage : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};
} // namespace ogive::coupling
