// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/svg.h"

#include "apps/chart/text.h"

#include <array>
#include <cstdio>

namespace ogive::chart
{
namespace
{
/// Two decimals, none if they are 0.
std::string px(double v)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.2f", v);
  std::string s = text.data();
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.')
    s.pop_back();
  return s == "-0" ? "0" : s;
}

std::string escaped(const std::string &text)
{
  std::string s;
  for (const char c : text)
    switch (c)
    {
      case '&':
        s += "&amp;";
        break;
      case '<':
        s += "&lt;";
        break;
      case '>':
        s += "&gt;";
        break;
      case '"':
        s += "&quot;";
        break;
      default:
        s += c;
    }
  return s;
}

std::string attribute(const char *name, const std::string &value)
{
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string attribute(const char *name, double value)
{
  return attribute(name, px(value));
}

const char *anchor_name(Anchor a)
{
  return a == Anchor::start ? "start" : a == Anchor::middle ? "middle" : "end";
}

/// Corners about (0, 0), or strokes for crosses.
std::string shape_path(int shape)
{
  switch (shape)
  {
    case 1:
      return "M-4 -4H4V4H-4Z"; // square
    case 2:
      return "M0 -5.2L5 3.8H-5Z"; // triangle up
    case 3:
      return "M0 -5.6L5.6 0L0 5.6L-5.6 0Z"; // diamond
    case 4:
      return "M0 5.2L5 -3.8H-5Z"; // triangle down
    case 5:
      return "M-4 -4L4 4M-4 4L4 -4"; // cross
    case 6:
      return "M-5 0H5M0 -5V5"; // plus
    case 7:
      return "M-4 -4L4 4M-4 4L4 -4M-5.4 0H5.4M0 -5.4V5.4"; // star
    default:
      return "M-4.4 0A4.4 4.4 0 1 0 4.4 0A4.4 4.4 0 1 0 -4.4 0Z"; // circle
  }
}
} // namespace

void Svg::line(double x1, double y1, double x2, double y2, const std::string &c, double width)
{
  body_ += "<line" + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) + attribute("y2", y2) +
           attribute("stroke", c) + attribute("stroke-width", width) + "/>\n";
}

void Svg::rectangle(double x, double y, double width, double height, const std::string &fill, const std::string &stroke,
                    const std::string &tip)
{
  body_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) + attribute("height", height) +
           attribute("fill", fill) + attribute("stroke", stroke);
  body_ += tip.empty() ? "/>\n" : "><title>" + escaped(tip) + "</title></rect>\n";
}

void Svg::text(double x, double y, const std::string &t, Anchor anchor, int size, const std::string &style)
{
  body_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("font-size", size) +
           attribute("text-anchor", anchor_name(anchor)) + (style.empty() ? "" : " " + style) + ">" + escaped(t) +
           "</text>\n";
}

void Svg::upright(double x, double y, const std::string &t, int size)
{
  text(x, y, t, Anchor::middle, size, "transform=\"rotate(-90 " + px(x) + " " + px(y) + ")\"");
}

void Svg::path(const std::vector<std::pair<double, double>> &points, const std::string &c, const std::string &dashes)
{
  if (points.size() < 2)
    return;
  body_ += "<polyline fill=\"none\"" + attribute("stroke", c) + " stroke-width=\"1.6\"" +
           (dashes.empty() ? "" : attribute("stroke-dasharray", dashes)) + " points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    body_ += (i == 0 ? "" : " ") + px(points[i].first) + "," + px(points[i].second);
  body_ += "\"/>\n";
}

void Svg::marker(int shape, double x, double y, const std::string &c, const std::string &tip)
{
  const int  s       = shape % marker_count;
  const bool strokes = s >= 5;
  body_ += "<path" + attribute("d", shape_path(s)) + attribute("transform", "translate(" + px(x) + " " + px(y) + ")") +
           attribute("fill", strokes ? "none" : c) + attribute("stroke", strokes ? c : "white") +
           attribute("stroke-width", strokes ? 1.8 : .8);
  body_ += tip.empty() ? "/>\n" : "><title>" + escaped(tip) + "</title></path>\n";
}

std::string Svg::finish(double width, double height) const
{
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) + attribute("height", height) +
         attribute("viewBox", "0 0 " + px(width) + " " + px(height)) +
         " font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" fill=\"#222\">\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         body_ + "</svg>\n";
}

std::string colour(int i)
{
  constexpr std::array<const char *, colour_count> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                           "#E69F00", "#56B4E9", "#000000"};
  return colours[static_cast<std::size_t>(i % colour_count)];
}

std::string dash(int i)
{
  constexpr std::array<const char *, 4> dashes{"", "6 3", "2 3", "8 3 2 3"};
  return dashes[static_cast<std::size_t>(i) % dashes.size()];
}

double text_width(const std::string &text, int size)
{
  return .55 * size * static_cast<double>(letters(text));
}
} // namespace ogive::chart
