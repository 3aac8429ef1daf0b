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
    out.v[i]     = s.nodes.v[i];
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
    if (s.constraints.is_slave(a) || !s.nodes.counts(a)) // a slave's mass is with its masters
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
  if (s.distribution.ranks().first()) // all ranks book the dead alike
    s.erosion.add(b);
  b.external_work = s.work.external;
  b.wall_loss     = s.work.wall_loss;
  b.friction_heat = s.work.friction;
  b.absorbed      = s.work.absorbed;
  for (int i = 0; i < dim; ++i)
    if (!(s.parameters.axisymmetric && i == 0))
      b.external_impulse[i] = s.work.impulse[i];
  return s.sum(b);
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
  s.mark_owners = s.distribution.owners();
}

template <int dim>
void Solver<dim>::restore()
{
  auto &s = *self_;
  require(!s.mark.empty(), "restore without a snapshot");
  if (!s.distribution.alone() && s.mark_owners != s.distribution.owners())
    s.rebuild_groups(s.mark_owners);
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
  archive.write(prefix + "/ranks", static_cast<std::int64_t>(s.distribution.ranks().size()));
  if (!s.distribution.alone())
    return s.save_shared(archive, prefix);
  s.for_each_state([&](const std::string &name, AlignedVector<double> &a) {
    archive.write(prefix + "/" + name, std::span<const double>(a.data(), a.size()));
  });
  archive.write(prefix + "/updates", static_cast<std::int64_t>(s.updates));
}

template <int dim>
void Solver<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  auto &s = *self_;
  if (!s.distribution.alone() || archive.integer(prefix + "/ranks") != 1)
    return s.load_shared(archive, prefix);
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

template <int dim>
std::size_t Solver<dim>::size() const
{
  std::size_t n = 0;
  for (std::size_t g = 0; g < self_->groups.size(); ++g)
    n += self_->all().elements(g);
  return n;
}

template <int dim>
std::uint64_t Solver<dim>::updates() const
{
  return self_->updates;
}

template <int dim>
std::uint64_t Solver<dim>::skipped() const
{
  return self_->skipped;
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
  return self_->sum(self_->walls.force(w));
}

template <int dim>
bool Solver<dim>::embed(std::uint32_t element, const std::array<double, dim> &point, double reach,
                        Embedding &out) const
{
  const auto       &s = *self_;
  const auto [g, e]   = s.find(element);
  out.node            = s.all().nodes(g, e);
  std::array<std::array<double, dim>, Embedding::n_nodes> x;
  for (int a = 0; a < Embedding::n_nodes; ++a)
    for (int i = 0; i < dim; ++i)
      x[a][i] = s.nodes.x[i][out.node[a]];
  return weights_of_point<dim>(x, point, reach, out.weight); // of an element at the surface: alike on all ranks
}

template <int dim>
auto Solver<dim>::cells(int body) const -> Cells
{
  const auto &s = *self_;
  Cells       all;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    for (std::size_t e = 0; s.groups[g]->body() == body && e < s.all().cells(g); ++e)
      if (s.all().alive(g, e))
      {
        all.element.push_back(static_cast<std::uint32_t>(s.parts[g].first_element + e));
        all.node.push_back(s.all().nodes(g, e));
      }
  return all;
}

template class Solver<1>;
template class Solver<2>;
template class Solver<3>;
} // namespace ogive::fem
