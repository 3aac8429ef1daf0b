// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/measures.h"

#include <string>

namespace ogive::chart
{
/// tables.md: a table a case, the spreads, the maps. Markdown.
std::string tables(const Results &);
} // namespace ogive::chart
