// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/certificate.h"

#include "apps/chart/plot.h"
#include "core/base/log.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace ogive::apps
{
namespace
{
using Certificate = io::Summary::Certificate;
using Figure      = Certificate::Figure;

/// What numerics cannot tell from nothing; zero has no logarithm.
constexpr double least_drawn = 1e-5;

double smaller_size(const Certificate &c)
{
  return std::min(c.sizes[0], c.sizes[1]);
}

bool is_same_curve(const Figure &a, const Figure &b)
{
  return a.wave == b.wave && a.from == b.from;
}

/// The figures parted by wave and side.
std::vector<std::vector<Figure>> curves_of(const Certificate &c)
{
  std::vector<std::vector<Figure>> curves;
  for (const Figure &f : c.figures)
  {
    if (curves.empty() || !is_same_curve(curves.back().front(), f))
      curves.emplace_back();
    curves.back().push_back(f);
  }
  return curves;
}

std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string sides(const Certificate &c)
{
  return c.bodies[0] + ", " + engineering(c.sizes[0]) + " m | " + c.bodies[1] + ", " + engineering(c.sizes[1]) + " m";
}
} // namespace

std::string certificate_csv(const std::vector<Certificate> &certificates)
{
  std::ostringstream out;
  out.precision(6);
  out << "interface,method,wave,from,wavelength [m],wavelength/size,reflection\n";
  for (const Certificate &c : certificates)
    for (const Figure &f : c.figures)
      out << quoted(c.interface) << ',' << quoted(c.method) << ',' << f.wave << ',' << quoted(f.from) << ','
          << f.wavelength << ',' << f.wavelength / smaller_size(c) << ',' << f.reflection << '\n';
  return out.str();
}

std::string certificate_svg(const std::string &title, const std::vector<Certificate> &certificates)
{
  chart::Plot plot;
  plot.title   = title;
  plot.x_label = "wavelength over the smaller of spacing and edge";
  plot.y_label = "reflected share of the amplitude";
  plot.x_log = plot.y_log = true;
  int colour = 0;
  for (const Certificate &c : certificates)
  {
    int style = 0;
    for (const auto &curve : curves_of(c))
    {
      chart::Plot::Series series;
      series.name   = c.interface + " (" + c.method + "): " + curve.front().wave + " from " + curve.front().from;
      series.colour = colour + style / 2;
      series.dash   = style % 2;
      series.marker = style++;
      for (const Figure &f : curve)
        series.points.push_back({f.wavelength / smaller_size(c), std::max(f.reflection, least_drawn),
                                 series.name + ", " + engineering(f.wavelength) + " m: " + engineering(f.reflection)});
      plot.series.push_back(series);
    }
    colour += (style + 1) / 2;
    plot.notes.push_back(c.interface + ": " + sides(c) + "; limit " + engineering(c.limit) + " at " +
                         engineering(c.wavelength) + " m");
  }
  return chart::draw(plot);
}

void print_certificate(const Certificate &c)
{
  std::printf("  certificate %s (%s): %s\n", c.interface.c_str(), c.method.c_str(), sides(c).c_str());
  std::printf("    reflected share of the amplitude at normal incidence; wavelength over %s m across\n",
              engineering(smaller_size(c)).c_str());
  std::vector<double> wavelengths;
  for (const Figure &f : c.figures)
    if (std::find(wavelengths.begin(), wavelengths.end(), f.wavelength) == wavelengths.end())
      wavelengths.push_back(f.wavelength);
  std::sort(wavelengths.begin(), wavelengths.end());
  std::printf("    %-32s", "");
  for (const double w : wavelengths)
    std::printf(" %8.4g", w / smaller_size(c));
  std::printf("\n");
  for (const auto &curve : curves_of(c))
  {
    std::printf("    %-32s", (curve.front().wave + " from " + curve.front().from).c_str());
    for (const double w : wavelengths)
    {
      const auto found = std::find_if(curve.begin(), curve.end(), [&](const Figure &f) { return f.wavelength == w; });
      if (found == curve.end())
        std::printf(" %8s", "-");
      else
        std::printf(" %8.5f", found->reflection);
    }
    std::printf("\n");
  }
  std::printf("    at %s m: %.5f, the interface allows %g%s\n", engineering(c.wavelength).c_str(), c.worst, c.limit,
              c.worst > c.limit ? ": TOO MUCH" : "");
}
} // namespace ogive::apps
