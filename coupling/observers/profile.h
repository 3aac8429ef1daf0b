// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Diameter of a round bar at a height, the parameter, above its lowest point
/// along the direction. The outline is taken in each of 32 sectors about the
/// axis: between the outermost points in the slabs, a sixteenth of the length
/// thick, below and above the height, interpolated to it; particles count with
/// half of their cell. Mean over the sectors that hold points.
class WidthAt : public BodyObserver
{
public:
  WidthAt(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  Vec3 base_;
};
} // namespace ogive::coupling
