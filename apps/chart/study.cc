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

const std::string *CaseAxis::why_not(const std::string &level) const
{
  const auto it = without_meaning.find(level);
  return it == without_meaning.end() || it->second.empty() ? nullptr : &it->second;
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
