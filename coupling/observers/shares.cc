// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/shares.h"

namespace ogive::coupling
{
void EnergyShare::row(const RowFrame &frame)
{
  if (start_ < 0)
    start_ = frame.kinetic + frame.elastic;
  value_ = part(frame) / start_;
}

void EnergyShare::recall(const std::vector<double> &numbers)
{
  start_ = numbers.at(0);
  value_ = numbers.at(1);
}
} // namespace ogive::coupling
