// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace ogive::chart
{
/// How numbers of a size are best written: value*factor in `unit`.
struct ShownUnit
{
  double      factor = 1;
  std::string unit; ///< "mm", "10⁻⁶ kg", empty for plain numbers
};

/// `unit` is an SI unit, "1" for none.
ShownUnit shown_unit(double size, const std::string &unit);

/// So many figures with a unit: "21.42 mm".
std::string shown(double value, const std::string &unit, int figures = 4);

/// "21.42 .. 23 mm".
std::string shown_range(double least, double greatest, const std::string &unit, int figures = 4);

/// "+.0123" as "+1.23 %".
std::string percent(double share);

/// "⁻⁶".
std::string superscript(int);

/// Characters, not bytes, of a UTF-8 text.
std::size_t letters(const std::string &);

/// Lines of at most `width` letters, broken at blanks.
std::vector<std::string> wrapped(const std::string &, std::size_t width);

/// "| a | b |" with bars in the cells escaped.
std::string markdown_line(const std::vector<std::string> &cells);
std::string markdown_head(const std::vector<std::string> &cells);
} // namespace ogive::chart
