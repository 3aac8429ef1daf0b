// SPDX-License-Identifier: LGPL-2.1-or-later
// The picture of a map: heads of columns, headings of groups, cells, legend, and
// notes that say where the bounds come from.
#include "apps/chart/map.h"
#include "apps/chart/svg.h"
#include "apps/chart/text.h"

#include <algorithm>

namespace ogive::chart
{
namespace
{
using State = SurvivalMap::State;
using Lines = std::vector<std::string>;

constexpr double      margin = 20;
constexpr double      big = 16, small = 13; ///< height of a line of 12 and of 10 px letters
constexpr int         lines_to_a_head = 9; ///< at a heading after so many lines the heads stand again
constexpr std::size_t head_width = 14, side_width = 46, bounds_width = 56, cell_width = 16; ///< letters

std::string spoken(std::string name)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// What stands to the left of a line's cells: its title, its bounds below.
struct Side
{
  Lines title, bounds;

  double height() const
  {
    return big * static_cast<double>(title.size()) + small * static_cast<double>(bounds.size());
  }
};

/// With blanks that do not break lines beside the signs.
std::string kept_together(std::string text)
{
  for (const std::string sign : {"≤", "≥"})
    for (std::size_t at = text.find(" " + sign + " "); at != std::string::npos; at = text.find(" " + sign + " ", at))
      text.replace(at, sign.size() + 2, "\u00a0" + sign + "\u00a0");
  return text;
}

Side side_of(const SurvivalMap::Line &l, std::size_t note)
{
  std::string text = kept_together(l.bounds) + (note > 0 ? "\u00a0[" + std::to_string(note) + "]" : "");
  if (!l.metric.empty() && l.bounds.find(l.metric) == std::string::npos)
    text = "shown: " + l.metric + "; " + text;
  return {wrapped(l.title, side_width), wrapped(text, bounds_width)};
}

struct Style
{
  const char *fill, *text;
};

/// Light blue and strong orange differ in brightness too.
Style style_of(State s)
{
  switch (s)
  {
    case State::survived:
      return {"#cfe6f5", ""};
    case State::failed:
      return {"#f2a15f", "font-weight=\"bold\""};
    case State::without_meaning:
      return {"#ededed", "fill=\"#777\" font-style=\"italic\""};
    default:
      return {"#ffffff", "fill=\"#777\""};
  }
}

Lines detail_lines(const SurvivalMap::Cell &c)
{
  return wrapped(spoken(c.detail), cell_width);
}

/// Height of what a cell shows below its state, px.
double below_state(const SurvivalMap::Cell &c)
{
  return (c.metric.empty() ? 0. : 14.) + small * static_cast<double>(detail_lines(c).size());
}

/// Sizes of the picture, and texts broken into lines.
struct Layout
{
  explicit Layout(const SurvivalMap &map)
  {
    for (const SurvivalMap::Line &l : map.lines)
    {
      sides.push_back(side_of(l, note_of(l.source)));
      for (const std::string &part : sides.back().title)
        side = std::max(side, text_width(part) + 16);
      for (const std::string &part : sides.back().bounds)
        side = std::max(side, text_width(part, 10) + 16);
      heights.push_back(std::max(40., sides.back().height() + 8));
      for (const SurvivalMap::Cell &c : l.cells)
      {
        column         = std::max(column, text_width(c.metric, 11) + 10);
        heights.back() = std::max(heights.back(), 12 + big + below_state(c));
      }
    }
    std::size_t most = 1;
    for (const auto &titles : map.columns)
    {
      heads.emplace_back();
      for (const std::string &t : titles)
        for (const std::string &part : wrapped(t, head_width))
        {
          heads.back().push_back(part);
          column = std::max(column, text_width(part, 11) + 8);
        }
      most = std::max(most, heads.back().size());
    }
    head_height = 14 * static_cast<double>(most) + 10;
  }

  double left(std::size_t k) const { return margin + side + column * static_cast<double>(k); }

  double              side = 120, column = 84, head_height = 0;
  Lines               notes; ///< sources, each once
  std::vector<Lines>  heads;
  std::vector<Side>   sides;
  std::vector<double> heights;

private:
  /// From 1; 0 for none.
  std::size_t note_of(const std::string &source)
  {
    if (source.empty())
      return 0;
    auto it = std::find(notes.begin(), notes.end(), source);
    if (it == notes.end())
      it = notes.insert(notes.end(), source);
    return static_cast<std::size_t>(it - notes.begin()) + 1;
  }
};

void draw_cell(Svg &svg, const SurvivalMap::Cell &c, double x, double y, double width, double height)
{
  const Style style  = style_of(c.state);
  svg.rectangle(x + 1, y + 1, width - 2, height - 2, style.fill, "none", c.why);
  const double middle = x + width / 2;
  double       line   = y + height / 2 + 4 - .5 * below_state(c);
  const bool   verdict = c.state == State::survived || c.state == State::failed;
  svg.text(middle, line, state_text(c), Anchor::middle, verdict ? 12 : 10, style.text);
  if (!c.metric.empty())
    svg.text(middle, line += 14, c.metric, Anchor::middle, 11);
  for (const std::string &part : detail_lines(c))
    svg.text(middle, line += small, part, Anchor::middle, 10);
}

double draw_line(Svg &svg, const Layout &layout, const SurvivalMap::Line &l, std::size_t i, double y)
{
  const Side  &side = layout.sides[i];
  const double height = layout.heights[i];
  double       at   = y + .5 * (height - side.height()) + 12;
  for (const std::string &part : side.title)
  {
    svg.text(margin, at, part);
    at += big;
  }
  for (const std::string &part : side.bounds)
  {
    svg.text(margin, at - 2, part, Anchor::start, 10, "fill=\"#555\"");
    at += small;
  }
  for (std::size_t k = 0; k < l.cells.size(); ++k)
    draw_cell(svg, l.cells[k], layout.left(k), y, layout.column, height);
  return y + height;
}

/// Heads of all columns, their last lines in one row. Gives where the cells begin.
double draw_heads(Svg &svg, const Layout &layout, double y)
{
  const double end = y + layout.head_height;
  for (std::size_t k = 0; k < layout.heads.size(); ++k)
    for (std::size_t t = 0; t < layout.heads[k].size(); ++t)
      svg.text(layout.left(k) + layout.column / 2, end - 8 - 14 * static_cast<double>(layout.heads[k].size() - 1 - t),
               layout.heads[k][t], Anchor::middle, 11);
  return end;
}

double draw_legend(Svg &svg, const SurvivalMap &map, double y)
{
  double x = margin;
  for (const auto &[state, says] :
       {std::pair{State::survived, "survived: the run ends and keeps every bound"},
        {State::failed, "failed: it ends early or breaks a bound"},
        {State::without_meaning, "does not apply"},
        {State::left_out, "not run"}})
  {
    const bool there = std::any_of(map.lines.begin(), map.lines.end(), [&, s = state](const SurvivalMap::Line &l) {
      return std::any_of(l.cells.begin(), l.cells.end(), [&](const SurvivalMap::Cell &c) { return c.state == s; });
    });
    if (!there)
      continue;
    svg.rectangle(x, y - 10, 16, 12, style_of(state).fill, "#999");
    svg.text(x + 22, y, says, Anchor::start, 11);
    x += 22 + text_width(says, 11) + 24;
  }
  return y + 20;
}
} // namespace

std::string draw(const SurvivalMap &map)
{
  const Layout layout(map);
  const double width = std::max(800., layout.left(map.columns.size()) + margin);
  Svg          svg;
  svg.text(margin, 28, map.title, Anchor::start, 15, "font-weight=\"bold\"");
  double      y = draw_heads(svg, layout, 44);
  std::string group;
  int         since = 0;
  for (std::size_t i = 0; i < map.lines.size(); ++i, ++since)
  {
    if (map.lines[i].group != group)
    {
      if (since >= lines_to_a_head)
      {
        y     = draw_heads(svg, layout, y + 6);
        since = 0;
      }
      group = map.lines[i].group;
      svg.line(margin, y + 5, layout.left(map.columns.size()), y + 5, "#bbb");
      svg.text(margin, y + 20, group, Anchor::start, 12, "font-weight=\"bold\"");
      y += 26;
    }
    y = draw_line(svg, layout, map.lines[i], i, y);
  }
  y = draw_legend(svg, map, y + 22);
  const auto letters_wide = static_cast<std::size_t>((width - 2 * margin) / text_width("x", 10));
  for (std::size_t n = 0; n < layout.notes.size(); ++n)
    for (const std::string &part : wrapped("[" + std::to_string(n + 1) + "] " + layout.notes[n], letters_wide))
      svg.text(margin, y += small, part, Anchor::start, 10, "fill=\"#555\"");
  return svg.finish(width, y + margin);
}
} // namespace ogive::chart
