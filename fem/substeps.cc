// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/substeps.h"

#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>

/// A step of the elements in parts: their forces act once, as one impulse at
/// t_n, what the coupling layer pushes acts in every part (the impulse method;
/// every impulse is a kick of the leapfrog, so momentum is exact).
namespace ogive::fem
{
template <int dim>
void Solver<dim>::allow_parts()
{
  self_->parts_of_step.resize(self_->nodes.size());
}

template <int dim>
StepStatus Solver<dim>::begin(const TimeStep &whole, const TimeStep &part)
{
  auto &s = *self_;
  require(s.parts_of_step.on(), "a step in parts was not announced");
  // The kick is that of the elements; what others push gets its share of it.
  if (const double share = part.kick / whole.kick; share != 1)
    for (auto &component : s.nodes.force)
      for (double &f : component)
        f *= share;
  s.start(whole, part);
  for (int i = 0; i < dim; ++i)
  {
    s.parts_of_step.first[i] = s.nodes.v[i];
    std::fill(s.parts_of_step.path[i].begin(), s.parts_of_step.path[i].end(), 0.);
  }
  return {};
}

template <int dim>
StepStatus Solver<dim>::go_on(const TimeStep &part)
{
  auto &s     = *self_;
  auto &nodes = s.nodes;
  s.constraints.fold_forces(nodes, [&](std::uint32_t slave, double (&f)[dim]) {
    for (int i = 0; i < dim; ++i)
      f[i] = nodes.force[i][slave];
  });
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      s.v_old[i][a] = nodes.v[i][a];
      if (nodes.force[i][a] == 0)
        continue;
      nodes.v[i][a] += (nodes.mass[a] > 0 ? part.kick / nodes.mass[a] : 0.) * nodes.force[i][a];
      nodes.force[i][a] = 0;
    }
  s.prescribed.apply(part, nodes, s.v_old, s.work);
  s.constraints.follow(nodes);
  for (int i = 0; i < dim; ++i)
  {
    double       *x = nodes.x[i].data(), *path = s.parts_of_step.path[i].data();
    const double *v = nodes.v[i].data(), *first = s.parts_of_step.first[i].data();
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      x[a] += part.drift * v[a];
      path[a] += part.drift * (v[a] - first[a]);
    }
  }
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
      const auto        force = s.groups[g]->nodal_forces(i);
      const std::size_t first = s.parts[g].first_node;
      for (std::size_t a = first; a < s.parts[g].last_node; ++a)
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
  return status.ok ? s.review() : status;
}

template <int dim>
double Solver<dim>::parts_error() const
{
  return self_->parts_of_step.error[0];
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void       Solver<d>::allow_parts();                                                              \
  template StepStatus Solver<d>::begin(const TimeStep &, const TimeStep &);                                  \
  template StepStatus Solver<d>::go_on(const TimeStep &);                                                    \
  template StepStatus Solver<d>::finish(const TimeStep &);                                                   \
  template double     Solver<d>::parts_error() const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
