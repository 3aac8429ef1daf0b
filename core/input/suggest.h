// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace ogive::input
{
/// Number of letters to insert, delete, replace or swap with their neighbour to
/// turn one word into the other; upper and lower case count as equal.
int edit_distance(const std::string &, const std::string &);

/// The known name nearest to `wanted`, empty if none is near enough to be a slip.
std::string nearest(const std::string &wanted, const std::vector<std::string> &known);

/// `did you mean "..."?`, or an empty text.
std::string did_you_mean(const std::string &wanted, const std::vector<std::string> &known);
} // namespace ogive::input
