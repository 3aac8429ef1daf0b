// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/raise_degree.h"

#include "core/base/error.h"
#include "fem/elements/full.h"
#include "fem/elements/spectral.h"

#include <algorithm>
#include <array>
#include <map>

namespace ogive::fem
{
namespace
{
template <class List>
std::vector<double> lobatto_points(int degree, const List &list)
{
  return degree == 2 ? list(Lobatto<2>{}) : degree == 3 ? list(Lobatto<3>{}) : list(Lobatto<4>{});
}

template <int dim>
class Raiser
{
public:
  Raiser(BodyMesh<dim> &mesh, int degree)
    : old_(mesh)
    , mesh_(mesh)
    , degree_(degree)
    , point_(lobatto_points(degree, [](const auto &line) { return std::vector<double>(std::begin(line.point), std::end(line.point)); }))
    , weight_(lobatto_points(degree, [](const auto &line) { return std::vector<double>(std::begin(line.weight), std::end(line.weight)); }))
  {}

  void raise()
  {
    for (auto &x : mesh_.x)
      x.clear();
    mesh_.cells.clear();
    mesh_.facets.clear();
    mesh_.degree = degree_;
    for (std::size_t e = 0; e < old_.n_cells(); ++e)
      add_element(e);
    for (const auto &facet : old_.facets)
      add_facet(facet);
  }

private:
  using Index = std::array<int, 3>;
  /// A place that elements share: the corners of the smallest edge or face that
  /// holds it, in an order which all of them find, and its steps from the first.
  using Key = std::array<std::int64_t, 6>;

  std::uint32_t corner(std::size_t e, const Index &ends) const
  {
    for (int a = 0; a < BodyMesh<dim>::corners; ++a)
    {
      bool same = true;
      for (int k = 0; k < dim; ++k)
        same = same && (Full<dim, false>::sign(k, a) > 0) == (ends[k] > 0);
      if (same)
        return old_.cells[e * BodyMesh<dim>::corners + a];
    }
    return 0; // unreachable: every choice of ends is a corner
  }

  Key key(std::size_t e, const Index &at) const
  {
    std::vector<int> inside;
    Index            ends{};
    for (int k = 0; k < dim; ++k)
      if (at[k] > 0 && at[k] < degree_)
        inside.push_back(k);
      else
        ends[k] = at[k] == degree_;
    if (inside.size() == 3 || (dim == 2 && inside.size() == 2) || (dim == 1 && inside.size() == 1))
      return {-1, static_cast<std::int64_t>(e), at[0], at[1], at[2], 0};
    // Start from the corner with the least number, walk first to the lesser neighbour.
    std::array<int, 2> flip{};
    std::uint32_t      least = corner(e, ends);
    for (int bits = 0; bits < 1 << inside.size(); ++bits)
    {
      Index try_ends = ends;
      for (std::size_t k = 0; k < inside.size(); ++k)
        try_ends[inside[k]] = bits >> k & 1;
      if (const std::uint32_t c = corner(e, try_ends); c < least)
      {
        least = c;
        for (std::size_t k = 0; k < inside.size(); ++k)
          flip[k] = bits >> k & 1;
      }
    }
    struct Walk
    {
      std::int64_t to;
      int          steps;
    };
    std::vector<Walk> walks;
    for (std::size_t k = 0; k < inside.size(); ++k)
    {
      Index to = ends;
      for (std::size_t l = 0; l < inside.size(); ++l)
        to[inside[l]] = l == k ? !flip[l] : flip[l];
      walks.push_back({corner(e, to), flip[k] ? degree_ - at[inside[k]] : at[inside[k]]});
    }
    std::sort(walks.begin(), walks.end(), [](const Walk &a, const Walk &b) { return a.to < b.to; });
    Key key{static_cast<std::int64_t>(walks.size()), least, 0, 0, 0, 0};
    for (std::size_t k = 0; k < walks.size(); ++k)
    {
      key[2 + 2 * k] = walks[k].to;
      key[3 + 2 * k] = walks[k].steps;
    }
    return key;
  }

  std::uint32_t node(std::size_t e, const Index &at)
  {
    const auto [found, is_new] = known_.try_emplace(key(e, at), static_cast<std::uint32_t>(mesh_.n_nodes()));
    if (is_new)
      for (int i = 0; i < dim; ++i)
      {
        double x = 0;
        for (int a = 0; a < BodyMesh<dim>::corners; ++a)
        {
          double weight = 1;
          for (int k = 0; k < dim; ++k)
            weight *= .5 * (1 + Full<dim, false>::sign(k, a) * point_[at[k]]);
          x += weight * old_.x[i][old_.cells[e * BodyMesh<dim>::corners + a]];
        }
        mesh_.x[i].push_back(x);
      }
    return found->second;
  }

  /// Calls f(index) for all indices below `n` in the first `axes` axes.
  template <class F>
  static void for_all(int n, int axes, F &&f)
  {
    for (int k = 0; k < (axes > 2 ? n : 1); ++k)
      for (int j = 0; j < (axes > 1 ? n : 1); ++j)
        for (int i = 0; i < n; ++i)
          f(Index{i, j, k});
  }

  void add_element(std::size_t e)
  {
    for_all(degree_ + 1, dim, [&](const Index &at) { mesh_.elements.push_back(node(e, at)); });
    for_all(degree_, dim, [&](const Index &at) {
      for (int a = 0; a < BodyMesh<dim>::corners; ++a)
      {
        Index to{};
        for (int k = 0; k < dim; ++k)
          to[k] = at[k] + (Full<dim, false>::sign(k, a) > 0);
        mesh_.cells.push_back(node(e, to));
      }
    });
  }

  /// Place of a corner of an element among its ends.
  Index ends_of(std::size_t e, std::uint32_t corner_node) const
  {
    Index ends{};
    for (int a = 0; a < BodyMesh<dim>::corners; ++a)
      if (old_.cells[e * BodyMesh<dim>::corners + a] == corner_node)
        for (int k = 0; k < dim; ++k)
          ends[k] = Full<dim, false>::sign(k, a) > 0 ? degree_ : 0;
    return ends;
  }

  void add_facet(const typename BodyMesh<dim>::Facet &old)
  {
    const Index origin = ends_of(old.cell, old.node[0]);
    // Steps from the first corner to its neighbours in the ring.
    Index along{}, across{};
    if constexpr (dim >= 2)
      along = ends_of(old.cell, old.node[1]);
    if constexpr (dim == 3)
      across = ends_of(old.cell, old.node[3]);
    for_all(degree_, std::max(dim - 1, 0), [&](const Index &at) {
      if (dim == 1 && at[0] > 0)
        return;
      auto        facet       = old;
      const Index corners[4] = {{at[0], at[1], 0}, {at[0] + 1, at[1], 0}, {at[0] + 1, at[1] + 1, 0}, {at[0], at[1] + 1, 0}};
      Index       lowest{degree_, degree_, degree_};
      for (std::size_t c = 0; c < facet.node.size(); ++c)
      {
        Index place = origin;
        for (int k = 0; k < dim; ++k)
        {
          if (dim >= 2)
            place[k] += (along[k] - origin[k]) / degree_ * corners[c][0];
          if (dim == 3)
            place[k] += (across[k] - origin[k]) / degree_ * corners[c][1];
          lowest[k] = std::min(lowest[k], place[k]);
        }
        facet.node[c] = node(old.cell, place);
        if constexpr (dim >= 2)
          facet.weight[c] = over_even(corners[c][0]);
        if constexpr (dim == 3)
          facet.weight[c] *= over_even(corners[c][1]);
      }
      std::uint32_t cell = 0;
      for (int k = dim - 1; k >= 0; --k)
        cell = cell * static_cast<std::uint32_t>(degree_) + static_cast<std::uint32_t>(std::min(lowest[k], degree_ - 1));
      std::uint32_t cells_of = 1;
      for (int k = 0; k < dim; ++k)
        cells_of *= static_cast<std::uint32_t>(degree_);
      facet.cell = old.cell * cells_of + cell;
      mesh_.facets.push_back(facet);
    });
  }

  /// Quadrature weight of a point of a line over what even shares of the spaces
  /// beside it give.
  double over_even(int k) const
  {
    const double low = point_[std::max(k - 1, 0)], high = point_[std::min(k + 1, degree_)];
    return weight_[k] / (.5 * (high - low));
  }

  const BodyMesh<dim>          old_; ///< a copy
  BodyMesh<dim>               &mesh_;
  int                          degree_;
  std::vector<double>          point_, weight_; ///< of a line
  std::map<Key, std::uint32_t> known_;
};
} // namespace

template <int dim>
void raise_degree(BodyMesh<dim> &mesh, int degree)
{
  require(mesh.degree == 1 && degree >= 2 && degree <= 4, "a mesh is raised once, to degree 2, 3 or 4");
  Raiser<dim>(mesh, degree).raise();
}

template void raise_degree(BodyMesh<1> &, int);
template void raise_degree(BodyMesh<2> &, int);
template void raise_degree(BodyMesh<3> &, int);
} // namespace ogive::fem
