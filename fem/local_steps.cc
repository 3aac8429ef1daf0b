// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/local_steps.h"

#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <bit>
#include <cmath>

/// A step with parts for small elements (fem/local_steps.h).
namespace ogive::fem
{
namespace
{
/// A time of each class: that of class 0, doubled from class to class.
struct Times
{
  double of[ClassedGroup<1>::n_classes];
  explicit Times(double finest)
  {
    for (double &one : of)
    {
      one = finest;
      finest *= 2;
    }
  }
};
} // namespace

template <int dim>
StepStatus Solver<dim>::Implementation::step_locally(const TimeStep &whole)
{
  const std::size_t parts = std::size_t(1) << local.top;
  const double      h     = whole.drift / static_cast<double>(parts);
  note_pushes(whole.kick);
  for (std::size_t j = 0; j < parts; ++j)
  {
    const int    upto = j == 0 ? local.top : std::min<int>(std::countr_zero(j), local.top);
    const double time = whole.time + static_cast<double>(j) * h;
    if (!loads.empty())
      loads.gather(nodes, constraints, time, load);
    kick_locally(h, upto);
    constrain_locally(whole, time, h, upto);
    begin_units(time, upto);
    if (j == 0)
      for (const auto &push : local.pushed)
        for (int i = 0; i < dim; ++i)
          local.state.error += .5 * whole.kick * push.force[i] * (v_old[i][push.node] + nodes.v[i][push.node]);
    drift_locally(h, upto);
    if (const StepStatus status = finish_units(j + 1, h); !status.ok)
      return status;
  }
  finish_whole(whole);
  const StepStatus status = review();
  if (status.ok)
    review_classes(whole.drift);
  return status;
}

/// Others push once, over the kick of the whole step: Nodes::force becomes an impulse.
template <int dim>
void Solver<dim>::Implementation::note_pushes(double kick)
{
  local.pushed.clear();
  for (std::uint32_t a = 0; a < nodes.size(); ++a)
  {
    typename LocalSteps<dim>::Push push{a, {}};
    bool                           any = false;
    for (int i = 0; i < dim; ++i)
    {
      push.force[i] = nodes.force[i][a];
      any |= push.force[i] != 0;
      nodes.force[i][a] *= kick;
    }
    if (any)
      local.pushed.push_back(push);
  }
  if (local.top > 0)
    for (int i = 0; i < dim; ++i)
      for (const std::uint32_t a : local.active[local.top - 1])
        local.begin[i][a] = nodes.x[i][a];
}

/// The impulses that are due at the beginning of a part.
template <int dim>
void Solver<dim>::Implementation::kick_locally(double h, int upto)
{
  const double kick = .5 * (local.state.last + h); // of class 0
  for (auto &unit : local.units)
    if (static_cast<int>(unit.of) <= upto)
    {
      const auto &one = classed(unit.body)->classes()[unit.of];
      unit.kick       = std::ldexp(kick, static_cast<int>(unit.of));
      for (int i = 0; i < dim; ++i)
      {
        const auto force   = one.group->nodal_forces(i);
        double    *impulse = &nodes.force[i][one.first_node];
        for (std::size_t k = 0; k < force.size(); ++k)
          impulse[k] += unit.kick * force[k];
      }
    }
  const auto &active = local.active[upto];
  const Times kicks(kick);
  if (!loads.empty())
    for (int i = 0; i < dim; ++i)
      for (const std::uint32_t a : active)
        nodes.force[i][a] += kicks.of[local.of_node[a]] * load[i][a];
  constraints.fold_forces(nodes, [this](std::uint32_t slave, double (&f)[dim]) {
    for (int i = 0; i < dim; ++i)
      f[i] = nodes.force[i][slave];
  });
  for (int i = 0; i < dim; ++i)
  {
    double       *v = nodes.v[i].data(), *old = v_old[i].data(), *impulse = nodes.force[i].data();
    const double *mass = nodes.mass.data();
    for (const std::uint32_t a : active)
    {
      old[a] = v[a];
      v[a] += mass[a] > 0 ? impulse[a] / mass[a] : 0.;
      impulse[a] = 0;
    }
  }
}

/// What nodes are not free to do, each by its own step.
template <int dim>
void Solver<dim>::Implementation::constrain_locally(const TimeStep &whole, double time, double h, int upto)
{
  Turn turn{local.of_node, 0, time == whole.time, whole.kick};
  const auto for_each_turn = [&](auto &&f) {
    for (int c = 0; c <= upto; ++c)
    {
      turn.who   = static_cast<unsigned char>(c);
      turn.first = time == whole.time && c == 0;
      f(TimeStep{time, std::ldexp(.5 * (local.state.last + h), c), std::ldexp(h, c)});
    }
  };
  if (!absorbing.empty())
    for_each_turn([&](const TimeStep &own) { absorbing.apply(own, prescribed, constraints, nodes, v_old, &turn); });
  for_each_turn([&](const TimeStep &own) { prescribed.apply(own, nodes, v_old, work, &turn); });
  for_each_turn([&](const TimeStep &own) { walls.apply(own, prescribed, nodes, v_old, work, &turn); });
  constraints.follow(nodes);
}

template <int dim>
void Solver<dim>::Implementation::begin_units(double time, int upto)
{
  for (auto &unit : local.units)
  {
    if (static_cast<int>(unit.of) > upto)
      continue;
    unit.begin = time;
    for (int i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < unit.inner.size(); ++k)
        unit.start[i][k] = nodes.x[i][unit.inner[k]];
    unit.given = 0;
    const auto &one = classed(unit.body)->classes()[unit.of];
    if (books_exactly(unit))
      continue;
    for (int i = 0; i < dim; ++i)
    {
      const auto    force = one.group->nodal_forces(i);
      const double *v = &nodes.v[i][one.first_node], *old = &v_old[i][one.first_node];
      for (std::size_t k = 0; k < force.size(); ++k)
        unit.given += .5 * force[k] * (v[k] + old[k]);
    }
  }
}

/// Nodes of elements that take every part move with the velocities these see.
template <int dim>
bool Solver<dim>::Implementation::books_exactly(const typename LocalSteps<dim>::Unit &unit) const
{
  return unit.of == 0 && local.state.moved == 0;
}

template <int dim>
void Solver<dim>::Implementation::drift_locally(double h, int upto)
{
  const Times lengths(h), kicks(.5 * (local.state.last + h));
  for (int i = 0; i < dim; ++i)
  {
    double       *x = nodes.x[i].data(), *mean = nodes.v_mean[i].data();
    const double *v = nodes.v[i].data(), *old = v_old[i].data();
    for (const std::uint32_t a : local.active[upto])
    {
      mean[a] = .5 * (v[a] + old[a]);
      x[a] += lengths.of[local.of_node[a]] * v[a];
    }
  }
  Turn turn{local.of_node, 0, false, 0.};
  for (int c = 0; c <= upto && !absorbing.empty(); ++c)
  {
    turn.who = static_cast<unsigned char>(c);
    absorbing.book(nodes, work, &turn);
  }
  if (!loads.empty())
    for (int i = 0; i < dim; ++i)
      for (const std::uint32_t a : local.active[upto])
      {
        const double impulse = kicks.of[local.of_node[a]] * load[i][a];
        work.external += impulse * nodes.v_mean[i][a];
        work.impulse[i] += impulse;
      }
}

/// Elements whose step ends where part `next` begins: they see the mean
/// velocities of their step.
template <int dim>
StepStatus Solver<dim>::Implementation::finish_units(std::size_t next, double h)
{
  for (auto &unit : local.units)
  {
    if (next % (std::size_t(1) << unit.of) != 0)
      continue;
    const auto  &one    = classed(unit.body)->classes()[unit.of];
    const double length = std::ldexp(h, static_cast<int>(unit.of));
    for (int i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < unit.inner.size(); ++k)
      {
        const std::uint32_t a = unit.inner[k];
        unit.velocity[i][k]   = nodes.v[i][a];
        nodes.v[i][a]         = (nodes.x[i][a] - unit.start[i][k]) / length;
      }
    if (!books_exactly(unit))
    {
      double taken = -one.group->half_power();
      for (int i = 0; i < dim; ++i)
      {
        const auto    force = one.group->nodal_forces(i);
        const double *v     = &nodes.v[i][one.first_node];
        for (std::size_t k = 0; k < force.size(); ++k)
          taken += .5 * force[k] * v[k];
      }
      local.state.error += unit.kick * (unit.given - taken);
    }
    const StepStatus status = classed(unit.body)->advance_class(unit.of, nodes, {unit.begin, unit.kick, length});
    updates += one.group->size();
    for (int i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < unit.inner.size(); ++k)
        nodes.v[i][unit.inner[k]] = unit.velocity[i][k];
    if (!status.ok)
      return status;
  }
  return {};
}

/// Whoever pushes sees the mean velocity of the step, and works with that.
template <int dim>
void Solver<dim>::Implementation::finish_whole(const TimeStep &whole)
{
  const auto add_work = [&] {
    for (const auto &push : local.pushed)
      for (int i = 0; i < dim; ++i)
        local.state.error -= .5 * whole.kick * push.force[i] * local.seen[i][push.node];
  };
  add_work();
  for (int i = 0; i < dim; ++i)
  {
    local.seen[i] = nodes.v[i];
    if (local.top > 0)
      for (const std::uint32_t a : local.active[local.top - 1])
        local.seen[i][a] = (nodes.x[i][a] - local.begin[i][a]) / whole.drift;
  }
  add_work();
  local.state.last  = std::ldexp(whole.drift, -local.top);
  local.state.moved = 0;
}

#define OGIVE_INSTANTIATE(d) template StepStatus Solver<d>::Implementation::step_locally(const TimeStep &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
