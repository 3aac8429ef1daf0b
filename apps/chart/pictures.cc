// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/pictures.h"

#include "apps/chart/svg.h"
#include "apps/chart/text.h"
#include "core/input/listing.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace ogive::chart
{
namespace
{
using Kind = Measure::Kind;

/// A point before it is known how numbers are best shown.
struct Raw
{
  std::optional<double>    x, y;
  std::vector<std::size_t> rows; ///< that it stands for
};

std::optional<double> mean_of(const Results &r, const std::vector<std::size_t> &rows, const Measure &m)
{
  double sum = 0;
  for (const std::size_t i : rows)
  {
    const std::optional<double> v = measure(r, i, m);
    if (!v)
      return {};
    sum += *v;
  }
  return sum / static_cast<double>(rows.size());
}

std::vector<Raw> raw_points(const Results &r, const ChartSpec &chart, const std::vector<std::size_t> &rows)
{
  std::vector<Raw> points;
  if (chart.y.kind == Kind::spread)
    for (const auto &group : groups_along(r, rows, chart.y.over))
      points.push_back({mean_of(r, group, chart.x), spread_of(r, group, chart.y.name).value(), group});
  else
    for (const std::size_t i : rows)
      points.push_back({measure(r, i, chart.x), measure(r, i, chart.y), {i}});
  return points;
}

std::string axis_title(const Study &s, const std::string &axis)
{
  const Axis &a = s.axes[static_cast<std::size_t>(s.axis_index(axis))];
  return a.unit.empty() ? a.title : a.title + " (" + a.unit + ")";
}

std::string unit_of(const Case &c, const Measure &m)
{
  switch (m.kind)
  {
    case Kind::core_seconds:
    case Kind::wall_seconds:
      return "s";
    case Kind::value:
    case Kind::size:
    case Kind::spread:
      return unit_of(c, m.name);
    default:
      return "1";
  }
}

std::string plain_label(const Study &s, const Measure &m)
{
  switch (m.kind)
  {
    case Kind::axis_number:
      return axis_title(s, m.name);
    case Kind::core_seconds:
      return "core time";
    case Kind::wall_seconds:
      return "wall time";
    case Kind::work:
      return "work: particle-steps and element-steps";
    case Kind::value:
      return m.name;
    case Kind::size:
      return "size of " + m.name;
    case Kind::error:
      return "size of the relative error of " + m.name;
    case Kind::spread:
      return "spread of " + m.name + " over " + s.axes[static_cast<std::size_t>(s.axis_index(m.over))].title;
  }
  return m.text;
}

/// Factor and label of one axis of the picture.
struct Shown
{
  double      factor = 1;
  std::string label;
};

Shown show_axis(const Study &s, const Case &c, const Measure &m, bool log, const std::vector<Raw> &points,
                std::optional<double> Raw::*member)
{
  Shown shown{1, plain_label(s, m)};
  if (m.kind == Kind::error)
    return {100, shown.label + " (%)"};
  if (m.kind == Kind::axis_number)
    return shown;
  double greatest = 0;
  for (const Raw &p : points)
    if (p.*member)
      greatest = std::max(greatest, std::abs(*(p.*member)));
  // a logarithmic axis has powers of ten at its ticks already; lengths and times
  // read better with a prefix all the same
  const std::string unit = unit_of(c, m);
  ShownUnit         u    = shown_unit(greatest, unit);
  const bool        seconds = m.kind == Kind::core_seconds || m.kind == Kind::wall_seconds;
  if (seconds || (log && u.unit.starts_with("10")))
    u = {1, unit == "1" ? "" : unit};
  shown.factor = u.factor;
  if (!u.unit.empty())
    shown.label += " (" + u.unit + ")";
  return shown;
}

/// Names of rows behind each reason why they are not shown.
class Missing
{
public:
  void add(const std::string &why, const std::string &row) { rows_[why].push_back(row); }

  std::vector<std::string> notes() const
  {
    constexpr std::size_t    named = 3;
    std::vector<std::string> notes;
    for (const auto &[why, rows] : rows_)
    {
      std::string note = "Not shown, " + why + ": ";
      for (std::size_t i = 0; i < std::min(named, rows.size()); ++i)
        note += (i == 0 ? "" : ", ") + rows[i];
      if (rows.size() > named)
        note += " and " + std::to_string(rows.size() - named) + " more";
      notes.push_back(note);
    }
    return notes;
  }

private:
  std::map<std::string, std::vector<std::string>> rows_;
};

std::string why_missing(const Results &r, const Raw &p, const ChartSpec &chart)
{
  for (const std::size_t i : p.rows)
    if (r.outcomes[i].status != Status::done)
      return describe(r.outcomes[i].status);
  if (chart.y.kind == Kind::spread && p.rows.size() < 2)
    return "a spread of one row";
  if (!p.x || !std::isfinite(*p.x))
    return "no value of \"" + chart.x.text + "\"";
  if (!p.y || !std::isfinite(*p.y))
    return "no value of \"" + chart.y.text + "\"";
  if ((chart.x_log && *p.x <= 0) || (chart.y_log && *p.y <= 0))
    return "not positive on a logarithmic axis";
  return {};
}

std::string names_of_rows(const Results &r, const std::vector<std::size_t> &rows)
{
  return r.rows[rows.front()].name + (rows.size() > 1 ? " and the rest of its group" : "");
}

/// With two axes, colours go by the first and shapes by the second; else each
/// series has its own of both.
void style(Plot::Series &series, const Results &r, std::size_t row, const std::vector<std::string> &axes, int index)
{
  series.colour = series.marker = index;
  series.dash                   = index / colour_count;
  if (axes.size() != 2)
    return;
  const auto level = [&](const std::string &a) {
    return std::max(0, r.rows[row].levels[static_cast<std::size_t>(r.study.axis_index(a))]);
  };
  series.colour = level(axes[0]);
  series.marker = level(axes[1]);
  series.dash   = level(axes[1]);
}
} // namespace

std::vector<std::string> level_titles(const Study &s, const Row &row, const std::vector<std::string> &axes)
{
  std::vector<std::string> titles;
  for (const std::string &axis : axes)
  {
    const auto a = static_cast<std::size_t>(s.axis_index(axis));
    const int  l = row.levels[a];
    titles.push_back(l < 0 ? "-" : s.axes[a].levels[static_cast<std::size_t>(l)].title);
  }
  return titles;
}

std::vector<std::string> configuration(const Study &s, const Row &row, const std::vector<std::string> &axes)
{
  std::vector<std::string> titles = level_titles(s, row, axes);
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const std::string &axis = s.axes[static_cast<std::size_t>(s.axis_index(axes[i]))].title;
    if (level_name(s, row, axes[i]).empty())
      titles[i] = axis + " as in the scene";
    else if (std::isdigit(static_cast<unsigned char>(titles[i].back())) &&
             titles[i].find_first_not_of("+-.0123456789eE") == std::string::npos)
      titles[i] = axis + " " + titles[i];
  }
  return titles;
}

namespace
{
/// A curve in the making.
struct Curve
{
  std::vector<std::string> key; ///< levels of the axes that tell the curves apart
  Plot::Series             series;
  std::vector<Raw>         points;
};

/// Curves keep their style even where their points are missing.
std::vector<Curve> make_curves(const Results &r, const std::vector<std::size_t> &rows, const std::vector<Raw> &points,
                               const std::vector<std::string> &axes)
{
  std::vector<Curve> curves;
  const auto         find = [&](const std::vector<std::string> &key) {
    return std::find_if(curves.begin(), curves.end(), [&](const Curve &c) { return c.key == key; });
  };
  for (const std::size_t i : rows)
    if (const auto key = level_names(r.study, r.rows[i], axes); find(key) == curves.end())
    {
      Curve &c      = curves.emplace_back();
      c.key         = key;
      c.series.name = input::join(configuration(r.study, r.rows[i], axes));
      style(c.series, r, i, axes, static_cast<int>(curves.size()) - 1);
    }
  for (const Raw &p : points)
    find(level_names(r.study, r.rows[p.rows.front()], axes))->points.push_back(p);
  return curves;
}

/// Gives the curve its points as they are shown.
void place_points(Curve &c, const Results &r, const Shown &x, const Shown &y, bool in_order_of_x)
{
  if (in_order_of_x)
    std::stable_sort(c.points.begin(), c.points.end(), [](const Raw &a, const Raw &b) { return *a.x < *b.x; });
  std::vector<std::size_t> rows;
  for (const Raw &p : c.points)
  {
    rows.push_back(p.rows.front());
    c.series.points.push_back({*p.x * x.factor, *p.y * y.factor, r.rows[p.rows.front()].name});
  }
  // a line says that the points differ in one thing alone
  c.series.line = varied_axes(r, rows).size() <= 1;
}
} // namespace

Plot make_plot(const Results &r, const ChartSpec &chart, const std::string &case_name)
{
  const Case                    &c    = *r.study.find_case(case_name);
  const std::vector<std::size_t> rows = rows_of(r, case_name, chart.only);
  std::vector<Raw>               raw  = raw_points(r, chart, rows);
  Missing                        missing;
  std::erase_if(raw, [&](const Raw &p) {
    const std::string why = why_missing(r, p, chart);
    if (!why.empty())
      missing.add(why, names_of_rows(r, p.rows));
    return !why.empty();
  });

  Plot plot;
  plot.title    = chart.title;
  plot.subtitle = c.title;
  plot.x_log    = chart.x_log;
  plot.y_log    = chart.y_log;
  plot.notes    = missing.notes();
  const Shown x = show_axis(r.study, c, chart.x, chart.x_log, raw, &Raw::x);
  const Shown y = show_axis(r.study, c, chart.y, chart.y_log, raw, &Raw::y);
  plot.x_label  = x.label;
  plot.y_label  = y.label;

  std::vector<std::string> axes = varied_axes(r, rows);
  std::erase_if(axes, [&](const std::string &a) {
    return std::find(chart.series.begin(), chart.series.end(), a) == chart.series.end();
  });
  // in the order of the chart, which decides what colours and markers tell
  std::sort(axes.begin(), axes.end(), [&](const std::string &a, const std::string &b) {
    return std::find(chart.series.begin(), chart.series.end(), a) < std::find(chart.series.begin(), chart.series.end(), b);
  });
  for (Curve &curve : make_curves(r, rows, raw, axes))
  {
    place_points(curve, r, x, y, chart.x.kind == Kind::axis_number);
    plot.series.push_back(std::move(curve.series));
  }
  return plot;
}
} // namespace ogive::chart
