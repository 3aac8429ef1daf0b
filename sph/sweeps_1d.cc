// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/choose_sweeps.h"

namespace ogive::sph
{
template SweepFunctions choose_sweeps<1>(const SweepChoice &, const std::string &);
} // namespace ogive::sph
