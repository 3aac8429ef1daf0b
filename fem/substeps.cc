// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/substeps.h"

#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <Eigen/Geometry>

#include <algorithm>

/// A step of the elements in parts: fem/substeps.h says how.
namespace ogive::fem
{
template <int dim>
void Solver<dim>::allow_parts()
{
  if (self_->local.on)
    throw InputError({"", 0, "FEM/local steps"},
                     "elements that step by their own bounds cannot step less often than particles as well",
                     "FEM/local steps = none, or Subcycling/who = none or elements");
  self_->parts_of_step.resize(self_->nodes.size());
}

template <int dim>
StepStatus Solver<dim>::begin(const TimeStep &whole, const TimeStep &part)
{
  auto &s = *self_;
  auto &p = s.parts_of_step;
  require(p.on(), "a step in parts was not announced");
  // The kick is that of the elements; what others push gets its share of it.
  const double share = part.kick / whole.kick;
  p.pushed.clear();
  for (std::uint32_t a = 0; a < s.nodes.size(); ++a)
  {
    typename Substeps<dim>::Pushed pushed{a, {}};
    bool                           any = false, owed = false;
    for (int i = 0; i < dim; ++i)
    {
      double &f = s.nodes.force[i][a];
      any |= f != 0;
      owed |= p.owed[i][a] != 0;
      pushed.force[i] = f *= share;
    }
    if ((any || owed) && s.nodes.keeps(a) && s.nodes.mass[a] > 0 && !s.constraints.is_slave(a))
      p.pushed.push_back(pushed);
  }
  s.kick(whole);
  for (auto &pushed : p.pushed)
    s.spread(pushed, whole, part);
  s.place(whole, part);
  for (const auto &pushed : p.pushed)
    for (int i = 0; i < dim && s.nodes.counts(pushed.node); ++i)
      p.error[0] += p.path[i][pushed.node] * s.nodes.v_mean[i][pushed.node];
  std::erase_if(p.pushed, [&](const auto &pushed) {
    return std::all_of(p.owed.begin(), p.owed.end(), [&](const auto &owed) { return owed[pushed.node] == 0; });
  });
  for (int i = 0; i < dim; ++i)
  {
    p.first[i] = s.nodes.v[i];
    std::fill(p.path[i].begin(), p.path[i].end(), 0.);
  }
  return {};
}

/// Takes from a node just kicked what later parts and the next step will give
/// it; notes the impulse beyond the kick in `path`.
template <int dim>
void Solver<dim>::Implementation::spread(typename Substeps<dim>::Pushed &pushed, const TimeStep &whole,
                                         const TimeStep &part)
{
  auto                   &p    = parts_of_step;
  const std::uint32_t     a    = pushed.node;
  const double            mass = nodes.mass[a], half = .5 * (whole.drift - part.drift);
  const auto              push = pushed.force;
  const bool              on   = std::any_of(push.begin(), push.end(), [](double f) { return f != 0; });
  for (int i = 0; i < dim; ++i)
  {
    const double force = mass * (nodes.v[i][a] - v_old[i][a]) / whole.kick - push[i];
    const double later = on ? -half * force : 0.;
    p.path[i][a]       = p.owed[i][a] + later;
    p.owed[i][a]       = later;
    pushed.force[i]    = force;
    nodes.v[i][a] += p.path[i][a] / mass;
  }
}

template <int dim>
StepStatus Solver<dim>::go_on(const TimeStep &part)
{
  auto &s     = *self_;
  auto &nodes = s.nodes;
  auto &p     = s.parts_of_step;
  s.constraints.fold_forces(nodes, [&](std::uint32_t slave, double (&f)[dim]) {
    for (int i = 0; i < dim; ++i)
      f[i] = nodes.force[i][slave];
  });
  for (const auto &pushed : p.pushed)
    for (int i = 0; i < dim; ++i)
      nodes.force[i][pushed.node] += pushed.force[i];
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      s.v_old[i][a] = nodes.v[i][a];
      if (nodes.force[i][a] == 0 || !nodes.keeps(a))
      {
        nodes.force[i][a] = 0;
        continue;
      }
      nodes.v[i][a] += (nodes.mass[a] > 0 ? part.kick / nodes.mass[a] : 0.) * nodes.force[i][a];
      nodes.force[i][a] = 0;
    }
  s.prescribed.apply(part, nodes, s.v_old, s.work);
  s.constraints.follow(nodes);
  for (const auto &pushed : p.pushed)
    for (int i = 0; i < dim && nodes.counts(pushed.node); ++i)
      p.error[0] += part.kick * pushed.force[i] * .5 * (s.v_old[i][pushed.node] + nodes.v[i][pushed.node]);
  for (int i = 0; i < dim; ++i)
  {
    double       *x = nodes.x[i].data(), *path = p.path[i].data();
    const double *v = nodes.v[i].data(), *first = p.first[i].data();
    s.for_each_run([=](std::size_t begin, std::size_t end) {
      for (std::size_t a = begin; a < end; ++a)
      {
        x[a] += part.drift * v[a];
        path[a] += part.drift * (v[a] - first[a]);
      }
    });
  }
  s.show();
  return {};
}

template <int dim>
StepStatus Solver<dim>::finish(const TimeStep &whole)
{
  auto &s     = *self_;
  auto &nodes = s.nodes;
  auto &p     = s.parts_of_step;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    for (int i = 0; i < dim; ++i)
    {
      const double     *force = s.element_forces(g, i);
      const std::size_t first = s.parts[g].first_node;
      for (std::size_t a = first; a < s.parts[g].last_node; ++a)
        if (nodes.counts(a))
          p.error[0] -= .5 * whole.kick * force[a - first] * (p.shift[i][a] + p.path[i][a] / whole.drift);
    }
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      const double beyond = p.path[i][a] / whole.drift, last = nodes.v[i][a];
      nodes.v_mean[i][a] += .5 * (p.shift[i][a] + beyond);
      nodes.v[i][a]   = p.first[i][a] + beyond;
      p.shift[i][a]   = nodes.v[i][a] - last;
      p.first[i][a]   = last;
    }
  const StepStatus status = s.advance_elements(whole);
  for (int i = 0; i < dim; ++i)
    nodes.v[i] = p.first[i];
  return s.conclude(status);
}

template <int dim>
void Solver<dim>::Implementation::add_owed(Balance &b) const
{
  const auto &owed = parts_of_step.owed;
  for (std::size_t a = 0; a < owed[0].size(); ++a)
  {
    if (!nodes.counts(a))
      continue;
    Vec3 x = Vec3::Zero(), p = Vec3::Zero();
    for (int i = 0; i < dim; ++i)
    {
      x[i] = nodes.x[i][a];
      p[i] = owed[i][a];
    }
    if (parameters.axisymmetric)
      b.momentum[1] += p[1];
    else
    {
      b.momentum += p;
      b.angular_momentum += x.cross(p);
    }
  }
}

template <int dim>
double Solver<dim>::parts_error() const
{
  return self_->sum(self_->parts_of_step.error[0] + self_->local.state.error);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void       Solver<d>::Implementation::spread(Substeps<d>::Pushed &, const TimeStep &, const TimeStep &); \
  template void       Solver<d>::allow_parts();                                                              \
  template void       Solver<d>::Implementation::add_owed(Balance &) const;                                  \
  template StepStatus Solver<d>::begin(const TimeStep &, const TimeStep &);                                  \
  template StepStatus Solver<d>::go_on(const TimeStep &);                                                    \
  template StepStatus Solver<d>::finish(const TimeStep &);                                                   \
  template double     Solver<d>::parts_error() const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
