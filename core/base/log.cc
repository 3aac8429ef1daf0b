// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace ogive
{
namespace
{
constexpr double seconds_between_lines = .2;

std::string formatted(const char *format, double value)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string duration(double seconds)
{
  if (!std::isfinite(seconds) || seconds > 1e8)
    return "?";
  const auto           s = static_cast<long>(std::ceil(seconds));
  std::array<char, 64> text;
  if (s >= 3600)
    std::snprintf(text.data(), text.size(), "%ld h %02ld min", s / 3600, s / 60 % 60);
  else if (s >= 60)
    std::snprintf(text.data(), text.size(), "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(text.data(), text.size(), "%ld s", s);
  return text.data();
}
} // namespace

std::string engineering(double value)
{
  return formatted("%.4g", value);
}

std::string describe(const Culprit &c, std::span<const std::string> bodies)
{
  std::string text = *c.entity ? c.entity : "an unnamed entity";
  if (c.id >= 0)
    text += " " + std::to_string(c.id);
  if (c.body >= 0)
    {
      const auto i = static_cast<std::size_t>(c.body);
      text += " of body " + (i < bodies.size() ? '"' + bodies[i] + '"' : std::to_string(i));
    }
  text += " at (" + engineering(c.where[0]) + ", " + engineering(c.where[1]) + ", " +
          engineering(c.where[2]) + ") m";
  if (*c.why)
    text += std::string(": ") + c.why;
  return text;
}

Log::Log()
  : Log(std::cerr, isatty(STDERR_FILENO) == 1)
{}

Log::Log(std::ostream &out, bool terminal)
  : out_(&out)
  , terminal_(terminal)
{}

void Log::progress(const Progress &p)
{
  const bool last = p.time >= p.end_time;
  if (!terminal_ || (shown_ >= 0 && p.wall - shown_ < seconds_between_lines && !last))
    return;
  shown_ = p.wall;

  const double done = p.time - p.start_time;
  const double left = done > 0 ? p.wall * (p.end_time - p.time) / done : HUGE_VAL;
  std::string  line = formatted("%5.1f %%", 100 * p.time / p.end_time) + "  time " +
                     engineering(p.time) + " s  step " + std::to_string(p.step) + "  energy " +
                     formatted("%+.2g %%", 100 * p.energy_drift) + "  left " + duration(left);
  if (!p.limiter.empty())
    line += "  limiter " + p.limiter;
  // Carriage return, text, erase to the end of the line.
  *out_ << '\r' << line << "\x1b[K" << std::flush;
  line_open_ = true;
}

void Log::warn(const std::string &text)
{
  if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end())
    return;
  finish();
  warnings_.push_back(text);
  *out_ << "warning: " << text << std::endl;
}

void Log::note(const std::string &text)
{
  finish();
  *out_ << text << std::endl;
}

void Log::finish()
{
  if (line_open_)
    *out_ << std::endl;
  line_open_ = false;
}
} // namespace ogive
