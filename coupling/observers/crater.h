// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Diameter of the hole in a plate, m: twice the least distance from the line
/// through the point along the direction, mean over those of 32 sectors about it
/// that hold points, of material that is slower than the parameter and within
/// the thickness that the body had at the start. 0 while there is no hole.
class CraterDiameter : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Length over width of a debris cloud: of what of the body has passed the point
/// along the direction and is faster than the parameter. The length begins at
/// the point; of the mass the foremost and the outermost hundredth are left out.
/// NaN while nothing has passed.
class CloudShape : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};
} // namespace ogive::coupling
