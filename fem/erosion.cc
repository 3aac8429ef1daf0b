// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/erosion.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>

namespace ogive::fem
{
namespace
{
/// Corners of the sides of an element, VTK order, outside as in Surface::Facet.
template <int dim>
constexpr auto sides_of_element()
{
  if constexpr (dim == 1)
    return std::array<std::array<int, 1>, 2>{{{0}, {1}}};
  else if constexpr (dim == 2)
    return std::array<std::array<int, 2>, 4>{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  else
    return std::array<std::array<int, 4>, 6>{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}
} // namespace

template <int dim>
Erosion<dim>::Erosion(const std::vector<BodyMesh<dim>> &meshes, const std::vector<GroupPlace> &place,
                      bool axisymmetric)
  : axisymmetric_(axisymmetric)
{
  for (std::size_t b = 0; b < meshes.size(); ++b)
  {
    when_.push_back(meshes[b].erosion);
    first_element_.push_back(place[b].first_element);
    any_ = any_ || meshes[b].loses_elements();
    list_sides(meshes[b], place[b]);
  }
}

// First the sides that bound the mesh, in its order, then both sides of each
// pair of elements.
template <int dim>
void Erosion<dim>::list_sides(const BodyMesh<dim> &mesh, const GroupPlace &place)
{
  const auto add = [&](const auto &nodes, std::uint32_t cell, double outward, std::int64_t other) {
    Side side;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      side.facet.node[k] = static_cast<std::uint32_t>(place.first_node + nodes[k]);
    side.facet.body    = mesh.body;
    side.facet.element = static_cast<std::uint32_t>(place.first_element + cell);
    side.facet.outward = outward;
    side.other         = other;
    side.facet.bared   = other >= 0 && mesh.converts;
    sides_.push_back(side);
  };
  // Faces under a tie too: what a third body strikes must be closed.
  for (const auto &facet : mesh.facets)
    if (!mesh.boundary_names[facet.boundary].starts_with("symmetry"))
      add(facet.node, facet.cell, facet.outward, -1);
  if (!mesh.loses_elements())
    return;

  constexpr auto local = sides_of_element<dim>();
  using Nodes          = std::array<std::uint32_t, BodyMesh<dim>::Facet::n_nodes>;
  std::map<Nodes, std::pair<std::uint32_t, Nodes>> open; // sorted nodes: cell, its own order
  for (std::uint32_t cell = 0; cell < mesh.n_cells(); ++cell)
    for (std::size_t s = 0; s < local.size(); ++s)
    {
      Nodes nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        nodes[k] = mesh.cells[cell * BodyMesh<dim>::corners + local[s][k]];
      Nodes sorted = nodes;
      std::sort(sorted.begin(), sorted.end());
      const auto [met, is_new] = open.try_emplace(sorted, cell, nodes);
      if (is_new)
        continue;
      const auto &[neighbour, theirs] = met->second;
      const double outward            = s == 0 ? -1 : 1; // used in one dimension only
      add(nodes, cell, outward, static_cast<std::int64_t>(place.first_element + neighbour));
      add(theirs, neighbour, -outward, static_cast<std::int64_t>(place.first_element + cell));
    }
}

// The last element takes what is left, so no rounding stays behind.
template <int dim>
double Erosion<dim>::release(Nodes<dim> &nodes, std::uint32_t a, double share)
{
  const double left = --living_[a] > 0 ? nodes.mass[a] - share : 0, m = nodes.mass[a] - left;
  nodes.mass[a]     = left;
  return m;
}

template <int dim>
void Erosion<dim>::take(Nodes<dim> &nodes, std::uint32_t a, double share)
{
  const double m = release(nodes, a, share);
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
  {
    x[i] = nodes.x[i][a];
    v[i] = nodes.v[i][a];
  }
  gone_[mass] += m;
  gone_[energy] += .5 * m * v.squaredNorm();
  if (axisymmetric_) // the radial momenta of a ring cancel
  {
    gone_[momentum + 1] += m * v[1];
    return;
  }
  const Vec3 turn = m * x.cross(v);
  for (int i = 0; i < 3; ++i)
  {
    gone_[momentum + i] += m * v[i];
    gone_[angular + i] += turn[i];
  }
}

template <int dim>
bool Erosion<dim>::kill_failed(const Groups &groups, Nodes<dim> &nodes)
{
  bool died = false;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    if (!when_[g].on)
      continue;
    failed_.clear();
    groups[g]->find_failed(when_[g], failed_);
    for (const std::size_t e : failed_)
    {
      const auto corner = groups[g]->nodes(e);
      const auto gone   = groups[g]->kill(e);
      for (int a = 0; a < ElementGroup<dim>::corners; ++a)
        take(nodes, corner[a], gone.mass[a]);
      gone_[energy] += gone.internal_energy + gone.hourglass_energy;
      gone_[number] += 1;
    }
    if (!failed_.empty())
      groups[g]->sum_forces();
    died = died || !failed_.empty();
  }
  return died;
}

template <int dim>
void Erosion<dim>::release(const std::array<std::uint32_t, ElementGroup<dim>::corners> &corner, Nodes<dim> &nodes,
                           std::array<double, ElementGroup<dim>::corners> &mass)
{
  for (int a = 0; a < ElementGroup<dim>::corners; ++a)
    mass[a] = release(nodes, corner[a], mass[a]);
  gone_[converted] += 1;
}

template <int dim>
void Erosion<dim>::find_failed(const Groups &groups, std::vector<std::vector<std::size_t>> &failed) const
{
  failed.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    failed[g].clear();
    if (when_[g].on)
      groups[g]->find_failed(when_[g], failed[g]);
  }
}

template <int dim>
auto Erosion<dim>::kill(const Groups &groups, const std::vector<std::vector<std::size_t>> &failed,
                        const Nodes<dim> &nodes) const -> std::vector<Death>
{
  std::vector<Death> deaths;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t e : failed[g])
    {
      Death d;
      d.group         = g;
      d.cell          = e;
      d.node          = groups[g]->nodes(e);
      const auto gone = groups[g]->kill(e);
      d.mass          = gone.mass;
      d.energy        = gone.internal_energy + gone.hourglass_energy;
      for (int a = 0; a < Death::corners; ++a)
        for (int i = 0; i < dim; ++i)
        {
          d.x[a][i] = nodes.x[i][d.node[a]];
          d.v[a][i] = nodes.v[i][d.node[a]];
        }
      deaths.push_back(d);
    }
  return deaths;
}

template <int dim>
void Erosion<dim>::book(const Death &d, Nodes<dim> &nodes)
{
  for (int a = 0; a < Death::corners; ++a)
  {
    for (int i = 0; i < dim; ++i) // as the owner knows them
    {
      nodes.x[i][d.node[a]] = d.x[a][i];
      nodes.v[i][d.node[a]] = d.v[a][i];
    }
    take(nodes, d.node[a], d.mass[a]);
  }
  gone_[energy] += d.energy;
  gone_[number] += 1;
}

template <int dim>
void Erosion<dim>::review(const AllElements<dim> &all, Surface<dim> &face)
{
  std::vector<std::vector<bool>> alive(all.bodies());
  for (std::size_t g = 0; g < all.bodies(); ++g)
  {
    alive[g].resize(all.cells(g));
    for (std::size_t e = 0; e < all.cells(g); ++e)
      alive[g][e] = all.alive(g, e);
  }
  const auto lives = [&](std::int64_t element) {
    std::size_t g = first_element_.size() - 1;
    while (element < static_cast<std::int64_t>(first_element_[g]))
      --g;
    return bool(alive[g][static_cast<std::size_t>(element) - first_element_[g]]);
  };
  std::vector<std::uint32_t> touching;
  face.facets.clear();
  for (const Side &side : sides_)
    if (lives(side.facet.element) && (side.other < 0 || !lives(side.other)))
    {
      face.facets.push_back(side.facet);
      if (!side.facet.bared)
        touching.insert(touching.end(), side.facet.node.begin(), side.facet.node.end());
    }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  face.contact_points = std::move(touching);
  face.topology       = 1 + static_cast<std::uint64_t>(gone_[number] + gone_[converted]);

  living_.assign(face.n, 0);
  for (std::size_t g = 0; g < all.bodies(); ++g)
    for (std::size_t e = 0; e < all.cells(g); ++e)
      if (alive[g][e])
        for (const std::uint32_t a : all.nodes(g, e))
          ++living_[a];
}

template <int dim>
void Erosion<dim>::add(Balance &b) const
{
  b.eroded_mass += gone_[mass];
  b.eroded_energy += gone_[energy];
  b.eroded_elements += gone_[number];
  for (int i = 0; i < 3; ++i)
  {
    b.eroded_momentum[i] += gone_[momentum + i];
    b.eroded_angular_momentum[i] += gone_[angular + i];
  }
}

template class Erosion<1>;
template class Erosion<2>;
template class Erosion<3>;
} // namespace ogive::fem
