// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"
#include "core/parallel/ranks.h"

#include <cstdint>
#include <span>

namespace ogive::sph
{
/// Makes what ranks found out on their own the answer of all; called by all.

/// Well where all ranks are; else how it ended on the first rank where it did not.
/// `counts` become their sums over the ranks, in the same message.
StepStatus agree(const Ranks &, const StepStatus &, std::span<std::int64_t> counts = {});

/// The tightest bound of all ranks, of several equal ones that of the first.
StepLimit tightest(const Ranks &, const StepLimit &);
} // namespace ogive::sph
