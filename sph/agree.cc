// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/agree.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace ogive::sph
{
namespace
{
/// A culprit as it travels.
struct Told
{
  double                value = 0;
  std::int64_t          id = -1, body = -1;
  std::array<double, 3> where{};
  std::array<char, 16>  entity{};
  std::array<char, 96>  why{};
};

template <std::size_t n>
void write(std::array<char, n> &to, const char *text)
{
  std::strncpy(to.data(), text, n - 1);
}

/// Culprits hold text of unlimited life; there are few different ones.
const char *lasting(const char *text)
{
  static std::set<std::string> all;
  return all.insert(text).first->c_str();
}

Told tell(double value, const Culprit &c)
{
  Told t;
  t.value = value;
  t.id    = c.id;
  t.body  = c.body;
  for (int a = 0; a < 3; ++a)
    t.where[a] = c.where[a];
  write(t.entity, c.entity);
  write(t.why, c.why);
  return t;
}

Culprit hear(const Told &t)
{
  Culprit c;
  c.id     = t.id;
  c.body   = static_cast<int>(t.body);
  c.where  = Vec3(t.where[0], t.where[1], t.where[2]);
  c.entity = lasting(t.entity.data());
  c.why    = lasting(t.why.data());
  return c;
}
} // namespace

StepStatus agree(const Ranks &ranks, const StepStatus &own, std::span<std::int64_t> counts)
{
  if (ranks.alone())
    return own;
  std::vector<std::int64_t> all{!own.ok};
  all.insert(all.end(), counts.begin(), counts.end());
  ranks.sum(std::span<std::int64_t>(all));
  std::copy(all.begin() + 1, all.end(), counts.begin());
  if (all[0] == 0)
    return {};
  const auto told = ranks.gather_one(tell(own.ok ? 0 : 1, own.culprit));
  const auto who  = std::find_if(told.begin(), told.end(), [](const Told &t) { return t.value > 0; });
  return {false, hear(*who)};
}

StepLimit tightest(const Ranks &ranks, const StepLimit &own)
{
  if (ranks.alone())
    return own;
  const auto told = ranks.gather_one(tell(own.dt, own.culprit));
  const auto who  = std::min_element(told.begin(), told.end(), [](const Told &a, const Told &b) { return a.value < b.value; });
  return {who->value, hear(*who)};
}
} // namespace ogive::sph
