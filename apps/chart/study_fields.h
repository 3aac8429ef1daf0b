// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/study.h"
#include "core/input/fields.h"

namespace ogive::chart
{
/// Every entry of a study, see core/input/fields.h. The lists must hold as many
/// named items as there will be subsections, and each case what its scene measures.
void study_fields(input::Fields &, Study &);
} // namespace ogive::chart
