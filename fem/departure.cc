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
  require(element - parts[g].first_element < all().cells(g), "no such element");
  return {g, element - parts[g].first_element};
}

template <int dim>
std::pair<std::uint32_t, std::uint32_t> Solver<dim>::elements_of(int body) const
{
  const auto &s = *self_;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    if (s.groups[g]->body() == body)
      return {static_cast<std::uint32_t>(s.parts[g].first_element),
              static_cast<std::uint32_t>(s.parts[g].first_element + s.all().elements(g))};
  return {0, 0};
}

template <int dim>
std::vector<double> Solver<dim>::conversion_measures(int body, const input::Conversion &when) const
{
  const auto         &s = *self_;
  std::vector<double> of;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    s.groups[g]->measure(when, of);
    if (s.distribution.alone())
      continue;
    const auto              &all = s.distribution.bodies()[g];
    std::vector<std::size_t> first;
    const auto               each = s.distribution.ranks().gather(of, &first);
    of.resize(all.owner.size());
    for (std::size_t e = 0; e < of.size(); ++e)
      of[e] = each[first[all.owner[e]] + all.place[e]];
  }
  return of;
}

template <int dim>
bool Solver<dim>::alive(std::uint32_t element) const
{
  const auto at = self_->find(element);
  return self_->all().alive(at.group, at.element);
}

template <int dim>
Departure<dim> Solver<dim>::look(std::uint32_t element) const
{
  return look(std::span(&element, 1)).front();
}

template <int dim>
std::vector<Departure<dim>> Solver<dim>::look(std::span<const std::uint32_t> elements) const
{
  const auto &s = *self_;
  return s.departures(elements, [&s](std::size_t g, std::size_t e) { return s.groups[g]->remains(e); });
}

/// Describes elements by their owners; remains_of(group, element of the group) is called
/// where they are.
template <int dim>
template <class F>
std::vector<Departure<dim>> Solver<dim>::Implementation::departures(std::span<const std::uint32_t> elements,
                                                                    F &&remains_of) const
{
  std::vector<Departure<dim>> own, gone;
  for (const std::uint32_t element : elements)
  {
    const auto at = find(element);
    if (distribution.alone())
      own.push_back(describe(nodes, *groups[at.group], at.element, remains_of(at.group, at.element)));
    else if (distribution.own(at.group, at.element))
    {
      const std::size_t e = distribution.local(at.group, at.element);
      own.push_back(describe(nodes, *groups[at.group], e, remains_of(at.group, e)));
    }
  }
  if (distribution.alone())
    return own;
  std::vector<std::size_t> next;
  const auto               each = distribution.ranks().gather(own, &next);
  for (const std::uint32_t element : elements)
  {
    const auto at = find(element);
    gone.push_back(each[next[distribution.owner(at.group, at.element)]++]);
  }
  return gone;
}

template <int dim>
std::vector<Departure<dim>> Solver<dim>::take_out(std::span<const std::uint32_t> elements)
{
  auto &s = *self_;
  auto  gone = s.departures(elements, [&s](std::size_t g, std::size_t e) {
    require(s.groups[g]->alive(e), "an element leaves once");
    return s.groups[g]->kill(e);
  });
  std::vector<bool> touched(s.groups.size(), false);
  for (std::size_t k = 0; k < gone.size(); ++k)
  {
    const auto at = s.find(elements[k]);
    s.erosion.release(gone[k].node, s.nodes, gone[k].mass);
    s.know(gone[k].node, gone[k].x, gone[k].v);
    if (!s.distribution.alone())
      s.distribution.bury(at.group, at.element);
    touched[at.group] = true;
  }
  for (std::size_t g = 0; g < touched.size(); ++g)
    if (touched[g])
      s.groups[g]->sum_forces();
  s.complete_forces();
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
