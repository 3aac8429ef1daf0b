// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/study.h"

#include <algorithm>
#include <cmath>

namespace ogive::chart
{
bool Judged::bounded() const
{
  return !std::isnan(at_least) || !std::isnan(at_most) || !std::isnan(error_at_most);
}

const Level *model_of(const Axis &axis, const Level &level)
{
  const auto it =
    std::find_if(axis.levels.begin(), axis.levels.end(), [&](const Level &l) { return l.name == level.like; });
  return it == axis.levels.end() ? nullptr : &*it;
}

const std::string *why_not(const Axis &axis, const CaseAxis &in_case, const Level &level)
{
  if (const auto it = in_case.without_meaning.find(level.name);
      it != in_case.without_meaning.end() && !it->second.empty())
    return &it->second;
  // what a case says of the level itself goes before what it says of the other
  const auto   own   = in_case.at.find(level.name);
  const Level *model = model_of(axis, level);
  return model && (own == in_case.at.end() || own->second.items.empty()) ? why_not(axis, in_case, *model) : nullptr;
}

const CaseAxis *Case::find_axis(const std::string &wanted) const
{
  const auto it = std::find_if(axes.begin(), axes.end(), [&](const CaseAxis &a) { return a.axis == wanted; });
  return it == axes.end() ? nullptr : &*it;
}

const Judged *Case::find_quantity(const std::string &wanted) const
{
  const auto it =
    std::find_if(quantities.begin(), quantities.end(), [&](const Judged &q) { return q.name == wanted; });
  return it == quantities.end() ? nullptr : &*it;
}

bool Case::knows(const std::string &quantity) const
{
  return std::any_of(known.begin(), known.end(), [&](const Measured &m) { return m.name == quantity; });
}

int Study::axis_index(const std::string &wanted) const
{
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name == wanted)
      return static_cast<int>(i);
  return -1;
}

const Case *Study::find_case(const std::string &wanted) const
{
  const auto it = std::find_if(cases.begin(), cases.end(), [&](const Case &c) { return c.name == wanted; });
  return it == cases.end() ? nullptr : &*it;
}

const std::vector<std::string> &check_names()
{
  static const std::vector<std::string> names{"mass_drift", "momentum_drift", "angular_momentum_drift",
                                              "energy_drift", "hourglass_fraction"};
  return names;
}
} // namespace ogive::chart
