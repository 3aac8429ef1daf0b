// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/shocks.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
namespace
{
std::unique_ptr<ExactProfile> profile_of(const input::Observer &o, const input::Scene &scene, int body)
{
  return exact_profile(scene.bodies[body], scene, "Observers/" + o.name + "/body");
}

double pressure_along(const Sample &s, std::size_t i, const Vec3 &n)
{
  const Sym3 sigma{s.sigma[0][i], s.sigma[1][i], s.sigma[2][i], s.sigma[3][i], s.sigma[4][i], s.sigma[5][i]};
  return -n.dot(sigma.matrix() * n);
}
} // namespace

Overshoot::Overshoot(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene), exact_(profile_of(o, scene, body()))
{
  if (scene.bodies[body()].velocity_field != "closing")
    throw InputError({"", 0, "Observers/" + o.name + "/body"}, "the body has no plateau of greatest pressure",
                     "velocity field \"closing\"");
}

double Overshoot::measure(const Sample &s, double time)
{
  if (time < exact_->until() / 3 || time > exact_->until())
    return worst_;
  const double greatest = -*std::min_element(s.sigma[0].begin(), s.sigma[0].end());
  const double now      = greatest / exact_->greatest_pressure() - 1;
  worst_                = worst_ >= now ? worst_ : now;
  return worst_;
}

void Overshoot::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  worst_ = numbers.at(0);
}

ProfileError::ProfileError(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene), exact_(profile_of(o, scene, body())), quantity_(o.quantity)
{
}

double ProfileError::measure(const Sample &s, double time)
{
  if (!(time > 0 && time <= exact_->until()))
    return value();
  double off = 0, size = 0;
  if (quantity_ == "l1_velocity_error")
    for (std::size_t i = 0; i < s.mass.size(); ++i)
    {
      const double u = exact_->at(s.x[0][i], time).velocity;
      off += s.mass[i] * std::abs(s.v[0][i] - u);
      size += s.mass[i] * std::abs(u);
    }
  else
    for (std::size_t i = 0; i < s.density.size(); ++i)
    {
      const ExactState e    = exact_->at(s.centre[0][i], time);
      const bool       rho  = quantity_ == "l1_density_error";
      const double     want = rho ? e.density : e.pressure;
      off += s.volume[i] * std::abs((rho ? s.density[i] : -s.sigma[0][i]) - want);
      size += s.volume[i] * want;
    }
  return off / size;
}

double ShockSpeed::measure(const Sample &s, double time)
{
  if (!(time > 0))
    return std::numeric_limits<double>::quiet_NaN();
  struct Ring
  {
    double distance, mass;
  };
  std::vector<Ring> rings;
  double            struck = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
  {
    rings.push_back({(at(s.centre, i) - point()).norm(), s.density[i] * s.volume[i]});
    if (pressure_along(s, i, direction()) >= parameter())
      struck += rings.back().mass;
  }
  std::sort(rings.begin(), rings.end(), [](const Ring &a, const Ring &b) { return a.distance < b.distance; });
  // half of a particle's mass lies within its own distance
  double within = 0, last = 0, before = 0;
  for (const Ring &r : rings)
  {
    const double here = within + .5 * r.mass;
    if (here >= struck)
      return (last + (r.distance - last) * (struck - before) / (here - before)) / time;
    within += r.mass;
    before = here;
    last   = r.distance;
  }
  return last / time;
}

double DensityDeficit::measure(const Sample &s, double)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.density.size(); ++i)
    nearest = std::min(nearest, (at(s.centre, i) - point()).norm());
  double mass = 0, volume = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if ((at(s.centre, i) - point()).norm() <= 2 * nearest)
    {
      mass += s.density[i] * s.volume[i];
      volume += s.volume[i];
    }
  return 1 - mass / volume / parameter();
}
} // namespace ogive::coupling
