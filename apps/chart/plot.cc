// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/plot.h"

#include "apps/chart/scale.h"
#include "apps/chart/svg.h"
#include "apps/chart/text.h"

#include <algorithm>
#include <cmath>

namespace ogive::chart
{
namespace
{
constexpr double      width = 800, left = 86, right = 24, plot_height = 380;
constexpr double      inset = 10; ///< keeps markers off the frame
constexpr const char *grey = "#444", *light = "#e2e2e2";

Scale scale_of(const Plot &plot, double Plot::Point::*member, bool log)
{
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const Plot::Series &s : plot.series)
    for (const Plot::Point &p : s.points)
    {
      least    = std::min(least, p.*member);
      greatest = std::max(greatest, p.*member);
    }
  if (least > greatest)
    least = log ? 1 : 0, greatest = log ? 10 : 1;
  return log ? log_scale(least, greatest) : linear_scale(least, greatest);
}

class Frame
{
public:
  Frame(const Plot &plot, double top)
    : top_(top)
    , x_(scale_of(plot, &Plot::Point::x, plot.x_log))
    , y_(scale_of(plot, &Plot::Point::y, plot.y_log))
  {}

  double x(double v) const { return left + inset + x_.at(v) * (width - left - right - 2 * inset); }
  double y(double v) const { return top_ + inset + (1 - y_.at(v)) * (plot_height - 2 * inset); }

  void draw(Svg &svg, const Plot &plot) const
  {
    const double bottom = top_ + plot_height;
    double       free   = -HUGE_VAL; // where the last label ended
    for (const Tick &t : x_.ticks)
    {
      const double at = x(t.value), half = text_width(t.label) / 2;
      svg.line(at, top_, at, bottom, t.label.empty() ? "#f0f0f0" : light);
      svg.line(at, bottom, at, bottom + (t.label.empty() ? 3 : 6), grey);
      if (t.label.empty() || at - half < free)
        continue;
      svg.text(at, bottom + 20, t.label, Anchor::middle);
      free = at + half + 6;
    }
    for (const Tick &t : y_.ticks)
    {
      const double at = y(t.value);
      svg.line(left, at, width - right, at, t.label.empty() ? "#f0f0f0" : light);
      svg.line(left - (t.label.empty() ? 3 : 6), at, left, at, grey);
      svg.text(left - 9, at + 4, t.label, Anchor::end);
    }
    svg.line(left, top_, left, bottom, grey);
    svg.line(left, bottom, width - right, bottom, grey);
    svg.text((left + width - right) / 2, bottom + 42, plot.x_label, Anchor::middle, 13);
    svg.upright(20, top_ + plot_height / 2, plot.y_label, 13);
  }

private:
  double top_;
  Scale  x_, y_;
};

void draw_series(Svg &svg, const Frame &frame, const Plot::Series &s)
{
  std::vector<std::pair<double, double>> points;
  for (const Plot::Point &p : s.points)
    points.emplace_back(frame.x(p.x), frame.y(p.y));
  if (s.line)
    svg.path(points, colour(s.colour), dash(s.dash));
  for (std::size_t i = 0; i < points.size(); ++i)
    svg.marker(s.marker, points[i].first, points[i].second, colour(s.colour), s.points[i].tip);
}

/// In columns of the widest name; gives where it ends.
double draw_legend(Svg &svg, const Plot &plot, double top)
{
  constexpr double key = 42, row = 20;
  double           widest = 0;
  std::size_t      named  = 0;
  for (const Plot::Series &s : plot.series)
  {
    widest = std::max(widest, text_width(s.name));
    named += !s.name.empty();
  }
  if (named == 0)
    return top;
  const double column  = widest + key + 18;
  const auto   columns = static_cast<std::size_t>(std::max(1., std::floor((width - left - right) / column)));
  const auto   rows    = (plot.series.size() + columns - 1) / columns;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
  {
    const Plot::Series &s = plot.series[i];
    const double        x = left + column * static_cast<double>(i / rows);
    const double        y = top + row * static_cast<double>(i % rows);
    if (s.line)
      svg.path({{x, y}, {x + key - 10, y}}, colour(s.colour), dash(s.dash));
    svg.marker(s.marker, x + (key - 10) / 2, y, colour(s.colour));
    svg.text(x + key, y + 4, s.name);
  }
  return top + row * static_cast<double>(rows);
}
} // namespace

std::string draw(const Plot &plot)
{
  Svg    svg;
  double top = 10;
  for (const std::string &line : wrapped(plot.title, 80))
    svg.text(left, top += 18, line, Anchor::start, 15, "font-weight=\"bold\"");
  for (const std::string &line : wrapped(plot.subtitle, 100))
    svg.text(left, top += 17, line, Anchor::start, 12, "fill=\"#555\"");
  top += 18;

  const Frame frame(plot, top);
  frame.draw(svg, plot);
  bool any = false;
  for (const Plot::Series &s : plot.series)
  {
    draw_series(svg, frame, s);
    any = any || !s.points.empty();
  }
  if (!any)
    svg.text((left + width - right) / 2, top + plot_height / 2, "nothing to show", Anchor::middle, 15);

  double y = draw_legend(svg, plot, top + plot_height + 68) + 8;
  for (const std::string &note : plot.notes)
    for (const std::string &line : wrapped(note, 108))
    {
      svg.text(left, y, line, Anchor::start, 11, "fill=\"#555\"");
      y += 15;
    }
  return svg.finish(width, y + 6);
}
} // namespace ogive::chart
