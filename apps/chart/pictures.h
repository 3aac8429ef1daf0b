// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/measures.h"
#include "apps/chart/plot.h"

#include <string>

namespace ogive::chart
{
/// A chart of one case. Rows that cannot be shown are named in its notes.
Plot make_plot(const Results &, const ChartSpec &, const std::string &case_name);

/// Titles of the row's levels along these axes, "-" where one is not used.
std::vector<std::string> level_titles(const Study &, const Row &, const std::vector<std::string> &axes);

/// The same for a text where the axes are not named: a bare number follows its
/// axis' title, "alpha 0.5", and an axis that is not used is "alpha as in the scene".
std::vector<std::string> configuration(const Study &, const Row &, const std::vector<std::string> &axes);
} // namespace ogive::chart
