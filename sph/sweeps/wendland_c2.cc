// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/choose_sweeps.h"

namespace ogive::sph::detail
{
template SweepFunctions sweeps_of<1, WendlandC2>(const SweepChoice &);
template SweepFunctions sweeps_of<2, WendlandC2>(const SweepChoice &);
template SweepFunctions sweeps_of<3, WendlandC2>(const SweepChoice &);
} // namespace ogive::sph::detail
