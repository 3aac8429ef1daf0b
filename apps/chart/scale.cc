// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/scale.h"

#include "apps/chart/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ogive::chart
{
namespace
{
constexpr double slack = 1e-9; ///< of a step: what rounding may add

double round_step(double range)
{
  const double power = std::pow(10., std::floor(std::log10(range / 5)));
  for (const double m : {1., 2., 5.})
    if (m * power >= range / 7)
      return m * power;
  return 10 * power;
}

std::string fixed(double v, int decimals)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", decimals, v == 0 ? 0. : v);
  return text.data();
}

std::string short_number(double v)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%g", v);
  return text.data();
}

/// The numbers 1, 2, 5, 10, 20, ... by their place in that order, 1 at 0.
double round_number(int i)
{
  constexpr std::array<double, 3> mantissas{1, 2, 5};
  const int                       decade = i >= 0 ? i / 3 : -((2 - i) / 3);
  // dividing by a whole power keeps .1 and .001 the nearest doubles
  const double m = mantissas[static_cast<std::size_t>(i - 3 * decade)];
  return decade >= 0 ? m * std::pow(10., decade) : m / std::pow(10., -decade);
}

std::string log_label(int i, bool powers)
{
  const double v = round_number(i);
  if (!powers)
    return short_number(v);
  const int decade   = i >= 0 ? i / 3 : -((2 - i) / 3);
  const int mantissa = std::array<int, 3>{1, 2, 5}[static_cast<std::size_t>(i - 3 * decade)];
  return (mantissa == 1 ? "" : std::to_string(mantissa) + "·") + "10" + superscript(decade);
}
} // namespace

double Scale::at(double v) const
{
  return log ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
}

Scale linear_scale(double least, double greatest)
{
  if (least == greatest)
  {
    const double half = least == 0 ? 1 : .05 * std::abs(least);
    least -= half;
    greatest += half;
  }
  Scale        s;
  const double step  = round_step(greatest - least);
  const auto   first = static_cast<long long>(std::floor(least / step + slack));
  const auto   last  = static_cast<long long>(std::ceil(greatest / step - slack));
  const int    decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + slack)));
  for (long long i = first; i <= last; ++i)
    s.ticks.push_back({static_cast<double>(i) * step, fixed(static_cast<double>(i) * step, decimals)});
  s.low  = s.ticks.front().value;
  s.high = s.ticks.back().value;
  return s;
}

Scale log_scale(double least, double greatest)
{
  int first = static_cast<int>(std::floor(3 * std::log10(least))) - 2, last;
  while (round_number(first + 1) <= least * (1 + slack))
    ++first;
  for (last = first; round_number(last) < greatest * (1 - slack);)
    ++last;
  if (last == first)
  {
    --first;
    ++last;
  }

  Scale s;
  s.log                  = true;
  s.low                  = round_number(first);
  s.high                 = round_number(last);
  const double decades   = std::log10(s.high / s.low);
  const int    every     = decades > 9 ? static_cast<int>(std::ceil(decades / 8)) : 1;
  const bool   powers    = s.low < .9e-3 || s.high > 1.1e5;
  const bool   between   = decades < 2.5;
  for (int i = first; i <= last; ++i)
  {
    const int  decade  = i >= 0 ? i / 3 : -((2 - i) / 3);
    const bool whole   = i == 3 * decade;
    const bool labeled = between || (whole && decade % every == 0);
    s.ticks.push_back({round_number(i), labeled ? log_label(i, powers) : ""});
  }
  return s;
}
} // namespace ogive::chart
