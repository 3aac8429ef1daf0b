// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/heat.h"

namespace ogive::coupling
{
void ShareOfStart::row(const RowFrame &frame)
{
  if (start_ < 0)
    start_ = frame.kinetic;
  value_ = energy(frame) / start_;
}

void ShareOfStart::recall(const std::vector<double> &numbers)
{
  start_ = numbers.at(0);
  value_ = numbers.at(1);
}

void ViscosityToPlasticWork::row(const RowFrame &frame)
{
  if (frame.plastic_work > 0)
    value_ = frame.viscosity_heat / frame.plastic_work;
}
} // namespace ogive::coupling
