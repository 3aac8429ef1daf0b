// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/map.h"

#include "apps/chart/pictures.h"
#include "apps/chart/text.h"
#include "core/input/listing.h"

#include <algorithm>
#include <cmath>

namespace ogive::chart
{
namespace
{
using State = SurvivalMap::State;

std::string metric_of(const Case &c)
{
  if (!c.metric.empty())
    return c.metric;
  for (const Judged &q : c.quantities)
    if (q.bounded())
      return q.name;
  return {};
}

std::string bounds_of(const Case &c)
{
  std::string text;
  const auto  add = [&](const std::string &one) { text += (text.empty() ? "" : ", ") + one; };
  for (const Judged &q : c.quantities)
  {
    const std::string unit = unit_of(c, q.name);
    const bool        low = !std::isnan(q.at_least), high = !std::isnan(q.at_most);
    if (low && high)
      add(shown(q.at_least, unit) + " ≤ " + q.name + " ≤ " + shown(q.at_most, unit));
    else if (low)
      add(q.name + " ≥ " + shown(q.at_least, unit));
    else if (high)
      add(q.name + " ≤ " + shown(q.at_most, unit));
    if (!std::isnan(q.error_at_most))
      add(q.name + " within " + shown(100 * q.error_at_most, "1", 3) + " %");
  }
  return text.empty() ? "runs to its end" : text;
}

std::string source_of(const Case &c)
{
  std::vector<std::string> sources;
  for (const Judged &q : c.quantities)
    if (!q.bound_source.empty() && std::find(sources.begin(), sources.end(), q.bound_source) == sources.end())
      sources.push_back(q.bound_source);
  std::string text;
  for (const std::string &s : sources)
    text += (text.empty() ? "" : "; ") + s;
  return text;
}

/// What a single failed row says beyond its metric.
std::string detail_of(const Case &c, const Outcome &o, const Verdict &v, const std::string &metric)
{
  if (o.status != Status::done)
    return o.status == Status::too_long ? "too long" : "ended early";
  if (v.broken == metric)
    return value_of(o, metric) ? "" : "no value";
  const std::optional<double> value = value_of(o, v.broken);
  return v.broken + " " + (value ? shown(*value, unit_of(c, v.broken), 3) : "without value");
}

SurvivalMap::Cell make_cell(const Results &r, const Case &c, const std::string &metric,
                            const std::vector<std::size_t> &rows)
{
  SurvivalMap::Cell cell;
  for (const std::size_t i : rows)
  {
    const Verdict verdict = judge(c, r.outcomes[i]);
    ++cell.rows;
    if (verdict.survived || cell.failed++ > 0)
      continue;
    cell.why = verdict.why;
    if (rows.size() == 1)
      cell.detail = detail_of(c, r.outcomes[i], verdict, metric);
  }
  if (cell.rows > 0)
    cell.state = cell.failed > 0 ? State::failed : State::survived;
  const Spread s = spread_of(r, rows, metric);
  if (!metric.empty() && s.least)
  {
    const std::string unit = unit_of(c, metric);
    cell.metric = *s.least < *s.greatest ? shown_range(*s.least, *s.greatest, unit, 3) : shown(*s.least, unit, 3);
  }
  return cell;
}

/// Why the levels of a column mean nothing to a case; null if they mean something.
const std::string *why_not(const Study &s, const Case &c, const std::vector<std::string> &axes,
                           const std::vector<int> &key)
{
  for (std::size_t a = 0; a < axes.size(); ++a)
    if (const CaseAxis *in_case = c.find_axis(axes[a]); in_case && key[a] >= 0)
    {
      const Axis &axis = s.axes[static_cast<std::size_t>(s.axis_index(axes[a]))];
      if (const std::string *why = chart::why_not(axis, *in_case, axis.levels[static_cast<std::size_t>(key[a])]))
        return why;
    }
  return nullptr;
}
} // namespace

std::string state_text(const SurvivalMap::Cell &cell)
{
  if (cell.state == State::left_out)
    return "not run";
  if (cell.state == State::without_meaning)
    return "does not apply";
  if (cell.state == State::survived)
    return "survived";
  return cell.rows > 1 ? "failed " + std::to_string(cell.failed) + " of " + std::to_string(cell.rows) : "failed";
}

SurvivalMap make_map(const Results &r, const MapSpec &spec)
{
  SurvivalMap map;
  map.title = spec.title;
  // columns in the order of their levels, whichever case has them
  std::vector<std::vector<int>> keys;
  const auto                    key_of = [&](std::size_t row) {
    std::vector<int> key;
    for (const std::string &axis : spec.columns)
      key.push_back(r.rows[row].levels[static_cast<std::size_t>(r.study.axis_index(axis))]);
    return key;
  };
  for (const std::string &c : spec.cases)
    for (const std::size_t i : rows_of(r, c, spec.only))
      if (std::find(keys.begin(), keys.end(), key_of(i)) == keys.end())
        keys.push_back(key_of(i));
  std::sort(keys.begin(), keys.end());
  map.columns.resize(keys.size());

  for (const std::string &name : spec.cases)
  {
    const Case       &c = *r.study.find_case(name);
    SurvivalMap::Line line{c.title, metric_of(c), c.group, bounds_of(c), source_of(c), {}};
    for (std::size_t k = 0; k < keys.size(); ++k)
    {
      std::vector<std::size_t> mine;
      for (const std::size_t i : rows_of(r, name, spec.only))
        if (key_of(i) == keys[k])
          mine.push_back(i);
      if (!mine.empty())
        map.columns[k] = configuration(r.study, r.rows[mine.front()], spec.columns);
      line.cells.push_back(make_cell(r, c, line.metric, mine));
      if (const std::string *why = why_not(r.study, c, spec.columns, keys[k]))
      {
        line.cells.back().state = State::without_meaning;
        line.cells.back().why   = *why;
      }
    }
    map.lines.push_back(std::move(line));
  }
  return map;
}

std::string markdown(const SurvivalMap &map)
{
  std::vector<std::string> head{"case", "shown", "survives if"};
  for (const auto &titles : map.columns)
    head.push_back(input::join(titles));
  std::string text = "## " + map.title + "\n\n" + markdown_head(head), sources, reasons, meaningless;
  for (const SurvivalMap::Line &l : map.lines)
  {
    std::vector<std::string> cells{(l.group.empty() ? "" : l.group + ": ") + l.title, l.metric.empty() ? "-" : l.metric,
                                   l.bounds};
    for (std::size_t k = 0; k < l.cells.size(); ++k)
    {
      const SurvivalMap::Cell &c     = l.cells[k];
      const std::string        state = c.state == State::failed ? "**" + state_text(c) + "**" : state_text(c);
      cells.push_back(state + (c.metric.empty() ? "" : ", " + c.metric) + (c.detail.empty() ? "" : ", " + c.detail));
      const std::string line = "- " + l.title + ", " + input::join(map.columns[k]) + ": " + c.why + "\n";
      if (c.state == State::failed)
        reasons += line;
      if (c.state == State::without_meaning)
        meaningless += line;
    }
    if (!l.source.empty())
      sources += "- " + l.title + ": " + l.source + "\n";
    text += markdown_line(cells);
  }
  const auto list = [](const char *title, const std::string &lines) {
    return lines.empty() ? "" : std::string("\n") + title + ":\n\n" + lines;
  };
  return text + list("Where the bounds come from", sources) + list("Why they failed", reasons) +
         list("What does not apply", meaningless) + "\n";
}
} // namespace ogive::chart
