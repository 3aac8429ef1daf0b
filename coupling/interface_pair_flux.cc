// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface_pair_flux.h"

#include "core/base/error.h"
#include "coupling/contact_geometry.h"
#include "coupling/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

namespace ogive::coupling
{
namespace
{
/// Feet are sought within this of the reach of a pair: riders stand behind the seam.
constexpr double foot_reach = 1.5;

std::vector<AlignedVector<double> *> fields_of(materials::Points &points)
{
  std::vector<AlignedVector<double> *> all;
  points.for_each_array([&](const char *, AlignedVector<double> &field) { all.push_back(&field); });
  return all;
}
/// Distance of the nearest particle from the mesh, m: for a message alone.
template <int dim>
double nearest_particle(const Faces<dim> &faces, const InterfaceSpec &spec)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto &facet : true_facets(faces[mesh_party], spec.mesh, spec.symmetry_axes))
  {
    std::array<Point<dim>, Surface<dim>::Facet::n_nodes> corner;
    for (std::size_t k = 0; k < corner.size(); ++k)
      corner[k] = faces.position(mesh_party, facet.node[k]);
    for (const std::uint32_t i : body_points(faces[particle_party], spec.particles))
      least = std::min(least, foot_on_facet<dim>(faces.position(particle_party, i), corner, facet.outward).distance2);
  }
  return std::sqrt(least);
}
} // namespace

template <int dim>
PairFluxInterface<dim>::PairFluxInterface(const InterfaceSpec &spec, MeshPort<dim> &mesh, ParticlePort<dim> &particles,
                                          Slaves<dim> &)
  : spec_(spec)
  , mesh_(mesh)
  , particles_(particles)
{
  const auto cell = particles_.lattice(spec_.particles).cell;
  spacing_        = *std::max_element(cell.begin(), cell.end());
  particles_.set_seam_hourglass(spec_.particles, spec_.pair_viscosity);
  const auto faces = Faces<dim>::look(&mesh_, &particles_);
  board(faces);
  if (seam_.empty() && spec_.per_edge == 0)
  {
    std::ostringstream message;
    message << "interface \"" << spec_.name << "\": no particle of body \"" << spec_.particle_body
            << "\" stands within one spacing (" << spacing_ << " m) in front of the surface of body \""
            << spec_.mesh_body << "\"; the nearest is "
            << nearest_particle<dim>(faces, spec_) << " m away";
    throw InputError({"", 0, "Interfaces/" + spec_.name}, message.str());
  }
  const auto with_riders = Faces<dim>::look(&mesh_, &particles_);
  find_feet(with_riders);
  balance_areas(with_riders);
}

template <int dim>
void PairFluxInterface<dim>::board(const Faces<dim> &faces)
{
  const auto lattice = particles_.lattice(spec_.particles);
  SeamView<dim> view{spec_, faces, mesh_.cells(spec_.mesh), seam_facets<dim>(spec_, faces, spacing_), lattice.cell,
                     2 * lattice.reach};
  seam_   = view.seam;
  riders_ = seam_.empty() ? std::vector<RiderPlace<dim>>() :
            spec_.per_edge > 0 ? places_in_cells<dim>(view) : continue_lattice<dim>(view, mesh_);
  sort_by_host();
  tell_ports();

  // Particles fill their body: their cells are not quite those of the lattice.
  const auto &cloud = faces[particle_party];
  double      own = 0, lattice_volume = 0, cell = 1;
  for (const double c : lattice.cell)
    cell *= c;
  for (const std::uint32_t i : body_points(cloud, spec_.particles))
  {
    own += cloud.mass[i];
    lattice_volume += cell * (spec_.axisymmetric ? 2 * std::numbers::pi * cloud.x[0][i] : 1.);
  }

  sph::Newcomers<dim> in;
  in.body = spec_.particles;
  in.resize(riders_.size());
  take_states(in.points);
  for (const auto &[element, carried] : hosts_)
    for (const std::uint32_t k : carried)
    {
      in.mass[k] = riders_[k].volume * (spec_.per_edge > 0 ? in.points.density[k] : own / lattice_volume);
      for (int a = 0; a < dim; ++a)
      {
        in.x[a][k] = in.x0[a][k] = riders_[k].where[a];
        in.half_cell[a][k]       = .5 * lattice.cell[a];
        for (int n = 0; n < Embedding<dim>::n_nodes; ++n)
          in.v[a][k] += riders_[k].host.weight[n] * faces[mesh_party].v[a][riders_[k].host.node[n]];
      }
    }
  particles_.set_riders(in);

  damp(faces, view.cells);
}

template <int dim>
void PairFluxInterface<dim>::sort_by_host()
{
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_host;
  for (std::size_t k = 0; k < riders_.size(); ++k)
    by_host[riders_[k].element].push_back(static_cast<std::uint32_t>(k));
  hosts_.assign(by_host.begin(), by_host.end());
  host_elements_.clear();
  for (const auto &[element, carried] : hosts_)
    host_elements_.push_back(element);
}

/// What the ports must keep up for the seam as it is.
template <int dim>
void PairFluxInterface<dim>::tell_ports()
{
  particles_.attend_seam(spec_.name, {spec_.particles, seam_, foot_reach * particles_.lattice(spec_.particles).reach});
  std::vector<std::uint32_t> nodes;
  for (const auto &rider : riders_)
    nodes.insert(nodes.end(), rider.host.node.begin(), rider.host.node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  mesh_.follow(spec_.name, nodes);
}

/// State of the elements that carry riders, to each of their riders.
template <int dim>
void PairFluxInterface<dim>::take_states(materials::Points &of_riders) const
{
  state_.resize(host_elements_.size());
  mesh_.copy_states(host_elements_, state_);
  const auto from = fields_of(state_), to = fields_of(of_riders);
  for (std::size_t f = 0; f < from.size(); ++f)
    for (std::size_t h = 0; h < hosts_.size(); ++h)
      for (const std::uint32_t k : hosts_[h].second)
        (*to[f])[k] = (*from[f])[h];
}

/// Elements near the seam.
template <int dim>
void PairFluxInterface<dim>::damp(const Faces<dim> &faces, const typename MeshPort<dim>::Cells &all)
{
  std::vector<Box<dim>> cells(all.element.size()), seam(seam_.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::uint32_t i : all.node[c])
      cells[c].include(faces.position(mesh_party, i));
  for (std::size_t f = 0; f < seam_.size(); ++f)
  {
    for (const std::uint32_t i : seam_[f].node)
      seam[f].include(faces.position(mesh_party, i));
    const double size = facet_size(faces[mesh_party], seam_[f]);
    // Boxes touch: an element begins where the one before it ends.
    seam[f].inflate(std::max(3 * spacing_, 1.6 * size) * (1 - 1e-6));
  }
  NeighbourList<dim> near;
  near.build(cells, seam);
  damped_.clear();
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (!near.of(c).empty() && spec_.damping > 0)
      damped_.push_back(all.element[c]);
  mesh_.damp(spec_.mesh, damped_, spec_.damping);
}

template <int dim>
void PairFluxInterface<dim>::renew()
{
  if (spec_.per_edge == 0)
    return;
  board(Faces<dim>::look(&mesh_, &particles_));
  const auto faces = Faces<dim>::look(&mesh_, &particles_); // riders have changed it
  find_feet(faces);
  balance_areas(faces);
}

template <int dim>
void PairFluxInterface<dim>::find_feet(const Faces<dim> &faces)
{
  const auto  &cloud = faces[particle_party];
  const double reach = particles_.lattice(spec_.particles).reach;
  topology_          = faces.particle_lists;
  feet_.clear();
  if (seam_.empty())
    return;
  const auto            points = body_points(cloud, spec_.particles);
  std::vector<Box<dim>> queries(points.size()), targets(seam_.size());
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    queries[q].include(faces.position(particle_party, points[q]));
    queries[q].inflate(foot_reach * reach);
  }
  for (std::size_t f = 0; f < seam_.size(); ++f)
    for (const std::uint32_t i : seam_[f].node)
      targets[f].include(faces.position(mesh_party, i));
  NeighbourList<dim> list;
  list.build(queries, targets);
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    if (list.of(q).empty())
      continue;
    const Point<dim> p = faces.position(particle_party, points[q]);
    Foot<dim>        best;
    Foothold         at;
    at.id = cloud.id[points[q]];
    for (const std::uint32_t f : list.of(q))
    {
      std::array<Point<dim>, n_nodes> corner;
      for (int k = 0; k < n_nodes; ++k)
        corner[k] = faces.position(mesh_party, seam_[f].node[k]);
      const Foot<dim> foot = foot_on_facet<dim>(p, corner, seam_[f].outward);
      if (better_foot<dim>(p, foot, best))
      {
        best    = foot;
        at.node = seam_[f].node;
      }
    }
    at.weight = best.weight;
    feet_.push_back(at);
  }
}

template <int dim>
Point<dim> PairFluxInterface<dim>::velocity_at(const Faces<dim> &faces, const Foothold &at) const
{
  Point<dim> v = Point<dim>::Zero();
  for (int k = 0; k < n_nodes; ++k)
    v += at.weight[k] * faces.velocity(mesh_party, at.node[k]);
  return v;
}

template <int dim>
void PairFluxInterface<dim>::gather(Faces<dim> &faces, const Slaves<dim> &)
{
  if (adopt_)
  {
    topology_ = faces.particle_lists;
    adopt_    = false;
  }
  if (topology_ != faces.particle_lists)
  {
    find_feet(faces);
    balance_areas(faces);
  }
  std::array<std::vector<double>, dim>  sums;
  std::array<std::span<double>, dim>    view;
  for (int a = 0; a < dim; ++a)
  {
    sums[a].assign(faces[particle_party].n, 0.);
    view[a] = sums[a];
  }
  particles_.seam_forces(spec_.particles, view);
  force_.resize(feet_.size());
  velocity_before_.resize(feet_.size());
  for (std::size_t s = 0; s < feet_.size(); ++s)
  {
    const std::uint32_t i = faces.particle_index[feet_[s].id];
    for (int a = 0; a < dim; ++a)
    {
      force_[s][a] = faces.particle_share * sums[a][i];
      sums[a][i]   = 0;
    }
    velocity_before_[s] = velocity_at(faces, feet_[s]);
    for (int k = 0; k < n_nodes; ++k)
      faces.add_force(mesh_party, feet_[s].node[k], -feet_[s].weight[k] * force_[s]);
  }
  edge_force_.resize(edges_.size());
  edge_velocity_before_.resize(edges_.size());
  std::vector<std::uint32_t> beside;
  for (const Edge &edge : edges_)
    beside.insert(beside.end(), edge.element.begin(), edge.element.end());
  state_.resize(beside.size());
  if (!beside.empty())
    mesh_.copy_states(beside, state_);
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    const Edge &edge   = edges_[e];
    const Mat3  stress = .5 * (state_.stress(2 * e).matrix() + state_.stress(2 * e + 1).matrix());
    edge_force_[e]    = stress.topLeftCorner<dim, dim>() * edge.area;
    edge_velocity_before_[e] = faces.velocity(mesh_party, edge.node[0]) - faces.velocity(mesh_party, edge.node[1]);
    faces.add_force(mesh_party, edge.node[0], edge_force_[e]);
    faces.add_force(mesh_party, edge.node[1], -edge_force_[e]);
  }
  for (int a = 0; a < dim; ++a)
    for (const double left : sums[a])
      require(left == 0, "each particle that a rider presses has a foot on the seam");
}

template <int dim>
void PairFluxInterface<dim>::drive(const Faces<dim> &faces, Slaves<dim> &) const
{
  auto on = particles_.riders(spec_.particles);
  for (int a = 0; a < dim; ++a)
  {
    const auto &v = faces[mesh_party].v[a];
    for (std::size_t k = 0; k < riders_.size(); ++k)
    {
      double sum = 0;
      for (int n = 0; n < Embedding<dim>::n_nodes; ++n)
        sum += riders_[k].host.weight[n] * v[riders_[k].host.node[n]];
      on.velocity[a][k] = sum;
    }
  }
  if (!riders_.empty())
    take_states(*on.state);
}

template <int dim>
void PairFluxInterface<dim>::close(const Faces<dim> &faces, const Slaves<dim> &, const TimeStep &step)
{
  for (std::size_t s = 0; s < feet_.size(); ++s)
    energy_.work_on_mesh -= .5 * step.kick * force_[s].dot(velocity_at(faces, feet_[s]) + velocity_before_[s]);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    energy_.work_on_mesh +=
      .5 * step.kick *
      edge_force_[e].dot(faces.velocity(mesh_party, edges_[e].node[0]) - faces.velocity(mesh_party, edges_[e].node[1]) +
                         edge_velocity_before_[e]);
  energy_.work_on_particles = particles_.seam_work(spec_.particles);
}

template class PairFluxInterface<1>;
template class PairFluxInterface<2>;
template class PairFluxInterface<3>;
} // namespace ogive::coupling
