// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/departure.h"

#include "fem/solver_implementation.h"

#include <algorithm>

/// Elements that turn into particles, seen from the mesh.
namespace ogive::fem
{
namespace
{
template <int dim>
Departure<dim> describe(const Nodes<dim> &nodes, const ElementGroup<dim> &group, std::size_t e,
                        const typename ElementGroup<dim>::Remains &remains)
{
  Departure<dim> d;
  d.node = group.nodes(e);
  for (int a = 0; a < Departure<dim>::corners; ++a)
    for (int i = 0; i < dim; ++i)
    {
      d.x0[a][i] = nodes.x0[i][d.node[a]];
      d.x[a][i]  = nodes.x[i][d.node[a]];
      d.v[a][i]  = nodes.v[i][d.node[a]];
    }
  d.mass         = remains.mass;
  d.internal     = remains.internal_energy;
  d.hourglass    = remains.hourglass_energy;
  d.plastic_work = remains.plastic_work;
  return d;
}
} // namespace

template <int dim>
auto Solver<dim>::Implementation::find(std::uint32_t element) const -> Place
{
  std::size_t g = 0;
  while (g + 1 < parts.size() && element >= parts[g + 1].first_element)
    ++g;
  require(element - parts[g].first_element < groups[g]->cells(), "no such element");
  return {g, element - parts[g].first_element};
}

template <int dim>
std::pair<std::uint32_t, std::uint32_t> Solver<dim>::elements_of(int body) const
{
  const auto &s = *self_;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    if (s.groups[g]->body() == body)
      return {static_cast<std::uint32_t>(s.parts[g].first_element),
              static_cast<std::uint32_t>(s.parts[g].first_element + s.groups[g]->size())};
  return {0, 0};
}

template <int dim>
std::vector<double> Solver<dim>::conversion_measures(int body, const input::Conversion &when) const
{
  std::vector<double> of;
  for (const auto &group : self_->groups)
    if (group->body() == body)
      group->measure(when, of);
  return of;
}

template <int dim>
bool Solver<dim>::alive(std::uint32_t element) const
{
  const auto at = self_->find(element);
  return self_->groups[at.group]->alive(at.element);
}

template <int dim>
Departure<dim> Solver<dim>::look(std::uint32_t element) const
{
  const auto  at    = self_->find(element);
  const auto &group = *self_->groups[at.group];
  return describe(self_->nodes, group, at.element, group.remains(at.element));
}

template <int dim>
std::vector<Departure<dim>> Solver<dim>::take_out(std::span<const std::uint32_t> elements)
{
  auto                       &s = *self_;
  std::vector<Departure<dim>> gone;
  std::vector<bool>           touched(s.groups.size(), false);
  for (const std::uint32_t element : elements)
  {
    const auto at    = s.find(element);
    auto      &group = *s.groups[at.group];
    require(group.alive(at.element), "an element leaves once");
    const auto remains = s.erosion.take_out(group, at.element, s.nodes);
    gone.push_back(describe(s.nodes, group, at.element, remains));
    touched[at.group] = true;
  }
  for (std::size_t g = 0; g < touched.size(); ++g)
    if (touched[g])
      s.groups[g]->sum_forces();
  s.review_erosion();
  return gone;
}

template <int dim>
std::size_t Solver<dim>::converted_elements() const
{
  return self_->erosion.converted_elements();
}

template class Solver<1>;
template class Solver<2>;
template class Solver<3>;
} // namespace ogive::fem
