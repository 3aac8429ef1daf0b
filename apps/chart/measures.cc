// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/measures.h"

#include "apps/chart/expressions.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ogive::chart
{
namespace
{
std::optional<double> absolute(std::optional<double> v)
{
  return v ? std::optional<double>(std::abs(*v)) : std::nullopt;
}

std::optional<double> number_of(const Study &s, const Row &row, const std::string &axis)
{
  const int a = s.axis_index(axis);
  if (a < 0 || row.levels[static_cast<std::size_t>(a)] < 0)
    return {};
  const auto   i = static_cast<std::size_t>(a);
  const double n = s.axes[i].levels[static_cast<std::size_t>(row.levels[i])].number;
  return std::isnan(n) ? std::nullopt : std::optional<double>(n);
}
} // namespace

std::optional<double> measure(const Results &r, std::size_t row, const Measure &m)
{
  const Outcome &o = r.outcomes[row];
  const Case    &c = r.study.cases[r.rows[row].of_case];
  if (o.status != Status::done)
    return {};
  switch (m.kind)
  {
    case Measure::Kind::axis_number:
      return number_of(r.study, r.rows[row], m.name);
    case Measure::Kind::core_seconds:
      return o.core_s;
    case Measure::Kind::wall_seconds:
      return o.wall_s;
    case Measure::Kind::work:
      return o.work();
    case Measure::Kind::value:
      return value_of(o, m.name);
    case Measure::Kind::size:
      return absolute(value_of(o, m.name));
    case Measure::Kind::error:
      return absolute(error_of(c, o, m.name));
    case Measure::Kind::spread:
      break;
  }
  return {};
}

std::vector<std::size_t> rows_of(const Results &r, const std::string &case_name, const Condition &only)
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < r.rows.size(); ++i)
    if (r.study.cases[r.rows[i].of_case].name == case_name &&
        holds(only, [&](const std::string &axis) { return level_name(r.study, r.rows[i], axis); }, true))
      found.push_back(i);
  return found;
}

std::vector<std::vector<std::size_t>> groups_along(const Results &r, std::span<const std::size_t> rows,
                                                   const std::string &axis)
{
  const int                             a = r.study.axis_index(axis);
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::vector<int>, std::size_t> known;
  for (const std::size_t i : rows)
  {
    std::vector<int> rest = r.rows[i].levels;
    if (a >= 0)
      rest[static_cast<std::size_t>(a)] = 0;
    rest.push_back(static_cast<int>(r.rows[i].of_case));
    const auto [at, fresh] = known.emplace(rest, groups.size());
    if (fresh)
      groups.emplace_back();
    groups[at->second].push_back(i);
  }
  return groups;
}

std::optional<double> Spread::value() const
{
  if (!least || !greatest || with_value < rows || rows < 2)
    return {};
  return *greatest - *least;
}

Spread spread_of(const Results &r, std::span<const std::size_t> rows, const std::string &quantity)
{
  Spread s;
  for (const std::size_t i : rows)
  {
    ++s.rows;
    const std::optional<double> v = value_of(r.outcomes[i], quantity);
    if (!v)
      continue;
    ++s.with_value;
    s.least    = s.least ? std::min(*s.least, *v) : *v;
    s.greatest = s.greatest ? std::max(*s.greatest, *v) : *v;
  }
  return s;
}

std::vector<std::string> varied_axes(const Results &r, std::span<const std::size_t> rows)
{
  std::vector<std::string> axes;
  for (std::size_t a = 0; a < r.study.axes.size(); ++a)
    if (std::any_of(rows.begin(), rows.end(),
                    [&](std::size_t i) { return r.rows[i].levels[a] != r.rows[rows.front()].levels[a]; }))
      axes.push_back(r.study.axes[a].name);
  return axes;
}
} // namespace ogive::chart
