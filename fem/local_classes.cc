// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// Which element steps how often (fem/local_steps.h).
namespace ogive::fem
{
namespace
{
using Classes = std::vector<std::vector<unsigned char>>; ///< of the elements of each body

constexpr double margin = .8;   ///< a class steps by at most this share of a new element's bound
constexpr double worth  = .9;   ///< of the effort: classes that cost more than that are not changed
constexpr double extra  = 1.05; ///< effort of steps in parts, besides their elements
constexpr double every  = 20;   ///< steps between two looks at the classes

/// Steps of elements in one step of class 0.
double effort_of(const Classes &classes)
{
  double sum = 0;
  bool   any = false;
  for (const auto &body : classes)
    for (const unsigned char c : body)
    {
      sum += std::ldexp(1., -c);
      any |= c > 0;
    }
  return any ? extra * sum : sum;
}

unsigned char coarsest(const Classes &classes)
{
  unsigned char top = 0;
  for (const auto &body : classes)
    for (const unsigned char c : body)
      top = std::max(top, c);
  return top;
}
} // namespace

/// Whether the scene wants elements to step by their own bounds. "auto" does
/// without where they cannot; InputError where a ratio is named.
template <int dim>
bool Solver<dim>::Implementation::may_step_locally(const std::vector<BodyMesh<dim>> &meshes) const
{
  const auto &options = parameters.options;
  std::string fault;
  if (options.local_steps == "none" || meshes.empty())
    return false;
  if (options.correction != "none")
    fault = "FEM/correction needs the accelerations of all elements at one time";
  if (options.step_bound != "element")
    fault = "\"step bound = " + options.step_bound + "\" is one of the whole mesh";
  if (!parameters.ranks.alone())
    fault = "several ranks would have to agree on classes at the nodes that they share";
  for (const auto &mesh : meshes)
    if (mesh.element == "spectral" || (dim > 1 && mesh.element != "one-point"))
      fault = "the " + mesh.element + " elements of a body cannot be parted into groups";
    else if (mesh.loses_elements())
      fault = "elements of a body may leave the mesh (erosion, or method auto), between steps of all";
  if (!fault.empty() && options.local_steps != "auto")
    throw InputError({"", 0, "FEM/local steps"}, "is " + options.local_steps + ", but " + fault,
                     "FEM/local steps = none or auto", "or one-point elements that stay, step bound = element, correction = none");
  return fault.empty();
}

/// After the groups have their bounds.
template <int dim>
void Solver<dim>::Implementation::begin_local_steps()
{
  const auto &options = parameters.options;
  local.chosen        = options.local_steps == "auto";
  local.most          = static_cast<unsigned char>(local.chosen ? 3 : std::lround(std::log2(std::stod(options.local_steps))));
  local.state.count   = every - 3; // a first look soon: others may hold the step
  for (int i = 0; i < dim; ++i)
  {
    local.seen[i]  = nodes.v[i];
    local.begin[i] = nodes.x[i];
  }
  list_local_nodes();
  arrange(choose_classes(std::numeric_limits<double>::infinity()));
}

template <int dim>
ClassedGroup<dim> *Solver<dim>::Implementation::classed(std::size_t g) const
{
  return static_cast<ClassedGroup<dim> *>(groups[g].get());
}

template <int dim>
std::vector<const ClassedGroup<dim> *> Solver<dim>::Implementation::all_classed() const
{
  std::vector<const ClassedGroup<dim> *> all;
  for (std::size_t g = 0; g < groups.size(); ++g)
    all.push_back(classed(g));
  return all;
}

/// By the bounds of the elements; `longest`: whole step (s) that others let pass.
template <int dim>
auto Solver<dim>::Implementation::choose_classes(double longest) const -> std::vector<std::vector<unsigned char>>
{
  std::vector<std::vector<double>> bounds(groups.size());
  double                           fastest = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    classed(g)->collect_bounds(bounds[g]);
    fastest = std::max(fastest, *std::max_element(bounds[g].begin(), bounds[g].end()));
  }
  int          most = local.most;
  const double fine = parameters.options.step_factor * 2 / fastest;
  if (longest < std::ldexp(fine, most))
    most = std::clamp(static_cast<int>(std::ceil(std::log2(longest / fine) - 1e-9)), 0, most);
  Classes classes(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const double bound : bounds[g])
    {
      int c = 0;
      while (c < most && std::ldexp(bound, c + 1) <= margin * fastest)
        ++c;
      classes[g].push_back(static_cast<unsigned char>(c));
    }
  spread_classes(classes, most);
  std::size_t n = 0;
  for (const auto &body : classes)
    n += body.size();
  if (local.chosen && effort_of(classes) > worth * static_cast<double>(n))
    for (auto &body : classes)
      std::fill(body.begin(), body.end(), 0);
  return classes;
}

namespace
{
/// The finest class that touches each node; nodes that are bound together share it.
template <int dim>
std::vector<unsigned char> finest_at(const Classes &classes, const std::vector<const ClassedGroup<dim> *> &groups,
                                     const Constraints<dim> &constraints, std::size_t n_nodes)
{
  std::vector<unsigned char> of(n_nodes, 255);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t e = 0; e < classes[g].size(); ++e)
      groups[g]->for_each_corner(e, [&](std::size_t node) { of[node] = std::min(of[node], classes[g][e]); });
  for (bool changed = !constraints.empty(); changed;)
  {
    changed = false;
    for (std::size_t a = 0; a < n_nodes; ++a)
      constraints.for_each_master(a, [&](std::uint32_t master, double) {
        const unsigned char least = std::min(of[a], of[master]);
        changed |= of[a] != of[master];
        of[a] = of[master] = least;
      });
  }
  return of;
}
} // namespace

template <int dim>
void Solver<dim>::Implementation::spread_classes(Classes &classes, int most) const
{
  // Elements of a class above `level` at nodes of at most that become `to`.
  const auto all  = all_classed();
  const auto pull = [&](int level, int to) {
    const auto at = finest_at<dim>(classes, all, constraints, nodes.size());
    for (std::size_t g = 0; g < all.size(); ++g)
      for (std::size_t e = 0; e < classes[g].size(); ++e)
        if (classes[g][e] > to)
          all[g]->for_each_corner(e, [&](std::size_t node) {
            if (at[node] <= level)
              classes[g][e] = static_cast<unsigned char>(to);
          });
  };
  for (int level = 0; level < most; ++level)
  {
    pull(level, level);
    pull(level, level + 1);
  }
}

/// Adds half of what the last steps of the elements owe the next impulse at the present forces, N s.
template <int dim>
void Solver<dim>::Implementation::sum_half_kicks(std::array<AlignedVector<double>, dim> &impulse, double sign) const
{
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t c = 0; c < classed(g)->classes().size(); ++c)
      if (const auto &one = classed(g)->classes()[c]; one.group)
        for (int i = 0; i < dim; ++i)
        {
          const auto force = one.group->nodal_forces(i);
          for (std::size_t k = 0; k < force.size(); ++k)
            impulse[i][one.first_node + k] += sign * .5 * std::ldexp(local.state.last, static_cast<int>(c)) * force[k];
        }
}

/// An element that changes its class took its last step with another length than
/// those it joins: the difference of the half kicks is due now.
template <int dim>
void Solver<dim>::Implementation::arrange(const Classes &classes)
{
  bool same = true;
  for (std::size_t g = 0; g < groups.size(); ++g)
    same = same && classed(g)->layout() == classes[g];
  if (same)
    return;
  std::array<AlignedVector<double>, dim> impulse;
  for (auto &component : impulse)
    component.assign(nodes.size(), 0.);
  sum_half_kicks(impulse, 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    classed(g)->arrange(classes[g]);
  sum_half_kicks(impulse, -1);
  if (local.state.last > 0)
    settle_moved(impulse);
  local.state.moved = 1;
  list_local_nodes();
}

template <int dim>
void Solver<dim>::Implementation::settle_moved(const std::array<AlignedVector<double>, dim> &impulse)
{
  auto sum = impulse;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    constraints.for_each_master(a, [&](std::uint32_t master, double weight) {
      for (int i = 0; i < dim; ++i)
        sum[i][master] += weight * impulse[i][a];
    });
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      const double p = sum[i][a], v = nodes.v[i][a];
      if (p == 0 || constraints.is_slave(a) || !(nodes.mass[a] > 0))
        continue;
      if (prescribed.prescribed(a, i))
      {
        work.impulse[i] -= p;
        work.external -= p * v;
        local.state.error += p * v;
        continue;
      }
      nodes.v[i][a] += p / nodes.mass[a];
      local.state.error += p * .5 * (v + nodes.v[i][a]);
    }
  constraints.follow(nodes);
}

/// Who steps when, by the classes of the elements.
template <int dim>
void Solver<dim>::Implementation::list_local_nodes()
{
  Classes classes;
  for (std::size_t g = 0; g < groups.size(); ++g)
    classes.push_back(classed(g)->layout());
  local.top     = coarsest(classes);
  local.of_node = finest_at<dim>(classes, all_classed(), constraints, nodes.size());
  for (unsigned char &c : local.of_node)
    c = std::min(c, local.top);
  for (std::size_t c = 0; c < local.active.size(); ++c)
  {
    local.active[c].clear();
    for (std::uint32_t a = 0; a < nodes.size() && c <= local.top; ++a)
      if (local.of_node[a] <= c)
        local.active[c].push_back(a);
  }
  local.units.clear();
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t c = 0; c < classed(g)->classes().size(); ++c)
    {
      const auto &one = classed(g)->classes()[c];
      if (!one.group)
        continue;
      typename LocalSteps<dim>::Unit unit{g, c, {}, {}, {}};
      if (c > 0)
        one.group->for_each_node([&](std::uint32_t node, std::size_t) {
          if (local.of_node[node] < c)
            unit.inner.push_back(node);
        });
      std::sort(unit.inner.begin(), unit.inner.end());
      unit.inner.erase(std::unique(unit.inner.begin(), unit.inner.end()), unit.inner.end());
      for (int i = 0; i < dim; ++i)
      {
        unit.start[i].resize(unit.inner.size());
        unit.velocity[i].resize(unit.inner.size());
      }
      local.units.push_back(std::move(unit));
    }
}

/// Of the whole step, without the step factor.
template <int dim>
StepLimit Solver<dim>::Implementation::local_limit() const
{
  StepLimit limit;
  for (const auto &unit : local.units)
  {
    StepLimit own = classed(unit.body)->stable_dt_of(unit.of);
    own.dt        = std::ldexp(own.dt, local.top - static_cast<int>(unit.of));
    limit.tighten(own);
  }
  return limit;
}

/// Elements shrink and grow, and others may hold the step: now and then the
/// classes are chosen anew, and taken if that saves a tenth.
template <int dim>
void Solver<dim>::Implementation::review_classes(double whole)
{
  auto &s = local.state;
  s.limit = std::max(s.limit, whole);
  s.count += 1;
  if (s.count < every || s.ended > 0)
    return;
  const double own = parameters.options.step_factor * local_limit().dt, held = s.limit;
  s.count = s.limit = 0;
  const double longest = held < .7 * own ? held : std::numeric_limits<double>::infinity();
  const auto   fresh   = choose_classes(longest);
  Classes      present;
  double       fastest = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    present.push_back(classed(g)->layout());
    const auto &classes = classed(g)->classes();
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (classes[c].group)
        fastest = std::max(fastest, 1 / classed(g)->stable_dt_of(c).dt);
  }
  const auto rate = [&](const Classes &classes, double bound) {
    return std::ldexp(effort_of(classes), coarsest(classes)) / std::min(bound, longest);
  };
  const double fine = parameters.options.step_factor / fastest;
  if (rate(fresh, std::ldexp(fine, coarsest(fresh))) < worth * rate(present, own))
    arrange(fresh);
}

template <int dim>
auto Solver<dim>::local_plan() const -> LocalPlan
{
  const auto &s = *self_;
  LocalPlan   plan;
  plan.on = s.local.on;
  if (!plan.on)
    return plan;
  plan.elements.assign(s.local.top + std::size_t(1), 0);
  double least = std::numeric_limits<double>::infinity(), updates = 0;
  for (const auto &unit : s.local.units)
  {
    const std::size_t n = s.classed(unit.body)->classes()[unit.of].elements.size();
    plan.elements[unit.of] += n;
    updates += std::ldexp(static_cast<double>(n), s.local.top - static_cast<int>(unit.of));
    least = std::min(least, s.classed(unit.body)->stable_dt_of(unit.of).dt);
  }
  plan.part    = stable_dt().dt / std::ldexp(1., s.local.top);
  plan.updates = updates / static_cast<double>(size()) * least / s.local_limit().dt;
  return plan;
}

template <int dim>
bool Solver<dim>::steps_locally() const
{
  return self_->local.on && self_->local.state.ended == 0;
}

template <int dim>
void Solver<dim>::end_local_steps()
{
  auto   &s = *self_;
  Classes alike;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    alike.emplace_back(s.groups[g]->size(), static_cast<unsigned char>(0));
  s.arrange(alike);
  s.local.state.ended = 1;
}

#define OGIVE_INSTANTIATE(d)                                                                                    \
  template auto Solver<d>::local_plan() const -> LocalPlan;                                                    \
  template bool Solver<d>::steps_locally() const;                                                              \
  template void Solver<d>::end_local_steps();                                                                  \
  template bool               Solver<d>::Implementation::may_step_locally(const std::vector<BodyMesh<d>> &) const; \
  template void               Solver<d>::Implementation::begin_local_steps();                                  \
  template ClassedGroup<d>   *Solver<d>::Implementation::classed(std::size_t) const;                           \
  template void               Solver<d>::Implementation::arrange(const Classes &);                             \
  template void               Solver<d>::Implementation::list_local_nodes();                                   \
  template StepLimit          Solver<d>::Implementation::local_limit() const;                                  \
  template void               Solver<d>::Implementation::review_classes(double);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
