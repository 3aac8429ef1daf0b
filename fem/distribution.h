// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/constraints.h"
#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/shared_nodes.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive::fem
{
/// Elements shared among the ranks. History and work go with the elements; what
/// tells where they are, numbering, facets and constraints are whole on every
/// rank. A rank keeps up the nodes of its own elements and the masters of these;
/// the lowest rank that keeps a node up owns it: it counts the node in sums and
/// tells others.
///
/// Alone it holds nothing: all elements are in the groups.
template <int dim>
class Distribution
{
public:
  static constexpr int corners = 1 << dim;

  /// A body: elements and cells (those of a spectral element lie between its
  /// nodes) counted from 0 within it.
  struct Body
  {
    BodyMesh<dim>              mesh; ///< without facets and names
    std::size_t                first_node = 0, first_cell = 0, cells_of = 1;
    std::vector<int>           owner; ///< rank of each element
    std::vector<std::uint32_t> place; ///< of each element among its owner's
    std::vector<std::uint32_t> own;   ///< elements of this rank, ascending
    std::vector<char>          alive; ///< of each cell
  };

  /// Nodes, those of one owner after those of another.
  struct NodeList
  {
    std::vector<std::uint32_t> node;
    std::vector<std::size_t>   first; ///< of each rank, and the end
  };

  Distribution() = default;
  Distribution(const Ranks &, const std::vector<BodyMesh<dim>> &, const std::vector<std::size_t> &first_node);

  bool                     alone() const { return ranks_.alone(); }
  const Ranks             &ranks() const { return ranks_; }
  const std::vector<Body> &bodies() const { return bodies_; }
  const SharedNodes       &shared() const { return shared_; }
  std::size_t              n_elements() const; ///< of all ranks and bodies
  /// Rank of each element, body after body.
  std::vector<int> owners() const;

  /// Makes the elements those of the given ranks, and Nodes::role to match.
  void assign(std::span<const int> owner, const Constraints<dim> &, Nodes<dim> &);
  /// What this rank has of body b.
  BodyMesh<dim> own_mesh(std::size_t b) const;
  void          bury(std::size_t b, std::size_t cell) { bodies_[b].alive[cell] = 0; }
  void          set_alive(std::size_t b, std::vector<char> alive) { bodies_[b].alive = std::move(alive); }

  std::array<std::uint32_t, corners> nodes(std::size_t b, std::size_t cell) const;
  int  owner(std::size_t b, std::size_t cell) const { return bodies_[b].owner[cell / bodies_[b].cells_of]; }
  bool own(std::size_t b, std::size_t cell) const { return owner(b, cell) == ranks_.rank(); }
  /// Of a cell within its owner's group, and back for the groups of this rank.
  std::size_t local(std::size_t b, std::size_t cell) const
  {
    const Body &body = bodies_[b];
    return body.place[cell / body.cells_of] * body.cells_of + cell % body.cells_of;
  }
  std::size_t global(std::size_t b, std::size_t local) const
  {
    const Body &body = bodies_[b];
    return body.own[local / body.cells_of] * body.cells_of + local % body.cells_of;
  }

  /// By owner; nodes that nobody owns (graves) are left out.
  NodeList        list(std::span<const std::uint32_t> nodes) const;
  const NodeList &all_nodes() const { return all_; }
  /// Nodes that are known everywhere after each step, and the runs of those that this
  /// rank keeps up in body b.
  const std::vector<Run> &runs(std::size_t b) const { return runs_[b]; }
  /// Gives all ranks the owners' entries. Called by all ranks.
  void tell(const NodeList &, std::span<double *const> arrays) const;

private:
  void find_keepers(const Constraints<dim> &, std::vector<std::pair<std::uint32_t, int>> &further);
  void find_roles(const std::vector<std::pair<std::uint32_t, int>> &further, const Constraints<dim> &,
                  Nodes<dim> &);

  Ranks                         ranks_;
  std::vector<Body>             bodies_;
  std::vector<int>              owner_of_node_; ///< -1 for none
  SharedNodes                   shared_;
  NodeList                      all_;
  std::vector<std::vector<Run>> runs_; ///< one list a body
};
} // namespace ogive::fem
