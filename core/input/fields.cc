// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/fields.h"

#include "core/input/history_pattern.h"
#include "core/input/listing.h"

#include <algorithm>
#include <cmath>

namespace ogive::input
{
void Fields::enter(const std::string &subsection)
{
  path_.push_back(subsection);
  entered();
}

void Fields::leave()
{
  left();
  path_.pop_back();
}

std::string Fields::section() const
{
  return join(path_, "/");
}

bool Fields::applies(const Use &use) const
{
  if (use.entry.empty())
    return true;
  const auto here = values_.find(section());
  if (here == values_.end())
    return false;
  const auto value = here->second.find(use.entry);
  if (value == here->second.end() || value->second.empty())
    return false;
  return use.values.empty() || std::find(use.values.begin(), use.values.end(), value->second) != use.values.end();
}

void Fields::quantity(const About &about, double &value, units::Dimension d, Bound bound)
{
  entry(about, QuantityPattern(d, bound), std::isnan(value) ? "" : units::format_quantity(value, d),
        [&](const std::string &text) { value = parse_scalar(text, d, bound); });
}

void Fields::number(const About &about, double &value, Bound bound)
{
  quantity(about, value, units::none, bound);
}

void Fields::vector(const About &about, Vec3 &value, units::Dimension d)
{
  entry(about, VectorPattern(d), format_vector(value, d),
        [&](const std::string &text) { value = parse_vector(text, d); });
}

void Fields::direction(const About &about, Vec3 &value)
{
  entry(about, VectorPattern(units::none, true), format_vector(value, units::none), [&](const std::string &text) {
    value = parse_vector(text, units::none);
    // a unit vector stays as it is written, so that reading it twice changes nothing
    if (std::abs(value.squaredNorm() - 1) > 1e-15)
      value.normalize();
  });
}

void Fields::text(const About &about, std::string &value, const std::string &expectation)
{
  entry(about, TextPattern(expectation), value, [&](const std::string &text) { value = text; });
}

void Fields::choice(const About &about, std::string &value, const std::vector<std::string> &choices)
{
  entry(about, ChoicePattern(choices), value, [&](const std::string &text) { value = text; });
}

void Fields::names(const About &about, std::vector<std::string> &value, const NamesPattern &pattern)
{
  entry(about, pattern, join(value), [&](const std::string &text) { value = split_list(text); });
}

void Fields::source(const About &about, std::string &kind, std::string &text)
{
  entry(about, SourcePattern(), kind.empty() ? "" : kind + ": " + text, [&](const std::string &value) {
    const std::size_t colon = value.find(':');
    kind                    = trim(value.substr(0, colon));
    text                    = trim(value.substr(colon + 1));
  });
}

void Fields::history(const About &about, History &value)
{
  entry(about, HistoryPattern(), format_history(value), [&](const std::string &text) { value = parse_history(text); });
}

void Fields::range(const About &about, double &low, double &high, units::Dimension d)
{
  entry(about, RangePattern(d), std::isnan(low) ? "" : format_range(low, high, d),
        [&](const std::string &text) { std::tie(low, high) = parse_range(text, d); });
}
} // namespace ogive::input
