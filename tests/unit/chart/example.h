// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/expressions.h"
#include "apps/chart/rows.h"

#include <string>
#include <vector>

namespace ogive::chart::test
{
inline Axis make_axis(const std::string &name, const std::vector<std::string> &levels)
{
  Axis a;
  a.name = a.title = name;
  for (const std::string &level : levels)
  {
    a.levels.emplace_back();
    a.levels.back().name = a.levels.back().title = level;
  }
  return a;
}

/// Two cases; "bar" is varied along method (2 levels) and alpha (3), "rod" along
/// alpha alone. alpha's levels carry their numbers.
inline Study two_cases()
{
  Study s;
  s.name = s.title = "example";
  s.axes.push_back(make_axis("method", {"fem", "sph"}));
  s.axes.push_back(make_axis("alpha", {"0.5", "1", "2.5"}));
  for (Level &l : s.axes[1].levels)
    l.number = std::stod(l.name);
  s.axes[1].overrides.items = parse_overrides("SPH/alpha={}", {});
  for (Level &l : s.axes[0].levels)
    l.overrides.items = parse_overrides("Bodies/bar/method=" + l.name, {});

  s.cases.resize(2);
  s.cases[0].name = s.cases[0].title = "bar";
  s.cases[0].axes                    = {{"method", {}, {}, {}, {}}, {"alpha", {}, {}, {}, {}}};
  s.cases[1].name = s.cases[1].title = "rod";
  s.cases[1].axes                    = {{"alpha", {}, {}, {}, {}}};
  for (Case &c : s.cases)
  {
    c.known = {{"tip", units::length}, {"energy_drift", units::none, false}};
    c.quantities.emplace_back();
    static_cast<Measured &>(c.quantities.back()) = c.known.front();
  }
  return s;
}

inline std::vector<std::string> row_names(const Matrix &m)
{
  return names_of(m.rows);
}
} // namespace ogive::chart::test
