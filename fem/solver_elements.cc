// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/solver_implementation.h"

/// The history of single elements, for the coupling layer.
namespace ogive::fem
{
namespace
{
/// Entry k of all arrays of points, in one row.
std::vector<double> row_of(materials::Points &points, std::size_t k)
{
  std::vector<double> row;
  points.for_each_array([&](const char *, AlignedVector<double> &field) { row.push_back(field[k]); });
  return row;
}

void set_row(materials::Points &points, std::size_t k, const double *row)
{
  points.for_each_array([&](const char *, AlignedVector<double> &field) { field[k] = *row++; });
}
} // namespace

template <int dim>
void Solver<dim>::copy_state(std::uint32_t element, materials::Points &to, std::size_t k) const
{
  const auto &s     = *self_;
  const auto [g, e] = s.find(element);
  if (s.distribution.alone())
    return s.groups[g]->copy_state(e, to, k);
  if (s.distribution.own(g, e))
    s.groups[g]->copy_state(s.distribution.local(g, e), to, k);
  std::vector<double> row = row_of(to, k);
  s.distribution.ranks().broadcast(std::span(row), s.distribution.owner(g, e));
  set_row(to, k, row.data());
}

template <int dim>
void Solver<dim>::copy_pressing_state(std::uint32_t element, materials::Points &to, std::size_t k) const
{
  if (!self_->distribution.alone())
  {
    materials::Points one;
    one.resize(1);
    gather_pressing_states(std::span(&element, 1), one);
    return set_row(to, k, row_of(one, 0).data());
  }
  copy_state(element, to, k);
  const auto [g, e] = self_->find(element);
  self_->groups[g]->add_damping_stress(e, to, k);
}

template <int dim>
void Solver<dim>::gather_pressing_states(std::span<const std::uint32_t> elements, materials::Points &to) const
{
  const auto &s = *self_;
  require(to.size() >= elements.size(), "room for the state of each element");
  if (s.distribution.alone())
  {
    for (std::size_t k = 0; k < elements.size(); ++k)
      copy_pressing_state(elements[k], to, k);
    return;
  }
  std::vector<double> own;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (const auto [g, e] = s.find(elements[k]); s.distribution.own(g, e))
    {
      s.groups[g]->copy_state(s.distribution.local(g, e), to, k);
      s.groups[g]->add_damping_stress(s.distribution.local(g, e), to, k);
      const auto row = row_of(to, k);
      own.insert(own.end(), row.begin(), row.end());
    }
  std::vector<std::size_t> next;
  const auto               all = s.distribution.ranks().gather(own, &next);
  for (std::size_t k = 0; k < elements.size(); ++k)
  {
    const auto [g, e] = s.find(elements[k]);
    std::size_t &at   = next[s.distribution.owner(g, e)];
    set_row(to, k, &all[at]);
    at += row_of(to, k).size();
  }
}

template <int dim>
void Solver<dim>::damp(int body, std::span<const std::uint32_t> elements, double share)
{
  auto &s = *self_;
  std::erase_if(s.damped, [body](const auto &order) { return order.body == body; });
  if (!s.distribution.alone())
    s.damped.push_back({body, {elements.begin(), elements.end()}, {share}});
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    if (s.groups[g]->body() == body)
      s.groups[g]->damp(s.own_of(g, elements), share);
}

template <int dim>
void Solver<dim>::weigh(int body, std::span<const std::uint32_t> elements, std::span<const double> shares)
{
  auto &s = *self_;
  if (!s.constraints.empty())
    throw InputError({"", 0, "Interfaces"},
                     "elements of tied meshes cannot share their material with particles",
                     "no ties between bodies of elements");
  if (!s.distribution.alone())
    s.weighed.push_back({body, {elements.begin(), elements.end()}, {shares.begin(), shares.end()}});
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    if (s.distribution.alone())
    {
      s.groups[g]->weigh(s.own_of(g, elements), shares, s.nodes);
      continue;
    }
    // What each rank takes from the nodes, added up.
    const AlignedVector<double> before = s.nodes.mass;
    std::fill(s.nodes.mass.begin(), s.nodes.mass.end(), 0.);
    s.weigh_own(g, elements, shares);
    s.add_up(s.parts[g].first_node, s.parts[g].last_node);
    for (std::size_t a = 0; a < before.size(); ++a)
      s.nodes.mass[a] += before[a];
  }
}

/// Of these elements those of this rank, by their numbers in the group.
template <int dim>
std::vector<std::size_t> Solver<dim>::Implementation::own_of(std::size_t                    g,
                                                             std::span<const std::uint32_t> elements) const
{
  std::vector<std::size_t> own;
  for (const std::uint32_t element : elements)
  {
    const std::size_t e = element - parts[g].first_element;
    if (distribution.alone())
      own.push_back(e);
    else if (distribution.own(g, e))
      own.push_back(distribution.local(g, e));
  }
  return own;
}

template <int dim>
void Solver<dim>::Implementation::weigh_own(std::size_t g, std::span<const std::uint32_t> elements,
                                            std::span<const double> shares)
{
  std::vector<double> own;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (distribution.own(g, elements[k] - parts[g].first_element))
      own.push_back(shares[k]);
  groups[g]->weigh(own_of(g, elements), own, nodes);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::copy_state(std::uint32_t, materials::Points &, std::size_t) const;                \
  template void Solver<d>::copy_pressing_state(std::uint32_t, materials::Points &, std::size_t) const;       \
  template void Solver<d>::gather_pressing_states(std::span<const std::uint32_t>, materials::Points &)       \
      const;                                                                                                 \
  template void Solver<d>::damp(int, std::span<const std::uint32_t>, double);                                \
  template void Solver<d>::weigh(int, std::span<const std::uint32_t>, std::span<const double>);              \
  template std::vector<std::size_t> Solver<d>::Implementation::own_of(std::size_t,                           \
                                                                      std::span<const std::uint32_t>) const; \
  template void Solver<d>::Implementation::weigh_own(std::size_t, std::span<const std::uint32_t>,            \
                                                     std::span<const double>);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
