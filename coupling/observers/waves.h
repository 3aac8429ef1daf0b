// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Speed of the foremost place where the axial pressure passes a level.
class FrontSpeed : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

class PlateauStress : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

class GaugeStress : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};
} // namespace ogive::coupling
