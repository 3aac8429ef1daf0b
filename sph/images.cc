// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/images.h"

#include "core/base/error.h"
#include "sph/implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogive::sph
{
namespace
{
using Cell = std::array<std::int64_t, 2>;

/// Share of the spacing that a touching particle may be off the rest gap: well
/// above rounding, well below elastic strains (with 1e-3, copper that arrives at
/// 1 m/s would be held by the wall).
constexpr double touch_slack = 1e-6;

/// Cell of particle i along the wall.
template <int dim>
Cell cell_of(const std::array<AlignedVector<double>, dim> &x, std::size_t i, int axis, double spacing)
{
  Cell c{0, 0};
  int  k = 0;
  for (int a = 0; a < dim; ++a)
    if (a != axis)
      c[k++] = static_cast<std::int64_t>(std::floor(std::clamp(x[a][i] / spacing, -1e15, 1e15)));
  return c;
}
} // namespace

template <int dim>
void Solver<dim>::Implementation::find_wall_axes()
{
  const auto &walls = parameters.walls;
  require(walls.size() < 63, "no more than 62 rigid walls");
  wall_axis.assign(walls.size(), -1);
  for (std::size_t w = 0; w < walls.size() && !reference.on; ++w)
    for (int a = 0; a < dim; ++a)
      if (std::abs(walls[w].normal[a]) > 1 - 1e-14)
        wall_axis[w] = a;
  images.clear();
  images.emplace_back();
  for (std::size_t w = 0; w < walls.size(); ++w)
  {
    const std::size_t so_far = images.size();
    for (std::size_t k = 0; k < so_far && wall_axis[w] >= 0; ++k)
      if (images[k].wall[wall_axis[w]] < 0)
      {
        Images more            = images[k];
        more.wall[wall_axis[w]] = static_cast<int>(w);
        more.bits |= std::int64_t(1) << w;
        images.push_back(more);
      }
  }
  images.erase(images.begin());
}

template <int dim>
double Solver<dim>::Implementation::gap(std::size_t w, double x, double at) const
{
  const auto &wall = parameters.walls[w];
  const int   a    = wall_axis[w];
  return (x - wall.point[a] - wall.velocity[a] * at) * wall.normal[a];
}

template <int dim>
double Solver<dim>::Implementation::rest_gap(const Body &b, std::size_t i, std::size_t w) const
{
  double whole2 = 0, now2 = 0;
  for (int a = 0; a < dim; ++a)
  {
    whole2 += std::pow(b.half_cell[a] * parameters.walls[w].normal[a], 2);
    now2 += std::pow(store.half_cell[a][i] * parameters.walls[w].normal[a], 2);
  }
  return store.rest_share[i] * std::sqrt(parameters.axisymmetric ? std::min(whole2, now2) : whole2);
}

template <int dim>
void Solver<dim>::Implementation::begin_on_walls()
{
  for (const auto &b : bodies)
    for (std::size_t w = 0; w < parameters.walls.size(); ++w)
      for (std::size_t i = b.first; i < b.last; ++i)
      {
        const auto &wall     = parameters.walls[w];
        double      distance = 0;
        for (int a = 0; a < dim; ++a)
          distance += wall.normal[a] * (store.x[a][i] - wall.point[a]);
        const double rest = rest_gap(b, i, w);
        // Rounding is left alone: bodies that are laid on a wall are there.
        if (distance > rest * (1 - 1e-9))
          continue;
        for (int a = 0; a < dim; ++a)
          store.x[a][i] = store.x0[a][i] = store.x[a][i] + (rest - distance) * wall.normal[a];
      }
}

template <int dim>
void Solver<dim>::Implementation::touch_walls()
{
  for (const auto &b : bodies)
    for (std::size_t w = 0; w < wall_axis.size(); ++w)
    {
      const int a = wall_axis[w];
      if (a < 0)
        continue;
      const auto        &wall = parameters.walls[w];
      const std::int64_t bit  = std::int64_t(1) << w;
      const double       slack = touch_slack * b.spacing;
      for (std::size_t i = b.first; i < b.last; ++i)
      {
        const double rest     = rest_gap(b, i, w);
        const double distance = gap(w, store.x[a][i], time);
        if (distance > b.spacing)
        {
          store.touch[i] &= ~bit;
          continue;
        }
        const double speed = (store.v[a][i] - wall.velocity[a]) * wall.normal[a];
        if (!(store.touch[i] & bit))
        {
          if (distance <= rest + slack && speed <= 0)
            store.touch[i] |= bit;
        }
        else if (speed > 0 && store.points.sigma[a][i] > 0 && distance > rest + slack)
          store.touch[i] &= ~bit;
      }
    }
}

/// Body, wall and cell of each place along a wall where a particle touches it,
/// and of those around, of all ranks, in order.
template <int dim>
std::vector<std::array<std::int64_t, 4>> Solver<dim>::Implementation::touched_cells() const
{
  std::vector<std::array<std::int64_t, 4>> cells;
  for (std::size_t k = 0; k < bodies.size(); ++k)
    for (std::size_t w = 0; w < wall_axis.size(); ++w)
    {
      const int a = wall_axis[w];
      for (std::size_t i = bodies[k].first; i < bodies[k].last && a >= 0; ++i)
        if (store.touch[i] >> w & 1)
        {
          const Cell c = cell_of<dim>(store.x, i, a, bodies[k].spacing);
          for (int p = dim > 1 ? -1 : 0; p <= (dim > 1 ? 1 : 0); ++p)
            for (int q = dim > 2 ? -1 : 0; q <= (dim > 2 ? 1 : 0); ++q)
              cells.push_back({static_cast<std::int64_t>(k), static_cast<std::int64_t>(w), c[0] + p, c[1] + q});
        }
    }
  const auto in_order = [](auto &all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  in_order(cells);
  // Away from the walls no images are listed, and nobody asks.
  if (ranks.alone())
    return cells;
  if (std::find(near_wall.begin(), near_wall.end(), 1) == near_wall.end())
    return {};
  cells = ranks.gather(cells);
  in_order(cells);
  return cells;
}

template <int dim>
void Solver<dim>::Implementation::find_active()
{
  std::fill(active.begin(), active.end(), 0);
  const auto cells = touched_cells();
  for (std::size_t k = 0; k < bodies.size() && !cells.empty(); ++k)
    for (std::size_t w = 0; w < wall_axis.size(); ++w)
    {
      const auto         &b   = bodies[k];
      const int           a   = wall_axis[w];
      const std::int64_t  bit = std::int64_t(1) << w, body = static_cast<std::int64_t>(k), wall = static_cast<std::int64_t>(w);
      const std::array<std::int64_t, 3> here{body, wall, std::numeric_limits<std::int64_t>::min()};
      const auto from = std::lower_bound(cells.begin(), cells.end(), here, [](const auto &cell, const auto &at) {
        return std::lexicographical_compare(cell.begin(), cell.begin() + 3, at.begin(), at.end());
      });
      if (a < 0 || from == cells.end() || (*from)[0] != body || (*from)[1] != wall)
        continue;
      for (std::size_t i = b.first; i < b.last; ++i)
        if (gap(w, store.x[a][i], time) < b.list_radius)
        {
          const Cell c = cell_of<dim>(store.x, i, a, b.spacing);
          if (std::binary_search(from, cells.end(), std::array<std::int64_t, 4>{body, wall, c[0], c[1]}))
            active[i] |= bit;
        }
    }
  if (!cells.empty())
    exchange(active);
}

template <int dim>
void Solver<dim>::Implementation::append_images(Images &m, const std::array<std::span<const double>, dim> &x,
                                                const std::vector<std::array<std::size_t, 2>> &guests)
{
  if (m.bits == 0) // riders
    return;
  m.range.clear();
  for (std::size_t body = 0; body < bodies.size(); ++body)
  {
    const auto                 &b = bodies[body];
    const std::size_t           begin = ghosts.size();
    std::array<double, 3>       sign{1, 1, 1};
    std::vector<input::SymmetryPlane> planes;
    bool                        listed = true;
    for (int a = 0; a < dim; ++a)
      if (m.wall[a] >= 0)
      {
        sign[a] = -1;
        listed  = listed && is_near(body, m.wall[a]);
      }
    for (const auto &p : parameters.symmetry)
      if (m.wall[p.axis] < 0)
        planes.push_back(p);
    for (unsigned subset = 0; listed && subset < (1u << planes.size()); ++subset)
      Ghosts::for_each_of({{{b.first, b.last}, guests[body]}}, [&](std::size_t i) {
        std::array<double, 3> s    = sign;
        bool                  near = true;
        for (int a = 0; a < dim; ++a)
          if (m.wall[a] >= 0)
            near = near && gap(m.wall[a], x[a][i], time_listed) < b.list_radius;
        for (std::size_t k = 0; k < planes.size(); ++k)
          if (subset >> k & 1)
          {
            near = near && x[planes[k].axis][i] < b.list_radius;
            s[planes[k].axis] = -1;
          }
        if (near)
          ghosts.push_back(static_cast<std::uint32_t>(i), s, static_cast<int>(&m - images.data()));
      });
    m.range.push_back({begin, ghosts.size()});
  }
}

template <int dim>
double Solver<dim>::Implementation::shift(std::size_t g, int a, double at) const
{
  const int m = ghosts.images[g];
  if (m < 0 || images[m].wall[a] < 0)
    return ghosts.offset[g][a];
  const auto &wall = parameters.walls[images[m].wall[a]];
  return 2 * (wall.point[a] + wall.velocity[a] * at);
}

template <int dim>
double Solver<dim>::Implementation::shift_rate(std::size_t g, int a) const
{
  const int m = ghosts.images[g];
  return m < 0 || images[m].wall[a] < 0 ? 0. : 2 * parameters.walls[images[m].wall[a]].velocity[a];
}

template <int dim>
double Solver<dim>::Implementation::share(std::size_t g) const
{
  const int m = ghosts.images[g];
  return m < 0 || acts(images[m], ghosts.parent[g]) ? 1. : 0.;
}

template <int dim>
void Solver<dim>::Implementation::sweep_images(void (*SweepFunctions::*sweep)(const Sweep &),
                                               AlignedVector<double> Images::*sums)
{
  for (auto &m : images)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      if (m.range[k][0] < m.range[k][1])
        (bodies[k].sweeps.*sweep)(sweep_of(bodies[k], m.pairs, (m.*sums).data()));
}

template <int dim>
void Solver<dim>::Implementation::sweep_all(Function f, AlignedVector<double> &sums, std::size_t stride,
                                            std::size_t n_fields, Function half, const std::vector<char> *awake)
{
  const bool halves = joint && half != nullptr;
  if (halves)
    std::fill(sums.begin(), sums.end(), 0.);
  sweep_awake(halves ? half : f, sums, awake);
  sweep_images(f, &Images::sums);
  add_images(&Images::sums, stride, 0, n_fields, sums);
}

/// Gradients and the like: riders have them too.
template <int dim>
void Solver<dim>::Implementation::sweep_riders_too(Function f, AlignedVector<double> &sums, std::size_t stride,
                                                   std::size_t n_fields, const std::vector<char> *awake)
{
  sweep_all(f, sums, stride, n_fields, nullptr, awake);
  for_each_rider_range([&](const Body &b, std::size_t, std::size_t) { (b.sweeps.*f)(rider_sweep_of(b, sums.data())); });
}

template <int dim>
void Solver<dim>::Implementation::add_all(Function f, AlignedVector<double> &sums, std::size_t stride,
                                          std::size_t n_fields)
{
  for (const auto &b : bodies)
    (b.sweeps.*f)(sweep_of(b, pairs, sums.data()));
  for (auto &m : images)
    std::fill(m.sums.begin(), m.sums.end(), 0.);
  sweep_images(f, &Images::sums);
  add_images(&Images::sums, stride, 0, n_fields, sums);
}

template <int dim>
void Solver<dim>::Implementation::add_images(const AlignedVector<double> Images::*from, std::size_t stride,
                                             std::size_t first, std::size_t last, AlignedVector<double> &to)
{
  for (const auto &m : images)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      if (m.range[k][0] < m.range[k][1])
        for (std::size_t i = bodies[k].first; i < bodies[k].last; ++i)
          if (m.pairs.rows.row[i] < m.pairs.rows.row[i + 1] && acts(m, i))
            for (std::size_t f = i * stride + first; f < i * stride + last; ++f)
              to[f] += (m.*from)[f];
}

/// What the images press in one kick: into the wall forces and the books.
template <int dim>
void Solver<dim>::Implementation::book_images(double kick)
{
  for (auto &m : images)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      if (m.range[k][0] < m.range[k][1])
        for (std::size_t i = bodies[k].first; i < bodies[k].last; ++i)
          for (int a = 0; a < dim; ++a)
          {
            double &f = m.forces[i * L::forces_stride + L::f_sum + a];
            if (!acts(m, i))
              f = 0;
            if (m.wall[a] < 0)
              continue;
            const auto &wall = parameters.walls[m.wall[a]];
            wall_forces[m.wall[a]] += f * wall.normal[a];
            works.external += kick * f * wall.velocity[a];
            press[i * parameters.walls.size() + m.wall[a]] += kick * f * wall.normal[a] / store.mass[i];
          }
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void   Solver<d>::Implementation::find_wall_axes();                                               \
  template double Solver<d>::Implementation::gap(std::size_t, double, double) const;                         \
  template double Solver<d>::Implementation::rest_gap(const Body &, std::size_t, std::size_t) const;         \
  template void   Solver<d>::Implementation::begin_on_walls();                                               \
  template void   Solver<d>::Implementation::touch_walls();                                                  \
  template void   Solver<d>::Implementation::find_active();                                                  \
  template void   Solver<d>::Implementation::append_images(Images &,                                         \
                                                           const std::array<std::span<const double>, d> &,   \
                                                           const std::vector<std::array<std::size_t, 2>> &); \
  template double Solver<d>::Implementation::shift(std::size_t, int, double) const;                          \
  template double Solver<d>::Implementation::shift_rate(std::size_t, int) const;                             \
  template double Solver<d>::Implementation::share(std::size_t) const;                                       \
  template void   Solver<d>::Implementation::sweep_images(void (*SweepFunctions::*)(const Sweep &),          \
                                                          AlignedVector<double> Images::*);                  \
  template void   Solver<d>::Implementation::sweep_all(Function, AlignedVector<double> &, std::size_t,       \
                                                       std::size_t, Function, const std::vector<char> *);    \
  template void   Solver<d>::Implementation::sweep_riders_too(Function, AlignedVector<double> &, std::size_t, \
                                                              std::size_t, const std::vector<char> *);       \
  template void   Solver<d>::Implementation::add_all(Function, AlignedVector<double> &, std::size_t,         \
                                                     std::size_t);                                           \
  template void   Solver<d>::Implementation::add_images(const AlignedVector<double> Images::*, std::size_t,  \
                                                        std::size_t, std::size_t, AlignedVector<double> &);  \
  template void   Solver<d>::Implementation::book_images(double);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
