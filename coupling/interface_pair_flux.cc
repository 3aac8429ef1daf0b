// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface_pair_flux.h"

#include "core/base/error.h"
#include "coupling/contact_geometry.h"
#include "coupling/search.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <algorithm>
#include <map>
#include <numbers>
#include <sstream>

namespace ogive::coupling
{
namespace
{
std::vector<AlignedVector<double> *> fields_of(materials::Points &points)
{
  std::vector<AlignedVector<double> *> all;
  points.for_each_array([&](const char *, AlignedVector<double> &field) { all.push_back(&field); });
  return all;
}
/// Integrals of the shape functions times the outward normal over a facet, of
/// the whole ring in axial symmetry.
template <int dim>
std::array<Point<dim>, Surface<dim>::Facet::n_nodes> nodal_areas(const Faces<dim>                    &faces,
                                                                 const typename Surface<dim>::Facet &facet,
                                                                 bool                                axisymmetric)
{
  std::array<Point<dim>, Surface<dim>::Facet::n_nodes> share;
  const auto corner = [&](int k) { return faces.position(mesh_party, facet.node[k]); };
  if constexpr (dim == 1)
    share[0] = Point<1>(facet.outward);
  else if constexpr (dim == 2)
  {
    const Point<2> along = corner(1) - corner(0), normal(along[1], -along[0]);
    const double   r[2]  = {corner(0)[0], corner(1)[0]};
    for (int k = 0; k < 2; ++k)
      share[k] = axisymmetric ? Point<2>(normal * std::numbers::pi * (2 * r[k] + r[1 - k]) / 3.) : Point<2>(.5 * normal);
  }
  else
  {
    // Two-point Gauss rule each way: exact for the bilinear map.
    const double g = 1 / std::sqrt(3.);
    for (auto &s : share)
      s.setZero();
    static constexpr double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const double xi : {-g, g})
      for (const double eta : {-g, g})
      {
        Point<3> a = Point<3>::Zero(), b = Point<3>::Zero();
        for (int k = 0; k < 4; ++k)
        {
          a += .25 * sign[k][0] * (1 + sign[k][1] * eta) * corner(k);
          b += .25 * sign[k][1] * (1 + sign[k][0] * xi) * corner(k);
        }
        for (int k = 0; k < 4; ++k)
          share[k] += .25 * (1 + sign[k][0] * xi) * (1 + sign[k][1] * eta) * a.cross(b);
      }
  }
  return share;
}
/// Nodes where the seam ends, but not those where a plane of symmetry cuts it.
template <int dim>
std::vector<std::uint32_t> rim_nodes(const Faces<dim> &faces, const std::vector<typename Surface<dim>::Facet> &seam,
                                     const std::vector<int> &symmetry_axes)
{
  using Ends = std::array<std::uint32_t, 2>;
  std::map<Ends, int> met; // ends of facets: edges in space, nodes in a plane
  for (const auto &facet : seam)
    for (std::size_t k = 0; k < facet.node.size(); ++k)
    {
      Ends ends{facet.node[k], dim == 3 ? facet.node[(k + 1) % facet.node.size()] : facet.node[k]};
      std::sort(ends.begin(), ends.end());
      ++met[ends];
    }
  std::vector<std::uint32_t> nodes;
  for (const auto &[ends, times] : met)
  {
    const Point<dim> a = faces.position(mesh_party, ends[0]), b = faces.position(mesh_party, ends[1]);
    const double     size = (b - a).norm() + facet_size(faces[mesh_party], seam.front());
    const bool       cut  = std::any_of(symmetry_axes.begin(), symmetry_axes.end(), [&](int axis) {
      return std::max(std::abs(a[axis]), std::abs(b[axis])) < 1e-9 * size;
    });
    if (times == 1 && !cut)
      nodes.insert(nodes.end(), ends.begin(), ends.end());
  }
  return nodes;
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
            << spec_.mesh_body << "\"";
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
  for (const auto &[element, carried] : hosts_)
    for (const std::uint32_t k : carried)
    {
      mesh_.copy_state(element, in.points, k);
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
  topology_          = cloud.topology;
  feet_.clear();
  if (seam_.empty())
    return;
  const auto            points = body_points(cloud, spec_.particles);
  std::vector<Box<dim>> queries(points.size()), targets(seam_.size());
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    queries[q].include(faces.position(particle_party, points[q]));
    queries[q].inflate(1.5 * reach);
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
void PairFluxInterface<dim>::balance_areas(const Faces<dim> &faces)
{
  edges_.clear();
  // At the corners of a seam that conversion leaves behind it drives light nodes
  // unstable (plate-weldox-blunt/auto.prm turned elements inside out).
  if (dim == 1 || seam_.empty() || spec_.per_edge > 0)
    return;
  std::map<std::uint32_t, Point<dim>> lack; // of area, by node
  const auto                          add = [&](std::uint32_t node, const Point<dim> &area) {
    lack.try_emplace(node, Point<dim>(Point<dim>::Zero())).first->second += area;
  };
  using Ends = std::array<std::uint32_t, 2>;
  std::map<Ends, Edge> edges;
  for (const auto &facet : seam_)
  {
    const auto share = nodal_areas<dim>(faces, facet, spec_.axisymmetric);
    for (int k = 0; k < n_nodes; ++k)
    {
      add(facet.node[k], share[k]);
      Ends ends{facet.node[k], facet.node[(k + 1) % n_nodes]};
      if (dim == 2 && k == 1)
        continue;
      std::sort(ends.begin(), ends.end());
      const auto [at, is_new] = edges.try_emplace(ends);
      at->second.node         = ends;
      at->second.element[1]   = facet.element;
      if (is_new)
        at->second.element[0] = facet.element;
    }
  }
  std::array<std::vector<double>, dim> sums;
  std::array<std::span<double>, dim>   view;
  for (int a = 0; a < dim; ++a)
  {
    sums[a].assign(faces[particle_party].n, 0.);
    view[a] = sums[a];
  }
  particles_.seam_normals(spec_.particles, view);
  for (const auto &foot : feet_)
    for (int k = 0; k < n_nodes; ++k)
      for (int a = 0; a < dim; ++a)
        lack.at(foot.node[k])[a] += foot.weight[k] * sums[a][faces.particle_index[foot.id]];

  std::map<std::uint32_t, int> number;
  for (const auto &[node, area] : lack)
    number.emplace(node, static_cast<int>(number.size()));
  // Next to a free surface particles see less of the seam: its rim keeps what
  // cannot be balanced, the nodes within are exact.
  std::vector<bool> rim(number.size(), false);
  for (const std::uint32_t node : rim_nodes<dim>(faces, seam_, spec_.symmetry_axes))
    rim[static_cast<std::size_t>(number.at(node))] = true;
  const bool closed = std::find(rim.begin(), rim.end(), true) == rim.end();
  const auto                          n = static_cast<Eigen::Index>(number.size());
  Eigen::MatrixXd                     right(n, dim);
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto &[node, area] : lack)
    right.row(number.at(node)) = area.transpose();
  if (closed) // only differences matter
    right.rowwise() -= right.colwise().mean().eval();
  for (Eigen::Index i = 0; i < n; ++i)
    if (rim[static_cast<std::size_t>(i)])
    {
      right.row(i).setZero();
      entries.emplace_back(i, i, 1.);
    }
  for (const auto &[ends, edge] : edges)
  {
    const int i = number.at(ends[0]), j = number.at(ends[1]);
    const bool fixed[2] = {rim[static_cast<std::size_t>(i)], rim[static_cast<std::size_t>(j)]};
    if (!fixed[0])
      entries.emplace_back(i, i, 1.);
    if (!fixed[1])
      entries.emplace_back(j, j, 1.);
    if (!fixed[0] && !fixed[1])
      entries.insert(entries.end(), {{i, j, -1.}, {j, i, -1.}});
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-14);
  solver.setMaxIterations(10 * n + 100);
  solver.compute(laplacian);
  const Eigen::MatrixXd potential = solver.solve(right);
  if (!potential.allFinite())
    return;
  for (auto &[ends, edge] : edges)
  {
    edge.area = (potential.row(number.at(ends[0])) - potential.row(number.at(ends[1]))).transpose();
    edges_.push_back(edge);
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
    topology_ = faces[particle_party].topology;
    adopt_    = false;
  }
  if (topology_ != faces[particle_party].topology)
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
  state_.resize(2);
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    const Edge &edge = edges_[e];
    for (std::size_t k = 0; k < 2; ++k)
      mesh_.copy_state(edge.element[k], state_, k);
    const Mat3 stress = .5 * (state_.stress(0).matrix() + state_.stress(1).matrix());
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
  if (riders_.empty())
    return;
  state_.resize(1);
  const auto from = fields_of(state_), to = fields_of(*on.state);
  for (const auto &[element, carried] : hosts_)
  {
    mesh_.copy_state(element, state_, 0);
    for (std::size_t f = 0; f < from.size(); ++f)
      for (const std::uint32_t k : carried)
        (*to[f])[k] = (*from[f])[0];
  }
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
  energy_.work_on_particles = particles_.seam_work();
}

template <int dim>
void PairFluxInterface<dim>::snapshot()
{
  kept_      = energy_;
  kept_feet_ = feet_;
  kept_edges_ = edges_;
}

template <int dim>
void PairFluxInterface<dim>::restore()
{
  energy_ = kept_;
  feet_   = kept_feet_;
  edges_  = kept_edges_;
  adopt_  = true;
}

template <int dim>
void PairFluxInterface<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<double>       numbers{energy_.work_on_mesh, energy_.work_on_particles};
  std::vector<std::int64_t> names;
  for (const auto &foot : feet_)
  {
    numbers.insert(numbers.end(), foot.weight.begin(), foot.weight.end());
    names.push_back(foot.id);
    names.insert(names.end(), foot.node.begin(), foot.node.end());
  }
  save_riders(archive, prefix);
  std::vector<double>       areas;
  std::vector<std::int64_t> ends;
  for (const auto &edge : edges_)
  {
    areas.insert(areas.end(), edge.area.begin(), edge.area.end());
    ends.insert(ends.end(), {edge.node[0], edge.node[1], edge.element[0], edge.element[1]});
  }
  archive.write(prefix + "/edges", areas);
  archive.write(prefix + "/edges_ends", ends);
  archive.write(prefix + "/feet", numbers);
  archive.write(prefix + "/feet_names", names);
}

template <int dim>
void PairFluxInterface<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto     numbers = archive.doubles(prefix + "/feet");
  const auto     names   = archive.integers(prefix + "/feet_names");
  constexpr auto n       = static_cast<std::size_t>(n_nodes);
  if (names.size() % (n + 1) != 0 || numbers.size() != 2 + names.size() / (n + 1) * n)
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  feet_.resize(names.size() / (n + 1));
  for (std::size_t s = 0; s < feet_.size(); ++s)
  {
    feet_[s].id = names[s * (n + 1)];
    for (std::size_t k = 0; k < n; ++k)
    {
      feet_[s].node[k]   = static_cast<std::uint32_t>(names[s * (n + 1) + 1 + k]);
      feet_[s].weight[k] = numbers[2 + s * n + k];
    }
  }
  load_riders(archive, prefix);
  const auto areas = archive.doubles(prefix + "/edges");
  const auto ends  = archive.integers(prefix + "/edges_ends");
  if (areas.size() * 4 != ends.size() * dim)
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  edges_.resize(ends.size() / 4);
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    const auto end = [&](std::size_t k) { return static_cast<std::uint32_t>(ends[4 * e + k]); };
    edges_[e].node    = {end(0), end(1)};
    edges_[e].element = {end(2), end(3)};
    for (int a = 0; a < dim; ++a)
      edges_[e].area[a] = areas[e * dim + a];
  }
  energy_ = kept_ = {numbers[0], numbers[1]};
  adopt_  = true;
}

template <int dim>
void PairFluxInterface<dim>::save_riders(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<std::int64_t> hosts, facets;
  std::vector<double>       weights, sides;
  for (const auto &rider : riders_)
  {
    hosts.push_back(rider.element);
    hosts.insert(hosts.end(), rider.host.node.begin(), rider.host.node.end());
    weights.insert(weights.end(), rider.host.weight.begin(), rider.host.weight.end());
  }
  for (const auto &facet : seam_)
  {
    facets.push_back(facet.element);
    facets.insert(facets.end(), facet.node.begin(), facet.node.end());
    sides.push_back(facet.outward);
  }
  archive.write(prefix + "/riders", hosts);
  archive.write(prefix + "/rider_weights", weights);
  archive.write(prefix + "/seam", facets);
  archive.write(prefix + "/seam_sides", sides);
  archive.write(prefix + "/damped", std::vector<std::int64_t>(damped_.begin(), damped_.end()));
}

template <int dim>
void PairFluxInterface<dim>::load_riders(const ArchiveReader &archive, const std::string &prefix)
{
  const auto            hosts = archive.integers(prefix + "/riders"), facets = archive.integers(prefix + "/seam"),
             damped  = archive.integers(prefix + "/damped");
  const auto            weights = archive.doubles(prefix + "/rider_weights"), sides = archive.doubles(prefix + "/seam_sides");
  constexpr std::size_t corners = Embedding<dim>::n_nodes, of_facet = n_nodes;
  if (hosts.size() * corners != weights.size() * (corners + 1) || facets.size() != sides.size() * (of_facet + 1))
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  riders_.assign(weights.size() / corners, {});
  for (std::size_t k = 0; k < riders_.size(); ++k)
  {
    riders_[k].element = static_cast<std::uint32_t>(hosts[k * (corners + 1)]);
    for (std::size_t n = 0; n < corners; ++n)
    {
      riders_[k].host.node[n]   = static_cast<std::uint32_t>(hosts[k * (corners + 1) + 1 + n]);
      riders_[k].host.weight[n] = weights[k * corners + n];
    }
  }
  seam_.assign(sides.size(), {});
  for (std::size_t f = 0; f < seam_.size(); ++f)
  {
    seam_[f].element = static_cast<std::uint32_t>(facets[f * (of_facet + 1)]);
    seam_[f].outward = sides[f];
    seam_[f].body    = spec_.mesh;
    for (std::size_t n = 0; n < of_facet; ++n)
      seam_[f].node[n] = static_cast<std::uint32_t>(facets[f * (of_facet + 1) + 1 + n]);
  }
  damped_.assign(damped.begin(), damped.end());
  sort_by_host();
}

template class PairFluxInterface<1>;
template class PairFluxInterface<2>;
template class PairFluxInterface<3>;
} // namespace ogive::coupling
