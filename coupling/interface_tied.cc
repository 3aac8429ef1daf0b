// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface_tied.h"

#include "core/base/error.h"
#include "coupling/contact_geometry.h"
#include "coupling/search.h"

#include <algorithm>
#include <sstream>

namespace ogive::coupling
{
template <int dim>
struct TiedInterface<dim>::Seam
{
  using Facet = typename Surface<dim>::Facet;

  Faces<dim>                 faces;
  std::vector<std::uint32_t> points; ///< of the particle body, by id
  std::vector<Facet>         facets;
  double                     spacing = 0;
  std::vector<double>        slave_mass;

  Seam(const InterfaceSpec &spec, MeshPort<dim> &mesh, ParticlePort<dim> &particles)
    : faces(Faces<dim>::look(&mesh, &particles))
    , facets(true_facets(faces[mesh_party], spec.mesh, spec.symmetry_axes))
  {
    const auto &surface = faces[particle_party];
    for (std::uint32_t i = 0; i < surface.n; ++i)
      if (surface.body[i] == spec.particles)
      {
        points.push_back(i);
        spacing = std::max(spacing, 2 * faces.radius(particle_party, i));
      }
    std::sort(points.begin(), points.end(), [&](auto i, auto j) { return surface.id[i] < surface.id[j]; });
  }

  Foot<dim> foot(std::uint32_t i, const Facet &facet) const
  {
    std::array<Point<dim>, Facet::n_nodes> corner;
    for (int k = 0; k < Facet::n_nodes; ++k)
      corner[k] = faces.position(mesh_party, facet.node[k]);
    return foot_on_facet<dim>(faces.position(particle_party, i), corner, facet.outward);
  }

  NeighbourList<dim> near_facets() const
  {
    std::vector<Box<dim>> queries(points.size()), targets(facets.size());
    for (std::size_t q = 0; q < points.size(); ++q)
    {
      queries[q].include(faces.position(particle_party, points[q]));
      queries[q].inflate(spacing);
    }
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (const std::uint32_t i : facets[f].node)
        targets[f].include(faces.position(mesh_party, i));
    NeighbourList<dim> list;
    list.build(queries, targets);
    return list;
  }

  double nearest_distance() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : points)
      for (const auto &facet : facets)
        least = std::min(least, std::sqrt(foot(i, facet).distance2));
    return least;
  }
};

namespace
{
// Layers of a lattice on a flat seam stand .5, 1.5, ... spacings away.
constexpr double layer_depth = 1;
// Rounding of coordinates must not decide on a particle exactly in between.
constexpr double layer_tolerance = 1e-6;

InputError nobody_at_seam(const InterfaceSpec &spec, double distance, double spacing)
{
  std::ostringstream message;
  message << "interface \"" << spec.name << "\": no particle of body \"" << spec.particle_body
          << "\" lies within one spacing (" << spacing << " m) of the surface of body \"" << spec.mesh_body
          << "\"; the nearest is " << distance << " m away";
  return InputError({"", 0, "Interfaces/" + spec.name}, message.str());
}
} // namespace

template <int dim>
TiedInterface<dim>::TiedInterface(const InterfaceSpec &spec, MeshPort<dim> &mesh, ParticlePort<dim> &particles,
                                  Slaves<dim> &slaves)
  : first_(slaves.id.size())
{
  Seam seam(spec, mesh, particles);
  choose(spec, seam, mesh, slaves);
  if (embedding_.empty())
    throw nobody_at_seam(spec, seam.nearest_distance(), seam.spacing);
  give_mass(spec, seam, mesh);
  this->follow(spec, mesh);
}

template <int dim>
void TiedInterface<dim>::follow(const InterfaceSpec &spec, MeshPort<dim> &mesh) const
{
  std::vector<std::uint32_t> nodes;
  for (const auto &embedding : embedding_)
    nodes.insert(nodes.end(), embedding.node.begin(), embedding.node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  mesh.follow(spec.name, nodes);
}

template <int dim>
void TiedInterface<dim>::choose(const InterfaceSpec &spec, Seam &seam, MeshPort<dim> &mesh,
                                Slaves<dim> &slaves)
{
  const auto   list  = seam.near_facets();
  const auto  &cloud = seam.faces[particle_party];
  const double limit = (layer_depth - layer_tolerance) * seam.spacing;
  for (std::size_t q = 0; q < seam.points.size(); ++q)
  {
    const std::uint32_t                           i = seam.points[q];
    std::vector<std::pair<double, std::uint32_t>> by_distance;
    for (const std::uint32_t f : list.of(q))
    {
      const double distance = std::sqrt(seam.foot(i, seam.facets[f]).distance2);
      if (distance < limit)
        by_distance.emplace_back(distance, f);
    }
    if (by_distance.empty() || slaves.holds(cloud.id[i]))
      continue;
    std::sort(by_distance.begin(), by_distance.end());

    std::array<double, dim> place;
    for (int a = 0; a < dim; ++a)
      place[a] = cloud.x[a][i];
    Embedding<dim> embedding;
    bool           found = false;
    for (const auto &[distance, f] : by_distance)
    {
      // A spacing in elements of this size is 2 spacing/size in xi; half as
      // much again for elements that are not square.
      const double size  = facet_size(seam.faces[mesh_party], seam.facets[f]);
      const double reach = size > 0 ? 3 * seam.spacing / size : 3.;
      found              = mesh.embed(seam.facets[f].element, place, reach, embedding);
      if (found)
        break;
    }
    if (!found)
    {
      std::ostringstream message;
      message << "interface \"" << spec.name << "\": particle " << cloud.id[i] << " of body \""
              << spec.particle_body << "\" cannot ride an element of body \"" << spec.mesh_body
              << "\": the elements at the seam are too distorted or too small for the particle spacing of "
              << seam.spacing << " m";
      throw InputError({"", 0, "Interfaces/" + spec.name}, message.str());
    }
    slaves.add(cloud.id[i]);
    id_.push_back(cloud.id[i]);
    embedding_.push_back(embedding);
    seam.slave_mass.push_back(cloud.mass[i]);
  }
}

template <int dim>
void TiedInterface<dim>::give_mass(const InterfaceSpec &spec, const Seam &seam, MeshPort<dim> &mesh)
{
  std::vector<std::pair<std::uint32_t, double>> gifts;
  for (std::size_t s = 0; s < embedding_.size(); ++s)
    for (int k = 0; k < Embedding<dim>::n_nodes; ++k)
      gifts.emplace_back(embedding_[s].node[k], embedding_[s].weight[k] * seam.slave_mass[s]);
  std::stable_sort(gifts.begin(), gifts.end(), [](auto &a, auto &b) { return a.first < b.first; });

  for (std::size_t a = 0; a < gifts.size();)
  {
    double      sum = 0;
    std::size_t b   = a;
    for (; b < gifts.size() && gifts[b].first == gifts[a].first; ++b)
      sum += gifts[b].second;
    const std::uint32_t node = gifts[a].first;
    if (seam.faces[mesh_party].mass[node] + sum <= 0)
    {
      std::ostringstream message;
      message << "interface \"" << spec.name << "\": the particles of body \"" << spec.particle_body
              << "\" would leave a node of body \"" << spec.mesh_body << "\" with mass "
              << seam.faces[mesh_party].mass[node] + sum
              << " kg; use elements at least as large as the particle spacing (" << seam.spacing << " m)";
      throw InputError({"", 0, "Interfaces/" + spec.name}, message.str());
    }
    mesh.add_mass(node, sum);
    a = b;
  }
}

template <int dim>
Point<dim> TiedInterface<dim>::carried(const Faces<dim> &faces, const Embedding<dim> &embedding) const
{
  Point<dim> v = Point<dim>::Zero();
  for (int k = 0; k < Embedding<dim>::n_nodes; ++k)
    v += embedding.weight[k] * faces.velocity(mesh_party, embedding.node[k]);
  return v;
}

template <int dim>
Point<dim> TiedInterface<dim>::slave_velocity(const Faces<dim> &faces, std::size_t s) const
{
  return faces.velocity(particle_party, faces.particle_index[id_[s]]);
}

template <int dim>
void TiedInterface<dim>::gather(Faces<dim> &faces, const Slaves<dim> &slaves)
{
  node_velocity_before_.resize(id_.size());
  slave_velocity_before_.resize(id_.size());
  for (std::size_t s = 0; s < id_.size(); ++s)
  {
    Point<dim> force;
    for (int a = 0; a < dim; ++a)
      force[a] = slaves.force[a][first_ + s];
    // The last node takes what is left, so that nothing is lost to rounding.
    Point<dim> rest = force;
    for (int k = 0; k + 1 < Embedding<dim>::n_nodes; ++k)
    {
      const Point<dim> share = embedding_[s].weight[k] * force;
      faces.add_force(mesh_party, embedding_[s].node[k], share);
      rest -= share;
    }
    faces.add_force(mesh_party, embedding_[s].node[Embedding<dim>::n_nodes - 1], rest);
    node_velocity_before_[s]  = carried(faces, embedding_[s]);
    slave_velocity_before_[s] = slave_velocity(faces, s);
  }
}

template <int dim>
void TiedInterface<dim>::drive(const Faces<dim> &faces, Slaves<dim> &slaves) const
{
  for (std::size_t s = 0; s < id_.size(); ++s)
  {
    const Point<dim> v = carried(faces, embedding_[s]);
    for (int a = 0; a < dim; ++a)
      slaves.velocity[a][first_ + s] = v[a];
  }
}

template <int dim>
void TiedInterface<dim>::close(const Faces<dim> &faces, const Slaves<dim> &slaves, const TimeStep &step)
{
  for (std::size_t s = 0; s < id_.size(); ++s)
  {
    Point<dim> force;
    for (int a = 0; a < dim; ++a)
      force[a] = slaves.force[a][first_ + s];
    energy_.work_on_mesh +=
      .5 * step.kick * force.dot(carried(faces, embedding_[s]) + node_velocity_before_[s]);
    energy_.work_on_particles -=
      .5 * step.kick * force.dot(slave_velocity(faces, s) + slave_velocity_before_[s]);
  }
}

template <int dim>
void TiedInterface<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<double>       weights{energy_.work_on_mesh, energy_.work_on_particles};
  std::vector<std::int64_t> names(id_);
  for (const auto &embedding : embedding_)
  {
    weights.insert(weights.end(), embedding.weight.begin(), embedding.weight.end());
    names.insert(names.end(), embedding.node.begin(), embedding.node.end());
  }
  archive.write(prefix + "/tied", weights);
  archive.write(prefix + "/tied_names", names);
}

template <int dim>
void TiedInterface<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto     weights = archive.doubles(prefix + "/tied");
  const auto     names   = archive.integers(prefix + "/tied_names");
  constexpr auto n       = static_cast<std::size_t>(Embedding<dim>::n_nodes);
  const auto     slaves  = id_.size();
  if (names.size() != slaves * (1 + n) || weights.size() != 2 + slaves * n ||
      !std::equal(id_.begin(), id_.end(), names.begin()))
    throw InputError("the checkpoint's tied particles (" + prefix + ") are not those of this scene");
  for (std::size_t s = 0; s < slaves; ++s)
    for (std::size_t k = 0; k < n; ++k)
    {
      embedding_[s].node[k]   = static_cast<std::uint32_t>(names[slaves + s * n + k]);
      embedding_[s].weight[k] = weights[2 + s * n + k];
    }
  energy_ = kept_ = {weights[0], weights[1]};
}

template class TiedInterface<1>;
template class TiedInterface<2>;
template class TiedInterface<3>;
} // namespace ogive::coupling
