// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/base/sample.h"
#include "core/parallel/ranks.h"

namespace ogive::sph
{
/// Sums over the ranks of what each owns; the same on all.
void sum_over(const Ranks &, Balance &);

/// The particles of all ranks by their ids, on all; of one rank as they are.
void gather(const Ranks &, Sample &);
} // namespace ogive::sph
