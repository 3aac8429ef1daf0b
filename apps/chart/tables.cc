// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/tables.h"

#include "apps/chart/map.h"
#include "apps/chart/pictures.h"
#include "apps/chart/text.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace ogive::chart
{
namespace
{
std::string figure(std::optional<double> v, const char *format)
{
  if (!v)
    return "-";
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, *v);
  return text.data();
}

/// "21.42 mm (-0.13 %)".
std::string value_cell(const Case &c, const Outcome &o, const std::string &quantity)
{
  const std::optional<double> value = value_of(o, quantity), error = error_of(c, o, quantity);
  if (!value)
    return "-";
  return shown(*value, unit_of(c, quantity)) + (error ? " (" + percent(*error) + ")" : "");
}

std::string axis_title(const Study &s, const std::string &axis)
{
  return s.axes[static_cast<std::size_t>(s.axis_index(axis))].title;
}

std::string references(const Results &r, const Case &c, const std::vector<std::size_t> &rows)
{
  std::string text;
  for (const Judged &q : c.quantities)
    for (const std::size_t i : rows)
    {
      const Outcome &o         = r.outcomes[i];
      const auto     reference = reference_of(c, o, q.name);
      if (o.status != Status::done || !reference)
        continue;
      const Outcome::Quantity *of_scene = q.kind.empty() ? o.find(q.name) : nullptr;
      text += "- " + q.name + ": reference " + shown(*reference, unit_of(c, q.name)) + ", " +
              (of_scene ? of_scene->kind + ": " + of_scene->source : q.kind + ": " + q.source) + "\n";
      break;
    }
  return text.empty() ? "" : text + "\n";
}

std::string case_table(const Results &r, const Case &c, const std::vector<std::size_t> &rows)
{
  const std::vector<std::string> axes = varied_axes(r, rows);
  std::vector<std::string>       head;
  for (const std::string &a : axes)
    head.push_back(axis_title(r.study, a));
  head.emplace_back("status");
  for (const Judged &q : c.quantities)
    head.push_back(q.name);
  for (const char *name : {"energy drift", "work", "core-s"})
    head.emplace_back(name);

  std::string text = markdown_head(head);
  for (const std::size_t i : rows)
  {
    const Outcome           &o     = r.outcomes[i];
    std::vector<std::string> cells = level_titles(r.study, r.rows[i], axes);
    cells.push_back(o.reason.empty() ? describe(o.status) : std::string(describe(o.status)) + ": " + o.reason);
    for (const Judged &q : c.quantities)
      cells.push_back(value_cell(c, o, q.name));
    cells.push_back(figure(o.check("energy_drift"), "%.1e"));
    cells.push_back(figure(o.work(), "%.3g"));
    cells.push_back(figure(o.core_s, "%.3g"));
    text += markdown_line(cells);
  }
  return text + "\n";
}

std::string spread_table(const Results &r, const Case &c, const std::vector<std::size_t> &rows, const std::string &over)
{
  std::vector<std::string> axes = varied_axes(r, rows);
  if (std::find(axes.begin(), axes.end(), over) == axes.end())
    return {};
  std::erase(axes, over);
  std::vector<std::string> head;
  for (const std::string &a : axes)
    head.push_back(axis_title(r.study, a));
  head.emplace_back("rows");
  for (const Judged &q : c.quantities)
    head.push_back("spread of " + q.name);
  std::string text = "Spread (greatest less least) over " + axis_title(r.study, over) + ":\n\n" + markdown_head(head);
  for (const auto &group : groups_along(r, rows, over))
  {
    if (group.size() < 2)
      continue; // nothing varies
    std::vector<std::string> cells = level_titles(r.study, r.rows[group.front()], axes);
    cells.push_back(std::to_string(group.size()));
    for (const Judged &q : c.quantities)
    {
      const Spread s = spread_of(r, group, q.name);
      cells.push_back(s.value() ? shown(*s.value(), unit_of(c, q.name)) :
                                  "- (" + std::to_string(s.with_value) + " of " + std::to_string(s.rows) + " have a value)");
    }
    text += markdown_line(cells);
  }
  return text + "\n";
}
} // namespace

std::string tables(const Results &r)
{
  std::string text = "# " + r.study.title + "\n\n";
  for (const Case &c : r.study.cases)
  {
    const std::vector<std::size_t> rows = rows_of(r, c.name);
    text += "## " + c.title + "\n\n" + references(r, c, rows) + case_table(r, c, rows);
    for (const std::string &over : r.study.spreads)
      text += spread_table(r, c, rows, over);
  }
  for (const MapSpec &m : r.study.maps)
    text += markdown(make_map(r, m));
  return text;
}
} // namespace ogive::chart
