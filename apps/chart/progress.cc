// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/progress.h"

#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace ogive::chart
{
std::string rough_duration(double seconds)
{
  char       text[48];
  const long s = std::lround(std::ceil(seconds));
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s / 60 % 60);
  else if (s >= 120)
    std::snprintf(text, sizeof text, "%ld min", (s + 59) / 60);
  else
    std::snprintf(text, sizeof text, "%ld s", s);
  return text;
}

Progress::Progress(std::string verb, std::size_t rows, double work)
  : verb_(std::move(verb))
  , rows_(rows)
  , work_(work > 0 ? work : static_cast<double>(rows))
  , start_(std::chrono::steady_clock::now())
  , terminal_(::isatty(STDERR_FILENO) == 1)
{}

Progress::~Progress()
{
  if (open_)
    std::fputs("\r\x1b[K", stderr);
}

void Progress::ended(double work)
{
  ++through_;
  done_ += work;
}

void Progress::show(std::size_t running)
{
  if (!terminal_)
    return;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string  left = "?";
  if (done_ > 0)
    left = rough_duration(wall * (work_ - done_) / done_);
  std::fprintf(stderr, "\r%zu of %zu rows %s, %zu at work, left %s\x1b[K", through_, rows_, verb_.c_str(), running,
               left.c_str());
  open_ = true;
}
} // namespace ogive::chart
