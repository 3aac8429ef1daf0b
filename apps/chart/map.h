// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/measures.h"

#include <string>
#include <vector>

namespace ogive::chart
{
/// What survives: a line a case, a column a configuration.
struct SurvivalMap
{
  enum class State
  {
    left_out,
    survived,
    failed
  };
  struct Cell
  {
    State       state = State::left_out;
    std::string metric; ///< value, or the range of several rows
    std::string why;    ///< of the first row that failed
    std::size_t rows = 0, failed = 0;
  };
  struct Line
  {
    std::string       title, metric; ///< metric: what its cells show
    std::vector<Cell> cells;
  };
  std::string                           title;
  std::vector<std::vector<std::string>> columns; ///< titles of the levels
  std::vector<Line>                     lines;
};

/// A cell that stands for several rows has failed if one of them has.
SurvivalMap make_map(const Results &, const MapSpec &);

std::string draw(const SurvivalMap &);     ///< SVG text
std::string markdown(const SurvivalMap &); ///< a table, and the reasons below
} // namespace ogive::chart
