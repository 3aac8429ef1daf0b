// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/study.h"

/// The small languages inside a study's entries. Each throws InputError with the
/// place it is given.
namespace ogive::chart
{
/// "A/b=1; C/d=2 mm".
std::vector<Override> parse_overrides(const std::string &text, const InputError::Where &);

/// Axes and levels must be those of the study; see Condition.
Condition parse_condition(const std::string &text, const Study &, const InputError::Where &);

/// "axis N", "core seconds", "wall seconds", "work", "value of Q", "size of Q",
/// "error of Q", "spread of Q over AXIS". Axes must be those of the study; Q is
/// not looked up.
Measure parse_measure(const std::string &text, const Study &, const InputError::Where &);

/// Whether the variant satisfies it. `level_of` gives the level's name of an axis,
/// the case's name of "case", and nothing for an axis that the case does not use;
/// then the term counts as `absent`. An empty condition holds.
template <class LevelOf>
bool holds(const Condition &condition, const LevelOf &level_of, bool absent)
{
  if (condition.alternatives.empty())
    return true;
  for (const auto &terms : condition.alternatives)
  {
    bool all = true;
    for (const Condition::Term &term : terms)
    {
      const std::string level = level_of(term.axis);
      bool              one   = level.empty() && absent;
      for (const std::string &wanted : term.levels)
        one = one || wanted == level;
      all = all && one;
    }
    if (all)
      return true;
  }
  return false;
}
} // namespace ogive::chart
