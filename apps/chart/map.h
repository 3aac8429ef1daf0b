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
    left_out,      ///< by the study, without a word
    without_meaning, ///< the case says that the configuration does not apply
    survived,
    failed
  };
  struct Cell
  {
    State       state = State::left_out;
    std::string metric; ///< value, or the range of several rows
    std::string detail; ///< what failed where the metric does not show it
    std::string why;    ///< of the first row that failed, or why it does not apply
    std::size_t rows = 0, failed = 0;
  };
  struct Line
  {
    std::string       title, metric; ///< metric: what its cells show
    std::string       group;         ///< heading of this line and those around it that have the same
    std::string       bounds;        ///< what a survivor keeps: "fragments ≤ 1, smallest_distance ≥ 0.7"
    std::string       source;        ///< of the bounds; empty if the study does not say
    std::vector<Cell> cells;
  };
  std::string                           title;
  std::vector<std::vector<std::string>> columns; ///< titles of the levels
  std::vector<Line>                     lines;
};

/// A cell that stands for several rows has failed if one of them has.
SurvivalMap make_map(const Results &, const MapSpec &);

/// "survived", "failed 1 of 2", "does not apply", "not run".
std::string state_text(const SurvivalMap::Cell &);

std::string draw(const SurvivalMap &);     ///< SVG text
std::string markdown(const SurvivalMap &); ///< a table, and below it sources and reasons
} // namespace ogive::chart
