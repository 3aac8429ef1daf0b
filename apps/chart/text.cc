// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace ogive::chart
{
namespace
{
std::string formatted(const char *format, double v)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, v);
  return text.data();
}

std::string with_figures(double v, int figures)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", figures, v);
  return text.data();
}

/// Greatest multiple of three, at most n.
int floor_3(double n)
{
  return 3 * static_cast<int>(std::floor(n / 3));
}
} // namespace

ShownUnit shown_unit(double size, const std::string &unit)
{
  const bool plain = unit.empty() || unit == "1";
  if (size == 0 || !std::isfinite(size))
    return {1, plain ? "" : unit};
  const double n = std::log10(std::abs(size));
  // 0.05 and 2000 read well as they are
  if (n >= -2 && n < 4 && (plain || (unit != "m" && unit != "s")))
    return {1, plain ? "" : unit};
  if (unit == "m/s" && n > -4 && n < 4)
    return {1, unit};
  const int power = std::clamp(floor_3(n), -12, 12);
  if (power == 0)
    return {1, plain ? "" : unit};
  constexpr std::array<const char *, 9> prefixes{"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  const bool prefix = unit == "m" || unit == "s" || unit == "Pa" || unit == "J" || unit == "N" || unit == "m/s";
  if (prefix && !(unit == "s" && power > 0) && !(unit == "m" && power > 3))
    return {std::pow(10., -power), prefixes[static_cast<std::size_t>(power / 3 + 4)] + unit};
  return {std::pow(10., -power), "10" + superscript(power) + (plain ? "" : " " + unit)};
}

std::string shown(double value, const std::string &unit, int figures)
{
  const bool      plain = unit.empty() || unit == "1";
  const ShownUnit s     = plain ? ShownUnit{} : shown_unit(value, unit);
  return with_figures(value * s.factor, figures) + (s.unit.empty() ? "" : " " + s.unit);
}

std::string shown_range(double least, double greatest, const std::string &unit, int figures)
{
  const bool      plain = unit.empty() || unit == "1";
  const ShownUnit s     = plain ? ShownUnit{} : shown_unit(std::max(std::abs(least), std::abs(greatest)), unit);
  return with_figures(least * s.factor, figures) + " .. " + with_figures(greatest * s.factor, figures) +
         (s.unit.empty() ? "" : " " + s.unit);
}

std::string percent(double share)
{
  return formatted("%+.3g %%", 100 * share);
}

std::string superscript(int n)
{
  constexpr std::array<const char *, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string                            s;
  for (const char c : std::to_string(n))
    s += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return s;
}

std::size_t letters(const std::string &text)
{
  return static_cast<std::size_t>(
    std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> wrapped(const std::string &text, std::size_t width)
{
  std::istringstream       in(text);
  std::vector<std::string> lines;
  for (std::string word; in >> word;)
    if (lines.empty() || letters(lines.back()) + 1 + letters(word) > width)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  return lines;
}

std::string markdown_line(const std::vector<std::string> &cells)
{
  std::string s = "|";
  for (const std::string &cell : cells)
  {
    s += ' ';
    for (const char c : cell)
      s += c == '|' ? std::string("\\|") : std::string(1, c);
    s += " |";
  }
  return s + "\n";
}

std::string markdown_head(const std::vector<std::string> &cells)
{
  std::string s = markdown_line(cells) + "|";
  for (std::size_t i = 0; i < cells.size(); ++i)
    s += "---|";
  return s + "\n";
}
} // namespace ogive::chart
