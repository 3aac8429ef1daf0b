// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/measures.h"

#include <string>

namespace ogive::chart
{
/// chart.csv: a line a row. A cell without a value is empty; text is quoted where
/// RFC 4180 asks for it.
std::string csv(const Results &);

/// A cell as RFC 4180 has it.
std::string csv_cell(const std::string &text);
} // namespace ogive::chart
