// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/embedding.h"
#include "fem/solver_implementation.h"

#include <Eigen/Geometry>

#include <algorithm>

/// What the solver tells others, and its memory.
namespace ogive::fem
{
template <int dim>
Surface<dim> Solver<dim>::surface()
{
  auto        &s   = *self_;
  Surface<dim> out = s.face;
  out.n            = s.nodes.size();
  for (int i = 0; i < dim; ++i)
  {
    out.x[i]     = s.nodes.x[i];
    out.v[i]     = s.local.on ? s.local.seen[i] : s.nodes.v[i];
    out.force[i] = s.nodes.force[i];
  }
  out.mass     = s.nodes.mass;
  out.body     = s.nodes.body;
  out.id       = s.nodes.id;
  return out;
}

template <int dim>
Balance Solver<dim>::balance() const
{
  const auto &s = *self_;
  Balance     b;
  for (const auto &group : s.groups)
    group->add_energies(b);
  for (std::size_t a = 0; a < s.nodes.size(); ++a)
  {
    if (s.constraints.is_slave(a)) // its mass is with its masters
      continue;
    const double m = s.nodes.mass[a];
    Vec3         x = Vec3::Zero(), v = Vec3::Zero();
    for (int i = 0; i < dim; ++i)
    {
      x[i] = s.nodes.x[i][a];
      v[i] = s.nodes.v[i][a];
    }
    b.mass += m;
    b.kinetic += .5 * m * v.squaredNorm();
    if (s.parameters.axisymmetric) // the radial momenta of a ring cancel
      b.momentum[1] += m * v[1];
    else
    {
      b.momentum += m * v;
      b.angular_momentum += m * x.cross(v);
    }
  }
  s.add_owed(b);
  s.erosion.add(b);
  b.external_work = s.work.external;
  b.wall_loss     = s.work.wall_loss;
  b.friction_heat = s.work.friction;
  b.absorbed      = s.work.absorbed;
  for (int i = 0; i < dim; ++i)
    if (!(s.parameters.axisymmetric && i == 0))
      b.external_impulse[i] = s.work.impulse[i];
  return b;
}

template <int dim>
void Solver<dim>::snapshot()
{
  auto       &s = *self_;
  std::size_t k = 0;
  s.for_each_state([&](const std::string &, AlignedVector<double> &a) {
    if (k == s.mark.size())
      s.mark.emplace_back();
    s.mark[k++] = a;
  });
}

template <int dim>
void Solver<dim>::restore()
{
  auto &s = *self_;
  require(!s.mark.empty(), "restore without a snapshot");
  std::size_t k = 0;
  s.for_each_state([&](const std::string &, AlignedVector<double> &a) {
    // In place: spans of the surface stay valid.
    std::copy(s.mark[k].begin(), s.mark[k].end(), a.begin());
    ++k;
  });
  s.state_was_changed();
}

template <int dim>
void Solver<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  auto &s = *self_;
  s.for_each_state([&](const std::string &name, AlignedVector<double> &a) {
    archive.write(prefix + "/" + name, std::span<const double>(a.data(), a.size()));
  });
  archive.write(prefix + "/updates", static_cast<std::int64_t>(s.updates));
}

template <int dim>
void Solver<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  auto &s = *self_;
  s.for_each_state([&](const std::string &name, AlignedVector<double> &a) {
    const std::vector<double> values = archive.doubles(prefix + "/" + name);
    if (values.size() != a.size())
      throw InputError("checkpoint entry \"" + prefix + "/" + name + "\" has " + std::to_string(values.size()) +
                       " values where the scene's mesh needs " + std::to_string(a.size()));
    std::copy(values.begin(), values.end(), a.begin());
  });
  s.updates = static_cast<std::uint64_t>(archive.integer(prefix + "/updates"));
  s.state_was_changed();
}

namespace
{
template <class T>
void keep(std::vector<T> &values, const std::vector<bool> &wanted)
{
  if (values.empty())
    return;
  const std::size_t each = values.size() / wanted.size();
  std::size_t       kept = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (wanted[k / each])
      values[kept++] = values[k];
  values.resize(kept);
}

/// Takes dead elements out of a sample, and the nodes that have no others.
template <int dim>
void keep_the_living(const ElementGroup<dim> &group, Sample &sample)
{
  std::vector<bool> alive(group.size()), used(sample.mass.size(), false);
  for (std::size_t e = 0; e < alive.size(); ++e)
    alive[e] = group.alive(e);
  keep(sample.cells, alive);
  for (const std::uint32_t node : sample.cells)
    used[node] = true;
  std::vector<std::uint32_t> now(used.size());
  for (std::size_t a = 0, n = 0; a < used.size(); ++a)
    now[a] = used[a] ? static_cast<std::uint32_t>(n++) : 0;
  for (std::uint32_t &node : sample.cells)
    node = now[node];
  for (int i = 0; i < 3; ++i)
  {
    for (auto *field : {&sample.x[i], &sample.x0[i], &sample.v[i]})
      keep(*field, used);
    keep(sample.centre[i], alive);
    keep(sample.centre0[i], alive);
  }
  keep(sample.mass, used);
  keep(sample.radius, used);
  keep(sample.id, used);
  for (auto &component : sample.sigma)
    keep(component, alive);
  for (auto *field : {&sample.density, &sample.energy, &sample.plastic_strain, &sample.damage, &sample.temperature,
                      &sample.volume})
    keep(*field, alive);
}
} // namespace

template <int dim>
Sample Solver<dim>::sample(int body) const
{
  const auto &s = *self_;
  Sample      out;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    const std::size_t first = s.parts[g].first_node, last = s.parts[g].last_node;
    out.is_mesh             = true;
    for (int i = 0; i < 3; ++i)
      if (i < dim)
      {
        out.x[i].assign(s.nodes.x[i].begin() + first, s.nodes.x[i].begin() + last);
        out.x0[i].assign(s.nodes.x0[i].begin() + first, s.nodes.x0[i].begin() + last);
        out.v[i].assign(s.nodes.v[i].begin() + first, s.nodes.v[i].begin() + last);
      }
      else
        for (auto *field : {&out.x[i], &out.x0[i], &out.v[i]})
          field->assign(last - first, 0.);
    for (std::size_t a = first; a < last; ++a)
      out.mass.push_back(s.constraints.own_mass(s.nodes, a));
    out.radius.assign(last - first, 0.);
    out.id.assign(s.nodes.id.begin() + first, s.nodes.id.begin() + last);
    s.groups[g]->sample(s.nodes, out);
    if (s.erosion.any())
      keep_the_living(*s.groups[g], out);
  }
  return out;
}

template <int dim>
std::size_t Solver<dim>::size() const
{
  std::size_t n = 0;
  for (const auto &group : self_->groups)
    n += group->size();
  return n;
}

template <int dim>
std::uint64_t Solver<dim>::updates() const
{
  return self_->updates;
}

template <int dim>
void Solver<dim>::add_mass(std::uint32_t node, double mass)
{
  auto        &s      = *self_;
  const double before = s.nodes.mass.at(node);
  s.constraints.add_mass(s.nodes, node, mass);
  const auto [at, fresh] = s.mass_factor.try_emplace(node, 1.);
  at->second *= s.nodes.mass[node] / before;
  s.least_factor = 1;
  for (const auto &[n, factor] : s.mass_factor)
    s.least_factor = std::min(s.least_factor, factor);
}

template <int dim>
const std::vector<TieReport> &Solver<dim>::ties() const
{
  return self_->constraints.ties();
}

template <int dim>
auto Solver<dim>::added_masses() const -> std::vector<AddedMass>
{
  return self_->added_masses;
}

template <int dim>
double Solver<dim>::wall_force(std::size_t w) const
{
  return self_->walls.force(w);
}

template <int dim>
bool Solver<dim>::embed(std::uint32_t element, const std::array<double, dim> &point, double reach,
                        Embedding &out) const
{
  const auto       &s = *self_;
  const auto [g, e]   = s.find(element);
  out.node            = s.groups[g]->nodes(e);
  std::array<std::array<double, dim>, Embedding::n_nodes> x;
  for (int a = 0; a < Embedding::n_nodes; ++a)
    for (int i = 0; i < dim; ++i)
      x[a][i] = s.nodes.x[i][out.node[a]];
  return weights_of_point<dim>(x, point, reach, out.weight);
}

template <int dim>
auto Solver<dim>::cells(int body) const -> Cells
{
  const auto &s = *self_;
  Cells       all;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    for (std::size_t e = 0; s.groups[g]->body() == body && e < s.groups[g]->cells(); ++e)
      if (s.groups[g]->alive(e))
      {
        all.element.push_back(static_cast<std::uint32_t>(s.parts[g].first_element + e));
        all.node.push_back(s.groups[g]->nodes(e));
      }
  return all;
}

template <int dim>
void Solver<dim>::copy_state(std::uint32_t element, materials::Points &to, std::size_t k) const
{
  const auto [g, e] = self_->find(element);
  self_->groups[g]->copy_state(e, to, k);
}

template <int dim>
void Solver<dim>::copy_pressing_state(std::uint32_t element, materials::Points &to, std::size_t k) const
{
  copy_state(element, to, k);
  const auto [g, e] = self_->find(element);
  self_->groups[g]->add_damping_stress(e, to, k);
}

template <int dim>
void Solver<dim>::damp(int body, std::span<const std::uint32_t> elements, double share)
{
  auto &s = *self_;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    std::vector<std::size_t> own;
    for (const std::uint32_t e : elements)
      own.push_back(e - s.parts[g].first_element);
    s.groups[g]->damp(own, share);
  }
}

template <int dim>
void Solver<dim>::weigh(int body, std::span<const std::uint32_t> elements, std::span<const double> shares)
{
  auto &s = *self_;
  if (!s.constraints.empty())
    throw InputError({"", 0, "Interfaces"}, "elements of tied meshes cannot share their material with particles",
                     "no ties between bodies of elements");
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    std::vector<std::size_t> own;
    for (const std::uint32_t e : elements)
      own.push_back(e - s.parts[g].first_element);
    s.groups[g]->weigh(own, shares, s.nodes);
  }
}

template class Solver<1>;
template class Solver<2>;
template class Solver<3>;
} // namespace ogive::fem
