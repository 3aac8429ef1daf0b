// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace ogive::chart
{
/// A picture of curves, ready to be drawn.
struct Plot
{
  struct Point
  {
    double      x = 0, y = 0;
    std::string tip; ///< shows under the mouse
  };
  struct Series
  {
    std::string        name;
    std::vector<Point> points;
    int                colour = 0, marker = 0, dash = 0;
    bool               line = true; ///< joins the points in their order
  };
  std::string              title, subtitle, x_label, y_label;
  bool                     x_log = false, y_log = false;
  std::vector<Series>      series;
  std::vector<std::string> notes; ///< below the picture: what is not shown, and why
};

/// SVG text, 800 px wide. The legend stands below the picture, never over it.
/// @param plot all numbers finite, on a logarithmic axis positive
std::string draw(const Plot &plot);
} // namespace ogive::chart
