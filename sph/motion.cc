// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "sph/faces.h"
#include "sph/implementation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace ogive::sph
{
namespace
{
constexpr bool is_fixed(std::int64_t bits, int axis)
{
  return bits >> axis & 1;
}
/// Share of its radius that a ring keeps in any step.
constexpr double clear_of_axis = .25;
} // namespace

template <int dim>
void Solver<dim>::Implementation::mark_boundaries(const std::vector<BodyParticles<dim>> &filled)
{
  for (std::size_t k = 0; k < parameters.boundaries.size(); ++k)
  {
    const auto &boundary = parameters.boundaries[k];
    for (std::size_t b = 0; b < bodies.size(); ++b)
    {
      if (bodies[b].scene != parameters.boundary_bodies[k] || bodies[b].grows)
        continue;
      const bool constant = boundary.kind == input::BoundaryKind::fixed || boundary.kind == input::BoundaryKind::velocity;
      if (!constant || !boundary.history.empty())
        throw InputError({"", 0, "Boundaries/" + boundary.name}, "particles are held or driven at constant velocity only",
                         "kind fixed or velocity, without a history");
      const double          inf = std::numeric_limits<double>::infinity();
      std::array<double, 3> lower{inf, inf, inf}, upper{-inf, -inf, -inf}, below;
      for (std::size_t i = bodies[b].first; i < bodies[b].last; ++i)
        for (int a = 0; a < dim; ++a)
        {
          lower[a] = std::min(lower[a], store.x[a][i] - .5 * bodies[b].spacing);
          upper[a] = std::max(upper[a], store.x[a][i] + .5 * bodies[b].spacing);
        }
      std::transform(lower.begin(), lower.end(), below.begin(), std::negate<>()); // the box of all ranks' particles
      ranks.max(std::span<double>(below));
      ranks.max(std::span<double>(upper));
      std::transform(below.begin(), below.end(), lower.begin(), std::negate<>());
      const Face face(boundary.face, filled[b].shape, lower, upper, dim, boundary.name);
      for (std::size_t i = bodies[b].first; i < bodies[b].last; ++i)
      {
        Vec3 x = Vec3::Zero();
        for (int a = 0; a < dim; ++a)
          x[a] = store.x[a][i];
        if (!face.contains(x, 2 * bodies[b].h))
          continue;
        for (int a = 0; a < dim; ++a)
          if (boundary.kind == input::BoundaryKind::fixed || boundary.fix[a])
          {
            store.fixed[i] |= std::int64_t(1) << a;
            store.prescribed[a][i] = boundary.kind == input::BoundaryKind::fixed ? 0. : boundary.velocity[a];
            store.v[a][i]          = store.prescribed[a][i];
          }
      }
    }
  }
}

/// Mirror images repel whole material from a symmetry plane; loose fragments
/// are stopped on it.
template <int dim>
void Solver<dim>::Implementation::stay_on_side(std::size_t i, const TimeStep &t)
{
  for (const auto &plane : parameters.symmetry)
  {
    const int    a     = plane.axis;
    const double least = parameters.axisymmetric && a == 0 ? clear_of_axis * store.x[a][i] : 0.;
    if (!(store.x[a][i] + t.drift * store.v[a][i] < least))
      continue;
    const double landed = (least - store.x[a][i]) / t.drift;
    const double mean   = .5 * (energy_records[i * L::energy_stride + L::v + a] + landed);
    works.wall_loss -= store.mass[i] * (landed - store.v[a][i]) * mean;
    works.impulse[a] += store.mass[i] * (landed - store.v[a][i]);
    store.v[a][i] = landed;
  }
}

/// Normal velocity that lands particle i at its rest gap in front of wall w.
template <int dim>
double Solver<dim>::Implementation::landing(const Body &b, std::size_t i, std::size_t w, const TimeStep &t) const
{
  const auto &wall   = parameters.walls[w];
  double      excess = -rest_gap(b, i, w);
  for (int a = 0; a < dim; ++a)
    excess += wall.normal[a] * (store.x[a][i] + t.drift * store.v[a][i] - wall.point[a] -
                                wall.velocity[a] * (t.time + t.drift));
  return excess < 0 ? -excess / t.drift : 0;
}

/// Images pull on some particles and press on others; friction takes what is
/// left in the sum. The share of the pressing parts that a wall's friction may
/// use, so that its total is mu times the net normal impulse.
template <int dim>
void Solver<dim>::Implementation::share_friction(const TimeStep &t)
{
  const std::size_t   n = parameters.walls.size();
  std::vector<double> sums(2 * n, 0.); // of all ranks
  for (std::size_t w = 0; w < n; ++w)
  {
    double &pressing = sums[2 * w], &net = sums[2 * w + 1];
    for (const auto &b : bodies)
      for (std::size_t i = b.first; i < b.last; ++i)
        if (is_slave.empty() || !is_slave[store.id[i]])
        {
          const double push = landing(b, i, w, t), images = press[i * n + w];
          pressing += store.mass[i] * (push + std::max(images, 0.));
          net += store.mass[i] * (push + images);
        }
  }
  ranks.sum(std::span<double>(sums));
  for (std::size_t w = 0; w < n; ++w)
  {
    const double pressing = sums[2 * w], net = sums[2 * w + 1] + works.pull[w];
    works.pull[w]     = std::min(net, 0.);
    friction_share[w] = pressing > 0 ? std::clamp(net / pressing, 0., 1.) : 0.;
  }
}

/// Gives a particle that would pass a wall the normal velocity that lands it
/// at its rest gap in front of it: all that an oblique wall does, and next to
/// the images of the others (images.h) what these do not stop. Coulomb friction
/// on the slip, of the landing and of what the images press.
template <int dim>
void Solver<dim>::Implementation::land_on_walls(const Body &b, std::size_t i, const TimeStep &t)
{
  for (std::size_t w = 0; w < parameters.walls.size(); ++w)
  {
    const auto &wall = parameters.walls[w];
    Vec3        v = Vec3::Zero(), before = Vec3::Zero();
    for (int a = 0; a < dim; ++a)
    {
      v[a]      = store.v[a][i];
      before[a] = energy_records[i * L::energy_stride + L::v + a]; // v_{n-1/2} until the means are taken
    }
    const double push    = landing(b, i, w, t);
    const double pressed = push + std::max(press[i * parameters.walls.size() + w], 0.);
    if (!(pressed > 0))
      continue;
    const Vec3   trial_slip = v - wall.velocity - (v - wall.velocity).dot(wall.normal) * wall.normal;
    const double slip       = trial_slip.norm();
    const double brake      = std::min(wall.friction * friction_share[w] * pressed, slip);
    const Vec3   drag       = slip > 0 ? Vec3(-brake / slip * trial_slip) : Vec3(Vec3::Zero());
    const Vec3   landed     = v + push * wall.normal + drag;
    const double m          = store.mass[i];
    const Vec3   mean       = .5 * (before + landed) - wall.velocity;
    works.external += m * (push * wall.normal + drag).dot(wall.velocity);
    works.wall_loss -= m * push * wall.normal.dot(mean);
    works.friction -= m * drag.dot(mean);
    works.impulse += m * (push * wall.normal + drag);
    wall_forces[w] += m * push / t.kick;
    for (int a = 0; a < dim; ++a)
      store.v[a][i] = landed[a];
  }
}

/// Impulse of the mirror images, across their planes: pair forces between
/// particles, slaves among them, cancel in the sum, and along a plane the
/// images' do too.
template <int dim>
void Solver<dim>::Implementation::book_planes(double kick)
{
  for (int a = 0; a < dim; ++a)
  {
    const bool plane =
      std::any_of(parameters.symmetry.begin(), parameters.symmetry.end(), [a](const auto &p) { return p.axis == a; });
    if (!plane && std::find(wall_axis.begin(), wall_axis.end(), a) == wall_axis.end())
      continue;
    double sum = 0;
    for (const auto &b : bodies)
      for (std::size_t i = b.first; i < b.last; ++i)
      {
        sum += force_sums[i * L::forces_stride + L::f_sum + a];
        if (seam_pairs(b, i)) // the mesh has the counterforce
          sum -= seam().forces[i * L::forces_stride + L::f_sum + a];
      }
    works.impulse[a] += kick * sum;
  }
}

template <int dim>
void Solver<dim>::Implementation::kick(const TimeStep &t)
{
  std::fill(wall_forces.begin(), wall_forces.end(), 0.);
  std::fill(press.begin(), press.end(), 0.);
  book_images(t.kick);
  book_planes(t.kick);
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      double      *record = &energy_records[i * L::energy_stride];
      const double m      = store.mass[i];
      const auto   id     = store.id[i];
      for (int a = 0; a < dim; ++a)
      {
        const double f  = force_sums[i * L::forces_stride + L::f_sum + a] + store.external[a][i];
        record[L::x + a] = store.x[a][i];
        record[L::v + a] = store.v[a][i];
        if (!is_slave.empty() && is_slave[id])
          store.v[a][i] = slave_velocity[a][id];
        else if (is_fixed(store.fixed[i], a))
        {
          const double mean    = .5 * (store.v[a][i] + store.prescribed[a][i]);
          const double impulse = m * (store.prescribed[a][i] - store.v[a][i]) - t.kick * f;
          works.external += impulse * mean;
          works.impulse[a] += impulse;
          store.v[a][i] = store.prescribed[a][i];
        }
        else
          store.v[a][i] += t.kick * f / m;
      }
    }
  kick_riders();
  share_friction(t);
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      double *record = &energy_records[i * L::energy_stride];
      if (is_slave.empty() || !is_slave[store.id[i]])
      {
        land_on_walls(b, i, t);
        stay_on_side(i, t);
      }
      for (int a = 0; a < dim; ++a)
        record[L::v + a] = .5 * (record[L::v + a] + store.v[a][i]);
      record[L::weight] = weight(i);
      record[L::last_p] = force_records[i * L::force_stride + L::p + dim * dim - 1];
    }
}

template <int dim>
StepStatus Solver<dim>::Implementation::drift(double dt)
{
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      double moved = 0;
      for (int a = 0; a < dim; ++a)
      {
        const double dx = dt * store.v[a][i];
        store.x[a][i] += dx;
        store.external[a][i] = 0;
        moved += dx * dx;
      }
      // Written so that a NaN is caught too.
      if (!(moved < 1e6 * b.h * b.h))
        return {false, culprit(i, "velocity without bound")};
    }
  for_each_rider_range([&](const Body &, std::size_t first, std::size_t last) {
    for (int a = 0; a < dim; ++a)
      for (std::size_t i = first; i < last; ++i)
        store.x[a][i] += dt * store.v[a][i];
  });
  return {};
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void       Solver<d>::Implementation::mark_boundaries(const std::vector<BodyParticles<d>> &);     \
  template double     Solver<d>::Implementation::landing(const Body &, std::size_t, std::size_t, const TimeStep &) const; \
  template void       Solver<d>::Implementation::share_friction(const TimeStep &);                           \
  template void       Solver<d>::Implementation::land_on_walls(const Body &, std::size_t, const TimeStep &); \
  template void       Solver<d>::Implementation::book_planes(double);                                        \
  template void       Solver<d>::Implementation::kick(const TimeStep &);                                     \
  template void       Solver<d>::Implementation::stay_on_side(std::size_t, const TimeStep &);                \
  template StepStatus Solver<d>::Implementation::drift(double);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
