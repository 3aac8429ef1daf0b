// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/waves.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ogive::coupling
{
namespace
{
struct ProfilePoint
{
  double x, pressure; ///< m along the direction, -n.sigma.n in Pa
};

double normal_stress(const Sample &s, std::size_t i, const Vec3 &n)
{
  const Sym3 sigma{s.sigma[0][i], s.sigma[1][i], s.sigma[2][i], s.sigma[3][i], s.sigma[4][i], s.sigma[5][i]};
  return n.dot(sigma.matrix() * n);
}

/// Material points sorted along the direction.
std::vector<ProfilePoint> profile(const Sample &s, const Vec3 &n)
{
  std::vector<ProfilePoint> p(s.density.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = {s.centre[0][i] * n.x() + s.centre[1][i] * n.y() + s.centre[2][i] * n.z(), -normal_stress(s, i, n)};
  std::sort(p.begin(), p.end(), [](const ProfilePoint &a, const ProfilePoint &b) { return a.x < b.x; });
  return p;
}

/// Foremost crossing of the level, NaN if the pressure never reaches it.
double front(const std::vector<ProfilePoint> &p, double level)
{
  for (std::size_t i = p.size(); i-- > 1;)
    if (p[i].pressure < level && p[i - 1].pressure >= level)
    {
      const double share = (p[i - 1].pressure - level) / (p[i - 1].pressure - p[i].pressure);
      return p[i - 1].x + share * (p[i].x - p[i - 1].x);
    }
  return std::numeric_limits<double>::quiet_NaN();
}
} // namespace

double FrontSpeed::measure(const Sample &s, double time)
{
  return time > 0 ? (front(profile(s, direction()), parameter()) - point().dot(direction())) / time :
                    std::numeric_limits<double>::quiet_NaN();
}

double PlateauStress::measure(const Sample &s, double)
{
  const std::vector<ProfilePoint> p    = profile(s, direction());
  const double                    head = front(p, parameter());
  if (std::isnan(head))
    return head;
  const double        rear = p.front().x;
  std::vector<double> inside;
  for (const ProfilePoint &q : p)
    if (q.x > rear + .2 * (head - rear) && q.x < rear + .8 * (head - rear))
      inside.push_back(q.pressure);
  if (inside.empty())
    return std::numeric_limits<double>::quiet_NaN();
  std::nth_element(inside.begin(), inside.begin() + inside.size() / 2, inside.end());
  return inside[inside.size() / 2];
}

double GaugeStress::measure(const Sample &s, double)
{
  std::size_t nearest  = 0;
  double      distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if (const double d = (at(s.centre0, i) - point()).squaredNorm(); d < distance)
    {
      distance = d;
      nearest  = i;
    }
  return normal_stress(s, nearest, direction());
}
} // namespace ogive::coupling
