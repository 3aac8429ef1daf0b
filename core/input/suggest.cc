// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/suggest.h"

#include <algorithm>
#include <cctype>

namespace ogive::input
{
int edit_distance(const std::string &a, const std::string &b)
{
  const auto same = [&](std::size_t i, std::size_t j) {
    return std::tolower(static_cast<unsigned char>(a[i])) == std::tolower(static_cast<unsigned char>(b[j]));
  };
  const std::size_t             m = a.size(), n = b.size();
  std::vector<std::vector<int>> d(m + 1, std::vector<int>(n + 1));
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j)
    {
      if (i == 0 || j == 0)
      {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[m][n];
}

std::string nearest(const std::string &wanted, const std::vector<std::string> &known)
{
  std::string best;
  // a third of the letters, and at least two, may be wrong
  int least = std::max<int>(2, static_cast<int>(wanted.size()) / 3) + 1;
  for (const std::string &name : known)
    if (const int d = edit_distance(wanted, name); d < least)
    {
      least = d;
      best  = name;
    }
  return best;
}

std::string did_you_mean(const std::string &wanted, const std::vector<std::string> &known)
{
  const std::string name = nearest(wanted, known);
  return name.empty() ? "" : "did you mean \"" + name + "\"?";
}
} // namespace ogive::input
