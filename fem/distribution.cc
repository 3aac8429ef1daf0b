// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/distribution.h"

#include "core/base/error.h"

#include <algorithm>

namespace ogive::fem
{
template <int dim>
Distribution<dim>::Distribution(const Ranks &ranks, const std::vector<BodyMesh<dim>> &meshes,
                                const std::vector<std::size_t> &first_node)
    : ranks_(ranks)
{
  if (alone())
    return;
  std::size_t first_cell = 0;
  for (std::size_t b = 0; b < meshes.size(); ++b)
  {
    Body body;
    body.mesh = meshes[b];
    body.mesh.facets.clear();
    body.mesh.hanging.clear();
    body.mesh.boundary_names.clear();
    body.mesh.boundary_aliases.clear();
    body.mesh.file_numbers.clear();
    body.first_node = first_node[b];
    body.first_cell = first_cell;
    body.cells_of   = meshes[b].n_cells() / std::max<std::size_t>(meshes[b].n_elements(), 1);
    body.alive.assign(meshes[b].n_cells(), 1);
    first_cell += meshes[b].n_cells();
    bodies_.push_back(std::move(body));
  }
}

template <int dim>
std::size_t Distribution<dim>::n_elements() const
{
  std::size_t n = 0;
  for (const Body &body : bodies_)
    n += body.mesh.n_elements();
  return n;
}

template <int dim>
std::vector<int> Distribution<dim>::owners() const
{
  std::vector<int> all;
  for (const Body &body : bodies_)
    all.insert(all.end(), body.owner.begin(), body.owner.end());
  return all;
}

template <int dim>
void Distribution<dim>::assign(std::span<const int> owner, const Constraints<dim> &constraints,
                               Nodes<dim> &nodes)
{
  require(owner.size() == n_elements(), "a rank for each element");
  for (Body &body : bodies_)
  {
    const std::size_t n = body.mesh.n_elements();
    body.owner.assign(owner.begin(), owner.begin() + static_cast<std::ptrdiff_t>(n));
    owner = owner.subspan(n);
    body.place.resize(n);
    body.own.clear();
    std::vector<std::uint32_t> count(ranks_.size(), 0);
    for (std::uint32_t e = 0; e < n; ++e)
    {
      body.place[e] = count.at(body.owner[e])++;
      if (body.owner[e] == ranks_.rank())
        body.own.push_back(e);
    }
  }
  owner_of_node_.assign(nodes.size(), -1);
  std::vector<std::pair<std::uint32_t, int>> further;
  find_keepers(constraints, further);
  find_roles(further, constraints, nodes);

  std::vector<std::uint32_t> every(nodes.size());
  for (std::uint32_t a = 0; a < every.size(); ++a)
    every[a] = a;
  all_ = list(every);
}

/// Notes the lowest rank that keeps a node up, and all others in `further`.
template <int dim>
void Distribution<dim>::find_keepers(const Constraints<dim>                     &constraints,
                                     std::vector<std::pair<std::uint32_t, int>> &further)
{
  const auto keep = [&](std::uint32_t node, int rank)
  {
    if (owner_of_node_[node] < 0)
      owner_of_node_[node] = rank;
    else if (owner_of_node_[node] != rank)
      further.emplace_back(node, rank);
  };
  const auto sort = [&]
  {
    std::sort(further.begin(), further.end());
    further.erase(std::unique(further.begin(), further.end()), further.end());
  };
  for (const Body &body : bodies_)
  {
    const auto       &list = body.mesh.degree > 1 ? body.mesh.elements : body.mesh.cells;
    const std::size_t n = body.owner.size(), each = n > 0 ? list.size() / n : 0;
    for (std::size_t k = 0; k < list.size(); ++k)
      keep(static_cast<std::uint32_t>(body.first_node + list[k]), body.owner[k / each]);
  }
  sort();
  // Masters are never slaves themselves.
  const auto before = further;
  for (const std::uint32_t slave : constraints.slaves())
  {
    const auto [first, last] =
        std::equal_range(before.begin(), before.end(), std::pair{slave, 0},
                         [](const auto &a, const auto &b) { return a.first < b.first; });
    constraints.for_each_master(slave,
                                [&](std::uint32_t master, double)
                                {
                                  keep(master, owner_of_node_[slave]);
                                  for (auto it = first; it != last; ++it)
                                    keep(master, it->second);
                                });
  }
  sort();
  // The first to come need not be the lowest.
  for (auto &[node, rank] : further)
    if (rank < owner_of_node_[node])
      std::swap(rank, owner_of_node_[node]);
  sort();
}

template <int dim>
void Distribution<dim>::find_roles(const std::vector<std::pair<std::uint32_t, int>> &further,
                                   const Constraints<dim> &constraints, Nodes<dim> &nodes)
{
  using Role   = typename Nodes<dim>::Role;
  const int me = ranks_.rank();
  nodes.role.assign(nodes.size(), Role::none);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (owner_of_node_[a] == me)
      nodes.role[a] = Role::owned;
  for (const auto &[node, rank] : further)
    if (rank == me)
      nodes.role[node] = Role::kept;
  for (const std::uint32_t slave : constraints.slaves())
    constraints.for_each_master(slave,
                                [&](std::uint32_t master, double)
                                {
                                  if (nodes.keeps(master) && nodes.role[slave] == Role::none)
                                    nodes.role[slave] = Role::felt;
                                });

  std::vector<std::uint32_t>              mine;
  std::vector<std::vector<std::uint32_t>> with(ranks_.size());
  for (auto it = further.begin(); it != further.end();)
  {
    const std::uint32_t node = it->first;
    auto                end  = it;
    while (end != further.end() && end->first == node)
      ++end;
    if (nodes.keeps(node))
    {
      if (owner_of_node_[node] != me)
        with[owner_of_node_[node]].push_back(static_cast<std::uint32_t>(mine.size()));
      for (; it != end; ++it)
        if (it->second != me)
          with[it->second].push_back(static_cast<std::uint32_t>(mine.size()));
      mine.push_back(node);
    }
    it = end;
  }
  shared_ = SharedNodes(ranks_, std::move(mine), std::move(with));

  runs_.assign(bodies_.size(), {});
  for (std::size_t b = 0; b < bodies_.size(); ++b)
  {
    const std::size_t first = bodies_[b].first_node, last = first + bodies_[b].mesh.n_nodes();
    for (std::size_t a = first; a < last; ++a)
      if (nodes.keeps(a))
      {
        if (runs_[b].empty() || runs_[b].back().last != a)
          runs_[b].push_back({a, a});
        runs_[b].back().last = a + 1;
      }
  }
}

template <int dim>
BodyMesh<dim> Distribution<dim>::own_mesh(std::size_t b) const
{
  const Body   &body = bodies_[b];
  BodyMesh<dim> part = body.mesh;
  const auto    pick = [&](std::vector<std::uint32_t> &list)
  {
    const std::size_t          each = body.owner.empty() ? 0 : list.size() / body.owner.size();
    std::vector<std::uint32_t> own;
    for (const std::uint32_t e : body.own)
      own.insert(own.end(), list.begin() + static_cast<std::ptrdiff_t>(e * each),
                 list.begin() + static_cast<std::ptrdiff_t>((e + 1) * each));
    list = std::move(own);
  };
  pick(part.cells);
  pick(part.elements);
  return part;
}

template <int dim>
auto Distribution<dim>::nodes(std::size_t b, std::size_t cell) const -> std::array<std::uint32_t, corners>
{
  const Body                        &body = bodies_[b];
  std::array<std::uint32_t, corners> n;
  for (int a = 0; a < corners; ++a)
    n[a] = static_cast<std::uint32_t>(body.first_node + body.mesh.cells[cell * corners + a]);
  return n;
}

template <int dim>
auto Distribution<dim>::list(std::span<const std::uint32_t> nodes) const -> NodeList
{
  NodeList l;
  l.first.assign(ranks_.size() + 1, 0);
  for (const std::uint32_t a : nodes)
    if (owner_of_node_[a] >= 0)
      ++l.first[owner_of_node_[a] + 1];
  for (std::size_t r = 1; r < l.first.size(); ++r)
    l.first[r] += l.first[r - 1];
  l.node.resize(l.first.back());
  auto next = l.first;
  for (const std::uint32_t a : nodes)
    if (owner_of_node_[a] >= 0)
      l.node[next[owner_of_node_[a]]++] = a;
  return l;
}

template <int dim>
void Distribution<dim>::tell(const NodeList &l, std::span<double *const> arrays) const
{
  if (alone())
    return;
  const std::size_t   width = arrays.size(), begin = l.first[ranks_.rank()], end = l.first[ranks_.rank() + 1];
  std::vector<double> own;
  own.reserve((end - begin) * width);
  for (std::size_t k = begin; k < end; ++k)
    for (const double *a : arrays)
      own.push_back(a[l.node[k]]);
  const std::vector<double> all = ranks_.gather(own);
  for (std::size_t k = 0; k < l.node.size(); ++k)
    if (k < begin || k >= end)
      for (std::size_t f = 0; f < width; ++f)
        arrays[f][l.node[k]] = all[k * width + f];
}

template class Distribution<1>;
template class Distribution<2>;
template class Distribution<3>;
} // namespace ogive::fem
