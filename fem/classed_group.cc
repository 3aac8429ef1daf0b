// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/classed_group.h"

#include <algorithm>
#include <numeric>

namespace ogive::fem
{
template <int dim>
ClassedGroup<dim>::ClassedGroup(BodyMesh<dim> mesh, const GroupPlace &place, const input::FemOptions &options,
                                std::unique_ptr<ElementGroup<dim>> whole)
  : body_(mesh.body)
  , mesh_(std::move(mesh))
  , place_(place)
  , options_(options)
  , layout_(mesh_.n_cells(), 0)
  , state_(mesh_.n_cells(), 0.)
{
  require(whole->steps_locally() && !mesh_.loses_elements(), "elements of this body step alike");
  std::vector<std::uint32_t> all(mesh_.n_cells());
  std::iota(all.begin(), all.end(), 0u);
  for (std::uint32_t e = 0; e < all.size(); ++e)
    where_.push_back({0, e});
  classes_[0] = {std::move(whole), std::move(all), place.first_node};
}

/// A group of some elements of the body; its nodes are a stretch of the body's.
template <int dim>
auto ClassedGroup<dim>::build(const std::vector<std::uint32_t> &elements) const -> Class
{
  std::uint32_t first = mesh_.cells.at(elements.front() * corners), last = first;
  for (const std::uint32_t e : elements)
    for (int a = 0; a < corners; ++a)
    {
      first = std::min(first, mesh_.cells[e * corners + a]);
      last  = std::max(last, mesh_.cells[e * corners + a]);
    }
  BodyMesh<dim> part;
  part.body         = mesh_.body;
  part.material     = mesh_.material;
  part.axisymmetric = mesh_.axisymmetric;
  part.element      = mesh_.element;
  for (int i = 0; i < dim; ++i)
    part.x[i].assign(mesh_.x[i].begin() + first, mesh_.x[i].begin() + last + 1);
  for (const std::uint32_t e : elements)
    for (int a = 0; a < corners; ++a)
      part.cells.push_back(mesh_.cells[e * corners + a] - first);
  const std::size_t node = place_.first_node + first;
  return {make_element_group<dim>(part, {node, place_.first_element, place_.grave}, options_), elements, node};
}

template <int dim>
void ClassedGroup<dim>::arrange(const std::vector<unsigned char> &layout)
{
  if (layout == layout_)
    return;
  std::array<std::vector<std::uint32_t>, n_classes> elements;
  for (std::uint32_t e = 0; e < layout.size(); ++e)
    elements.at(layout[e]).push_back(e);
  std::array<Class, n_classes> fresh;
  std::vector<Place>           where(layout.size());
  for (std::size_t c = 0; c < n_classes; ++c)
  {
    if (elements[c].empty())
      continue;
    if (elements[c] == classes_[c].elements)
    {
      for (const std::uint32_t e : elements[c])
        where[e] = where_[e];
      continue;
    }
    fresh[c] = build(elements[c]);
    std::array<std::vector<std::pair<std::uint32_t, std::uint32_t>>, n_classes> moves;
    for (std::uint32_t k = 0; k < elements[c].size(); ++k)
    {
      const std::uint32_t e = elements[c][k];
      where[e]              = {static_cast<std::uint32_t>(c), k};
      moves[where_[e].of_class].push_back({where_[e].element, k});
    }
    for (std::size_t from = 0; from < n_classes; ++from)
      if (!moves[from].empty())
        fresh[c].group->take_over(*classes_[from].group, moves[from]);
    fresh[c].group->settle();
  }
  for (std::size_t c = 0; c < n_classes; ++c)
    if (fresh[c].group || elements[c].empty())
      classes_[c] = std::move(fresh[c]);
  where_  = std::move(where);
  layout_ = layout;
  std::copy(layout.begin(), layout.end(), state_.begin());
}

template <int dim>
void ClassedGroup<dim>::collect_bounds(std::vector<double> &of) const
{
  of.resize(size());
  for_each_class([&](const Class &c) {
    const auto bounds = c.group->bounds();
    for (std::size_t k = 0; k < c.elements.size(); ++k)
      of[c.elements[k]] = bounds[k];
  });
}

template <int dim>
Culprit ClassedGroup<dim>::renamed(Culprit culprit, std::size_t c) const
{
  const auto first = static_cast<std::int64_t>(place_.first_element);
  if (culprit.id >= first)
    culprit.id = first + classes_[c].elements.at(static_cast<std::size_t>(culprit.id - first));
  return culprit;
}

template <int dim>
StepStatus ClassedGroup<dim>::advance_class(std::size_t c, const Nodes<dim> &nodes, const TimeStep &step)
{
  StepStatus status = classes_[c].group->advance(nodes, step);
  status.culprit    = renamed(status.culprit, c);
  return status;
}

template <int dim>
StepLimit ClassedGroup<dim>::stable_dt_of(std::size_t c) const
{
  StepLimit limit = classes_[c].group->stable_dt();
  limit.culprit   = renamed(limit.culprit, c);
  return limit;
}

template <int dim>
StepStatus ClassedGroup<dim>::advance(const Nodes<dim> &nodes, const TimeStep &step)
{
  for (std::size_t c = 0; c < n_classes; ++c)
    if (classes_[c].group)
      if (const StepStatus status = advance_class(c, nodes, step); !status.ok)
        return status;
  return {};
}

template <int dim>
StepLimit ClassedGroup<dim>::stable_dt() const
{
  StepLimit limit;
  for (std::size_t c = 0; c < n_classes; ++c)
    if (classes_[c].group)
      limit.tighten(stable_dt_of(c));
  return limit;
}

template <int dim>
auto ClassedGroup<dim>::nodes(std::size_t e) const -> std::array<std::uint32_t, corners>
{
  return classes_[where_[e].of_class].group->nodes(where_[e].element);
}

template <int dim>
std::span<const double> ClassedGroup<dim>::nodal_forces(int) const
{
  require(false, "forces of classes are summed by who steps them");
  return {};
}

template <int dim>
void ClassedGroup<dim>::for_each_node(const NodeVisitor &visit) const
{
  std::size_t before = 0;
  for_each_class([&](const Class &c) {
    c.group->for_each_node([&](std::uint32_t node, std::size_t at) { visit(node, before + at); });
    before += padded(c.elements.size()) * corners * dim;
  });
}

template <int dim>
void ClassedGroup<dim>::tangent(const Nodes<dim> &nodes, const std::array<AlignedVector<double>, dim> &u,
                                AlignedVector<double> &stiff, AlignedVector<double> &damp) const
{
  AlignedVector<double> k, c;
  stiff.clear();
  damp.clear();
  for_each_class([&](const Class &one) {
    one.group->tangent(nodes, u, k, c);
    stiff.insert(stiff.end(), k.begin(), k.end());
    damp.insert(damp.end(), c.begin(), c.end());
  });
}

template <int dim>
void ClassedGroup<dim>::lump_mass(Nodes<dim> &nodes) const
{
  for_each_class([&](const Class &c) { c.group->lump_mass(nodes); });
}

template <int dim>
void ClassedGroup<dim>::initialise(const Nodes<dim> &nodes)
{
  for_each_class([&](const Class &c) { c.group->initialise(nodes); });
}

template <int dim>
double ClassedGroup<dim>::added_mass() const
{
  double sum = 0;
  for_each_class([&](const Class &c) { sum += c.group->added_mass(); });
  return sum;
}

template <int dim>
void ClassedGroup<dim>::add_energies(Balance &balance) const
{
  for_each_class([&](const Class &c) { c.group->add_energies(balance); });
}

template <int dim>
void ClassedGroup<dim>::sample(const Nodes<dim> &nodes, Sample &out) const
{
  const std::size_t n   = size();
  out.nodes_per_cell    = corners;
  const auto fields_of = [](Sample &s) {
    std::vector<std::vector<double> *> all;
    for (auto *triple : {&s.centre, &s.centre0})
      for (auto &component : *triple)
        all.push_back(&component);
    for (auto &component : s.sigma)
      all.push_back(&component);
    for (auto *field : {&s.density, &s.energy, &s.plastic_strain, &s.damage, &s.temperature, &s.volume})
      all.push_back(field);
    return all;
  };
  const auto mine = fields_of(out);
  for (auto *field : mine)
    field->assign(n, 0.);
  out.cells.resize(n * corners);
  for_each_class([&](const Class &c) {
    Sample part;
    c.group->sample(nodes, part);
    const auto theirs = fields_of(part);
    for (std::size_t k = 0; k < c.elements.size(); ++k)
    {
      const std::size_t e = c.elements[k];
      for (std::size_t f = 0; f < mine.size(); ++f)
        (*mine[f])[e] = (*theirs[f])[k];
      std::copy_n(part.cells.begin() + static_cast<std::ptrdiff_t>(k * corners), corners,
                  out.cells.begin() + static_cast<std::ptrdiff_t>(e * corners));
    }
  });
}

/// The layout comes first: whoever reads a state finds the groups that it has.
template <int dim>
void ClassedGroup<dim>::for_each_state(const Visitor &visit)
{
  visit("class", state_);
  arrange({state_.begin(), state_.end()});
  for (std::size_t c = 0; c < n_classes; ++c)
    if (classes_[c].group)
      classes_[c].group->for_each_state([&](const std::string &name, AlignedVector<double> &a) {
        visit("class" + std::to_string(c) + "/" + name, a);
      });
}

template <int dim>
void ClassedGroup<dim>::copy_state(std::size_t e, materials::Points &to, std::size_t k) const
{
  classes_[where_[e].of_class].group->copy_state(where_[e].element, to, k);
}

template <int dim>
void ClassedGroup<dim>::add_damping_stress(std::size_t e, materials::Points &to, std::size_t k) const
{
  classes_[where_[e].of_class].group->add_damping_stress(where_[e].element, to, k);
}

template <int dim>
void ClassedGroup<dim>::damp(std::span<const std::size_t> elements, double share)
{
  std::array<std::vector<std::size_t>, n_classes> of;
  for (const std::size_t e : elements)
    of[where_[e].of_class].push_back(where_[e].element);
  for (std::size_t c = 0; c < n_classes; ++c)
    if (classes_[c].group)
      classes_[c].group->damp(of[c], share);
}

template <int dim>
void ClassedGroup<dim>::weigh(std::span<const std::size_t> elements, std::span<const double> shares, Nodes<dim> &nodes)
{
  std::array<std::vector<std::size_t>, n_classes> of;
  std::array<std::vector<double>, n_classes>      by;
  for (std::size_t k = 0; k < elements.size(); ++k)
  {
    const Place at = where_[elements[k]];
    of[at.of_class].push_back(at.element);
    by[at.of_class].push_back(shares[k]);
  }
  for (std::size_t c = 0; c < n_classes; ++c)
    if (classes_[c].group)
      classes_[c].group->weigh(of[c], by[c], nodes);
}

template class ClassedGroup<1>;
template class ClassedGroup<2>;
template class ClassedGroup<3>;
} // namespace ogive::fem
