// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/element_partition.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

/// A step on several ranks: what they tell each other and what they agree on.
namespace ogive::fem
{
/// The mass of nodes that several ranks' elements have put there in parts.
template <int dim>
void Solver<dim>::Implementation::add_up(std::size_t first, std::size_t last)
{
  distribution.ranks().sum(std::span<double>(nodes.mass).subspan(first, last - first));
}

/// From the forces of own elements to those of all at the nodes that are kept up
/// here. Those of slaves go to their masters first, which is the same: both are sums.
template <int dim>
void Solver<dim>::Implementation::complete_forces()
{
  if (distribution.alone())
    return;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int i = 0; i < dim; ++i)
    {
      const double *own = groups[g]->nodal_forces(i).data();
      for (const Run &run : distribution.runs(g))
        std::copy(own + (run.first - parts[g].first_node), own + (run.last - parts[g].first_node),
                  total[i].begin() + static_cast<std::ptrdiff_t>(run.first));
    }
  fold_total();
  std::array<double *, dim> sums;
  for (int i = 0; i < dim; ++i)
    sums[i] = total[i].data();
  distribution.shared().sum(sums);
}

template <int dim>
void Solver<dim>::Implementation::fold_total()
{
  for (const std::uint32_t slave : constraints.slaves())
    for (auto &component : total)
    {
      const double force = std::exchange(component[slave], 0.);
      constraints.for_each_master(slave, [&](std::uint32_t master, double weight)
                                  { component[master] += weight * force; });
    }
}

/// Tells all ranks of the surface.
template <int dim>
void Solver<dim>::Implementation::show()
{
  if (distribution.alone())
    return;
  std::array<double *, 2 * dim> motion;
  for (int i = 0; i < dim; ++i)
  {
    motion[i]       = nodes.x[i].data();
    motion[dim + i] = nodes.v[i].data();
  }
  distribution.tell(shown, motion);
}

template <int dim>
void Solver<dim>::Implementation::complete_motion()
{
  if (distribution.alone())
    return;
  std::array<double *, 2 * dim> motion;
  for (int i = 0; i < dim; ++i)
  {
    motion[i]       = nodes.x[i].data();
    motion[dim + i] = nodes.v[i].data();
  }
  distribution.tell(distribution.all_nodes(), motion);
}

template <int dim>
void Solver<dim>::refresh_all()
{
  self_->complete_motion();
}

namespace
{
/// A culprit as ranks tell it.
struct Word
{
  double       dt  = 0;
  int          bad = 0, body = -1;
  std::int64_t id         = -1;
  double       where[3]   = {};
  char         entity[24] = {}, why[104] = {};

  Word() = default;
  Word(const Culprit &c, double limit, bool fails)
      : dt(limit), bad(fails), body(c.body), id(c.id), where{c.where[0], c.where[1], c.where[2]}
  {
    std::strncpy(entity, c.entity, sizeof(entity) - 1);
    std::strncpy(why, c.why, sizeof(why) - 1);
  }
  Culprit culprit() const
  {
    static std::set<std::string> words; // Culprit keeps pointers
    Culprit                      c;
    c.entity = words.emplace(entity).first->c_str();
    c.why    = words.emplace(why).first->c_str();
    c.body   = body;
    c.id     = id;
    c.where  = {where[0], where[1], where[2]};
    return c;
  }
};
} // namespace

/// The least of all ranks; of equals the one with the lowest number.
template <int dim>
StepLimit Solver<dim>::Implementation::agree(const StepLimit &own) const
{
  if (distribution.alone())
    return own;
  Word least;
  least.dt = std::numeric_limits<double>::infinity();
  for (const Word &word : distribution.ranks().gather_one(Word(numbered(own.culprit), own.dt, false)))
    if (word.dt < least.dt || (word.dt == least.dt && word.id < least.id))
      least = word;
  StepLimit limit;
  limit.dt      = least.dt;
  limit.culprit = least.culprit();
  return limit;
}

/// One rank's failure is everyone's.
template <int dim>
StepStatus Solver<dim>::Implementation::agree(const StepStatus &own) const
{
  StepStatus all;
  Word       first;
  for (const Word &word : distribution.ranks().gather_one(Word(numbered(own.culprit), 0., !own.ok)))
    if (word.bad && (all.ok || word.id < first.id))
    {
      first  = word;
      all.ok = false;
    }
  all.culprit = first.culprit();
  return all;
}

/// A group of this rank counts its own elements only.
template <int dim>
Culprit Solver<dim>::Implementation::numbered(Culprit c) const
{
  if (std::string(c.entity) != "element" || c.id < 0)
    return c;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g]->body() == c.body)
    {
      const std::size_t local = static_cast<std::size_t>(c.id) - parts[g].first_element;
      c.id                    = groups[g]->size() == 0
                                    ? -1
                                    : static_cast<std::int64_t>(parts[g].first_element + distribution.global(g, local));
    }
  return c;
}

/// The end of a step on all ranks.
template <int dim>
StepStatus Solver<dim>::Implementation::conclude(const StepStatus &advanced)
{
  if (distribution.alone())
    return advanced.ok ? review() : advanced;
  const StepStatus                      own = advanced.ok ? check_nodes() : advanced;
  std::vector<std::vector<std::size_t>> failed;
  bool                                  dead = false;
  if (own.ok && erosion.any())
  {
    erosion.find_failed(groups, failed);
    dead = std::any_of(failed.begin(), failed.end(), [](const auto &f) { return !f.empty(); });
  }
  double news[] = {own.ok ? 0. : 1., dead ? 1. : 0.};
  distribution.ranks().max(std::span<double>(news));
  if (news[0] > 0)
    return agree(own);
  if (news[1] > 0)
    bury(failed);
  if (parameters.options.step_bound == "power-iteration")
    sharpen();
  look_at_shares();
  return {};
}

/// All ranks book the dead of all, in the order of one.
template <int dim>
void Solver<dim>::Implementation::bury(const std::vector<std::vector<std::size_t>> &failed)
{
  using Death = typename Erosion<dim>::Death;
  auto own    = erosion.kill(groups, failed, nodes);
  for (Death &death : own)
    death.cell = distribution.global(death.group, death.cell);
  auto all = distribution.ranks().gather(own);
  std::sort(all.begin(), all.end(),
            [](const Death &a, const Death &b)
            { return std::pair(a.group, a.cell) < std::pair(b.group, b.cell); });
  std::vector<bool> touched(groups.size(), false);
  for (const Death &death : all)
  {
    erosion.book(death, nodes);
    distribution.bury(death.group, death.cell);
    touched[death.group] = true;
  }
  for (std::size_t g = 0; g < touched.size(); ++g)
    if (touched[g])
      groups[g]->sum_forces();
  complete_forces();
  review_erosion();
}

template <int dim>
void Solver<dim>::Implementation::count_the_living()
{
  if (distribution.alone())
    return;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    std::vector<char> own(groups[g]->cells());
    for (std::size_t e = 0; e < own.size(); ++e)
      own[e] = groups[g]->alive(e);
    std::vector<std::size_t> first;
    const auto               each = distribution.ranks().gather(own, &first);
    std::vector<char>        alive(each.size());
    for (std::size_t e = 0; e < alive.size(); ++e)
      alive[e] = each[first[distribution.owner(g, e)] + distribution.local(g, e)];
    distribution.set_alive(g, std::move(alive));
  }
}

template <int dim>
Balance Solver<dim>::Implementation::sum(const Balance &own) const
{
  if (distribution.alone())
    return own;
  Balance             all = own;
  std::vector<double> values;
  const auto          visit = [&all](auto &&f)
  {
    for (double *x : {&all.mass, &all.kinetic, &all.elastic, &all.plastic_work, &all.viscosity_heat,
                      &all.bulk_viscosity_heat, &all.hourglass_fem, &all.hourglass_sph, &all.external_work,
                      &all.wall_loss, &all.friction_heat, &all.absorbed, &all.thermal, &all.eroded_mass,
                      &all.eroded_energy, &all.eroded_elements, &all.gradient_fallbacks})
      f(*x);
    for (Vec3 *v : {&all.momentum, &all.angular_momentum, &all.external_impulse, &all.eroded_momentum,
                    &all.eroded_angular_momentum})
      for (int i = 0; i < 3; ++i)
        f((*v)[i]);
  };
  visit([&](double x) { values.push_back(x); });
  distribution.ranks().sum(std::span<double>(values));
  visit([next = values.begin()](double &x) mutable { x = *next++; });
  return all;
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void       Solver<d>::Implementation::add_up(std::size_t, std::size_t);                           \
  template void       Solver<d>::Implementation::complete_forces();                                          \
  template void       Solver<d>::Implementation::fold_total();                                               \
  template void       Solver<d>::Implementation::show();                                                     \
  template void       Solver<d>::Implementation::complete_motion();                                          \
  template void       Solver<d>::refresh_all();                                                              \
  template StepLimit  Solver<d>::Implementation::agree(const StepLimit &) const;                             \
  template StepStatus Solver<d>::Implementation::conclude(const StepStatus &);                               \
  template void       Solver<d>::Implementation::count_the_living();                                         \
  template Balance    Solver<d>::Implementation::sum(const Balance &) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
