// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// When lists are too old: any rank's are all ranks'.
namespace ogive::sph
{
template <int dim>
double Solver<dim>::Implementation::least_gap(const Body &b, std::size_t w,
                                              const PerAxis<AlignedVector<double>> &x, double at) const
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = b.first; i < b.last; ++i)
    least = std::min(least, gap(w, x[wall_axis[w]][i], at));
  return least;
}

/// Which bodies are near which walls at the positions of the lists.
template <int dim>
void Solver<dim>::Implementation::find_near_walls()
{
  const std::size_t   n = wall_axis.size();
  std::vector<double> closeness(bodies.size() * n, -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    for (std::size_t w = 0; w < n; ++w)
      if (wall_axis[w] >= 0)
        closeness[k * n + w] = -least_gap(bodies[k], w, store.x_listed, time_listed);
  ranks.max(std::span<double>(closeness));
  near_wall.assign(closeness.size(), 0);
  for (std::size_t k = 0; k < bodies.size(); ++k)
    for (std::size_t w = 0; w < n; ++w)
      near_wall[k * n + w] = -closeness[k * n + w] < bodies[k].spacing;
}

template <int dim>
bool Solver<dim>::Implementation::is_mirrored(std::size_t body, int axis) const
{
  for (std::size_t w = 0; w < wall_axis.size(); ++w)
    if (wall_axis[w] == axis && is_near(body, w))
      return true;
  return std::any_of(parameters.symmetry.begin(), parameters.symmetry.end(),
                     [axis](const auto &p) { return p.axis == axis; }) ||
         std::any_of(parameters.mirrors.begin(), parameters.mirrors.end(),
                     [axis](const auto &m) { return m.axis == axis; });
}

/// Of each body how far it went on the mean along each axis, a mirrored one
/// excepted, then its least gap to each wall: of all ranks.
template <int dim>
std::vector<double> Solver<dim>::Implementation::drift_of_bodies() const
{
  const std::size_t   walls = wall_axis.size(), width = dim + walls;
  std::vector<double> own(bodies.size() * width, 0.);
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    const Body &b  = bodies[k];
    double     *to = &own[k * width];
    for (int a = 0; a < dim; ++a)
      if (!is_mirrored(k, a))
        for (std::size_t i = b.first; i < b.last; ++i)
          to[a] += (store.x[a][i] - store.x_listed[a][i]) / b.all;
    for (std::size_t w = 0; w < walls; ++w)
      to[dim + w] = wall_axis[w] < 0 ? 0. : least_gap(b, w, store.x, time);
  }
  const auto          all = ranks.gather(own);
  std::vector<double> drift(all.begin(), all.begin() + own.size());
  for (std::size_t at = own.size(); at < all.size(); ++at)
    if (double &to = drift[at % own.size()]; at % width < dim)
      to += all[at];
    else
      to = std::min(to, all[at]);
  return drift;
}

template <int dim>
double Solver<dim>::Implementation::most_moved(std::size_t first, std::size_t last, const PerAxis<double> &drifted,
                                               const PerAxis<double> &apart) const
{
  double most = 0;
  for (std::size_t i = first; i < last; ++i)
  {
    double d2 = 0;
    for (int a = 0; a < dim; ++a)
    {
      const double d = std::abs(store.x[a][i] - store.x_listed[a][i] - drifted[a]) + apart[a];
      d2 += d * d;
    }
    most = d2 > most ? d2 : most;
  }
  return most;
}

template <int dim>
bool Solver<dim>::Implementation::lists_are_stale() const
{
  if (reference.on)
    return false;
  if (pieces_stale)
    return true;
  const std::size_t         walls = wall_axis.size();
  const std::vector<double> drift = drift_of_bodies();
  bool                      stale = false;
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    // A body's translation parts no pair, except from its mirror image.
    const Body      &b = bodies[k];
    PerAxis<double>  drifted{};
    PerAxis<double>  apart{}; // from walls of different speed
    std::copy_n(&drift[k * (dim + walls)], dim, drifted.begin());
    for (std::size_t w = 0; w < walls; ++w)
    {
      if (wall_axis[w] < 0)
        continue;
      const bool near = drift[k * (dim + walls) + dim + w] < b.spacing;
      if (near != is_near(k, w))
        return true;
      const double path = (time - time_listed) * parameters.walls[w].velocity[wall_axis[w]];
      if (near)
        apart[wall_axis[w]] = std::max(apart[wall_axis[w]], std::abs(path));
    }
    const double most = std::max(most_moved(b.first, b.last, drifted, apart),
                                 most_moved(b.first_rider, b.last_rider, drifted, {}));
    stale = stale || most > .25 * b.skin * b.skin;
  }
  return ranks.any(stale);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::find_near_walls();                                                \
  template bool Solver<d>::Implementation::lists_are_stale() const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
