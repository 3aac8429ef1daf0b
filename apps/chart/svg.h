// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ogive::chart
{
/// Where a text stands against its point.
enum class Anchor
{
  start,
  middle,
  end
};

/// A picture as SVG text, in pixels, y downwards, on white.
class Svg
{
public:
  void line(double x1, double y1, double x2, double y2, const std::string &colour, double width = 1);
  void rectangle(double x, double y, double width, double height, const std::string &fill,
                 const std::string &stroke = "none", const std::string &tip = {});
  void text(double x, double y, const std::string &, Anchor = Anchor::start, int size = 12,
            const std::string &style = {});
  /// Runs upwards.
  void upright(double x, double y, const std::string &, int size = 12);
  void path(const std::vector<std::pair<double, double>> &, const std::string &colour, const std::string &dash = {});
  /// One of marker_count shapes; `tip` shows under the mouse.
  void marker(int shape, double x, double y, const std::string &colour, const std::string &tip = {});

  std::string finish(double width, double height) const;

private:
  std::string body_;
};

inline constexpr int marker_count = 8, colour_count = 7;

/// Colours that the colour-blind tell apart too (Okabe and Ito, without their yellow).
std::string colour(int);
std::string dash(int);

/// About how wide a text is, px.
double text_width(const std::string &, int size = 12);
} // namespace ogive::chart
