// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/csv.h"

#include "core/io/number_text.h"

#include <algorithm>
#include <cmath>

namespace ogive::chart
{
namespace
{
struct Column
{
  std::string name, unit;
  bool        operator==(const Column &) const = default;
};

std::string number(std::optional<double> v)
{
  return v && std::isfinite(*v) ? io::number_text(*v) : "";
}

std::string line(const std::vector<std::string> &cells)
{
  std::string s;
  for (std::size_t i = 0; i < cells.size(); ++i)
    s += (i == 0 ? "" : ",") + csv_cell(cells[i]);
  return s + "\n";
}

/// A quantity that has another unit in another case has a column for each.
std::vector<Column> quantity_columns(const Results &r)
{
  std::vector<Column> columns;
  for (const Case &c : r.study.cases)
    for (const Measured &m : c.known)
      if (const Column column{m.name, unit_of(c, m.name)};
          m.observed && std::find(columns.begin(), columns.end(), column) == columns.end())
        columns.push_back(column);
  return columns;
}

std::vector<std::string> header(const Results &r, const std::vector<Column> &columns)
{
  std::vector<std::string> h{"case"};
  for (const Axis &a : r.study.axes)
    h.push_back(a.name);
  for (const char *name : {"status", "reason", "wall [s]", "core [s]", "steps", "particles", "elements", "work"})
    h.emplace_back(name);
  for (const std::string &check : check_names())
    h.push_back(check);
  for (const Column &c : columns)
    for (const std::string &name : {c.name + " [" + c.unit + "]", c.name + " reference [" + c.unit + "]",
                                    c.name + " relative error"})
      h.push_back(name);
  return h;
}

std::string count(const Outcome &o, std::int64_t n)
{
  return o.status == Status::done ? std::to_string(n) : "";
}
} // namespace

std::string csv_cell(const std::string &text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string s;
  for (const char c : text)
    s += c == '"' ? std::string("\"\"") : std::string(1, c);
  return "\"" + s + "\"";
}

std::string csv(const Results &r)
{
  const std::vector<Column> columns = quantity_columns(r);
  std::string               text    = line(header(r, columns));
  for (std::size_t i = 0; i < r.rows.size(); ++i)
  {
    const Outcome           &o = r.outcomes[i];
    const Case              &c = r.study.cases[r.rows[i].of_case];
    std::vector<std::string> cells{c.name};
    for (const Axis &a : r.study.axes)
      cells.push_back(level_name(r.study, r.rows[i], a.name));
    for (const std::string &cell :
         {std::string(describe(o.status)), o.reason, number(o.wall_s), number(o.core_s), count(o, o.steps),
          count(o, o.particles), count(o, o.elements), number(o.work())})
      cells.push_back(cell);
    for (const std::string &check : check_names())
      cells.push_back(number(o.check(check)));
    for (const Column &column : columns)
    {
      const Outcome::Quantity *q    = o.find(column.name);
      const bool               mine = q && unit_of(c, column.name) == column.unit;
      cells.push_back(mine ? number(q->value) : "");
      cells.push_back(mine ? number(reference_of(c, o, column.name)) : "");
      cells.push_back(mine ? number(error_of(c, o, column.name)) : "");
    }
    text += line(cells);
  }
  return text;
}
} // namespace ogive::chart
