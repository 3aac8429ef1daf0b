// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/map.h"

#include "apps/chart/pictures.h"
#include "apps/chart/svg.h"
#include "apps/chart/text.h"
#include "core/input/listing.h"

#include <algorithm>

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

SurvivalMap::Cell make_cell(const Results &r, const Case &c, const std::string &metric,
                            const std::vector<std::size_t> &rows)
{
  SurvivalMap::Cell cell;
  for (const std::size_t i : rows)
  {
    const Verdict verdict = judge(c, r.outcomes[i]);
    ++cell.rows;
    if (!verdict.survived && cell.failed++ == 0)
      cell.why = verdict.why;
  }
  if (cell.rows > 0)
    cell.state = cell.failed > 0 ? State::failed : State::survived;
  const Spread s = spread_of(r, rows, metric);
  if (!metric.empty() && s.least)
  {
    const std::string unit = unit_of(c, metric);
    cell.metric = *s.least < *s.greatest ? shown_range(*s.least, *s.greatest, unit) : shown(*s.least, unit);
  }
  return cell;
}

std::string state_text(const SurvivalMap::Cell &cell)
{
  if (cell.state == State::left_out)
    return "not run";
  if (cell.state == State::survived)
    return "survived";
  return cell.rows > 1 ? "failed " + std::to_string(cell.failed) + " of " + std::to_string(cell.rows) : "failed";
}
} // namespace

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
    SurvivalMap::Line line{c.title, metric_of(c), {}};
    for (std::size_t k = 0; k < keys.size(); ++k)
    {
      std::vector<std::size_t> mine;
      for (const std::size_t i : rows_of(r, name, spec.only))
        if (key_of(i) == keys[k])
          mine.push_back(i);
      if (!mine.empty())
        map.columns[k] = configuration(r.study, r.rows[mine.front()], spec.columns);
      line.cells.push_back(make_cell(r, c, line.metric, mine));
    }
    map.lines.push_back(std::move(line));
  }
  return map;
}

namespace
{
constexpr double      margin = 20, cell_height = 44;
constexpr std::size_t head_width = 17, side_width = 34; ///< letters

/// Sizes of the picture, and the heads of its columns line by line.
struct Layout
{
  explicit Layout(const SurvivalMap &map)
  {
    for (const SurvivalMap::Line &l : map.lines)
    {
      for (const std::string &part : wrapped(l.title, side_width))
        side = std::max(side, text_width(part) + 16);
      side = std::max(side, text_width(l.metric, 11) + 16);
      for (const SurvivalMap::Cell &c : l.cells)
        column = std::max(column, text_width(c.metric, 11) + 12);
    }
    std::size_t most = 1;
    for (const auto &titles : map.columns)
    {
      heads.emplace_back();
      for (const std::string &t : titles)
        for (const std::string &part : wrapped(t, head_width))
        {
          heads.back().push_back(part);
          column = std::max(column, text_width(part) + 10);
        }
      most = std::max(most, heads.back().size());
    }
    top = 54 + 16 * static_cast<double>(most);
  }

  double left(std::size_t k) const { return margin + side + column * static_cast<double>(k); }

  double                                side = 120, column = 96, top = 0;
  std::vector<std::vector<std::string>> heads;
};

void draw_cell(Svg &svg, const SurvivalMap::Cell &c, double x, double y, double width, double height)
{
  // light blue and strong orange differ in brightness too
  const char *fill = c.state == State::survived ? "#cfe6f5" : c.state == State::failed ? "#f2a15f" : "#f4f4f4";
  const char *text = c.state == State::failed ? "font-weight=\"bold\"" : c.state == State::left_out ? "fill=\"#777\"" : "";
  svg.rectangle(x + 1, y + 1, width - 2, height - 2, fill);
  svg.text(x + width / 2, y + height / 2 + (c.metric.empty() ? 4 : -3), state_text(c), Anchor::middle, 12, text);
  if (!c.metric.empty())
    svg.text(x + width / 2, y + height / 2 + 13, c.metric, Anchor::middle, 11);
}
} // namespace

std::string draw(const SurvivalMap &map)
{
  const Layout layout(map);
  Svg          svg;
  svg.text(margin, 28, map.title, Anchor::start, 15, "font-weight=\"bold\"");
  for (std::size_t k = 0; k < layout.heads.size(); ++k)
    for (std::size_t t = 0; t < layout.heads[k].size(); ++t)
      svg.text(layout.left(k) + layout.column / 2,
               layout.top - 8 - 16 * static_cast<double>(layout.heads[k].size() - 1 - t), layout.heads[k][t],
               Anchor::middle);
  double y = layout.top;
  for (const SurvivalMap::Line &l : map.lines)
  {
    const auto   title  = wrapped(l.title, side_width);
    const double lines  = static_cast<double>(title.size() + !l.metric.empty());
    const double height = std::max(cell_height, 16 * lines + 10);
    for (std::size_t t = 0; t < title.size(); ++t)
      svg.text(margin, y + 17 + 15 * static_cast<double>(t), title[t]);
    if (!l.metric.empty())
      svg.text(margin, y + 17 + 15 * static_cast<double>(title.size()), l.metric, Anchor::start, 11, "fill=\"#555\"");
    for (std::size_t k = 0; k < l.cells.size(); ++k)
      draw_cell(svg, l.cells[k], layout.left(k), y, layout.column, height);
    y += height;
  }
  return svg.finish(std::max(800., layout.left(map.columns.size()) + margin), y + margin);
}

std::string markdown(const SurvivalMap &map)
{
  std::vector<std::string> head{"case", "shown"};
  for (const auto &titles : map.columns)
    head.push_back(input::join(titles));
  std::string text = "## " + map.title + "\n\n" + markdown_head(head), reasons;
  for (const SurvivalMap::Line &l : map.lines)
  {
    std::vector<std::string> cells{l.title, l.metric.empty() ? "-" : l.metric};
    for (std::size_t k = 0; k < l.cells.size(); ++k)
    {
      const SurvivalMap::Cell &c = l.cells[k];
      const std::string        state = c.state == State::failed ? "**" + state_text(c) + "**" : state_text(c);
      cells.push_back(state + (c.metric.empty() ? "" : ", " + c.metric));
      if (c.state == State::failed)
        reasons += "- " + l.title + ", " + input::join(map.columns[k]) + ": " + c.why + "\n";
    }
    text += markdown_line(cells);
  }
  return text + (reasons.empty() ? "" : "\nWhy they failed:\n\n" + reasons) + "\n";
}
} // namespace ogive::chart
