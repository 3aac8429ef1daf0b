// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/solver.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// Nodes that follow others: x_s = sum w x_m, v_s = sum w v_m with w >= 0 and
/// sum w = 1. Hanging nodes of coarsened meshes, and nodes tied to the facets of
/// another body. Forces on a slave act on its masters by the same weights, and
/// so does its mass, m_m += w m_s, so that linear and angular momentum and energy are
/// those of the masters alone. Row sums bound the consistent mass from above
/// and frequencies shrink under constraints: the elements' step bounds hold.
///
/// A slave keeps its own mass in Nodes::mass for those who ask for a stiffness
/// (contact); no sum of masses counts it.
template <int dim>
class Constraints
{
public:
  Constraints() = default;
  /// Reads BodyMesh::hanging, finds the tied nodes, resolves slaves of slaves to
  /// their last masters and moves slave nodes of `meshes` onto their places.
  /// InputError for a tie without nodes or one whose nodes follow themselves.
  Constraints(const Parameters &, std::vector<BodyMesh<dim>> &meshes,
              const std::vector<std::size_t> &first_node);

  bool empty() const { return slaves_.empty(); }
  const std::vector<std::uint32_t> &slaves() const { return slaves_; } ///< ascending
  bool is_slave(std::size_t node) const { return !row_.empty() && row_[node] >= 0; }
  /// Calls f(master, weight) for the masters of a slave; not at all for others.
  template <class F>
  void for_each_master(std::size_t node, F &&f) const
  {
    if (is_slave(node))
      for (std::size_t k = first_[row_[node]]; k < first_[row_[node] + 1]; ++k)
        f(master_[k], weight_[k]);
  }

  /// Hands the lumped masses of the slaves to their masters, once.
  void fold_mass(Nodes<dim> &);
  /// Gives `mass` (kg) to a node, or to its masters.
  void add_mass(Nodes<dim> &, std::uint32_t node, double mass);
  /// Mass of the node's own elements and tied particles, kg.
  double own_mass(const Nodes<dim> &nodes, std::size_t node) const
  {
    return nodes.mass[node] - (folded_.empty() ? 0. : folded_[node]);
  }

  /// Adds the forces of slaves to Nodes::force of their masters; force_of(slave,
  /// f) gives the whole force on a slave, N.
  template <class F>
  void fold_forces(Nodes<dim> &nodes, F &&force_of) const
  {
    for (const std::uint32_t slave : slaves_)
    {
      double f[dim];
      force_of(slave, f);
      for_each_master(slave,
                      [&](std::uint32_t master, double weight)
                      {
                        for (int i = 0; i < dim; ++i)
                          nodes.force[i][master] += weight * f[i];
                      });
    }
  }
  /// Velocities of slaves from those of their masters.
  void follow(Nodes<dim> &) const;

  const std::vector<TieReport> &ties() const { return ties_; }
  /// True for a facet of mesh m that a tie covers: boundaries have no place there.
  bool covered(std::size_t m, std::size_t facet) const { return !covered_.empty() && covered_[m][facet]; }

private:
  struct Terms
  {
    std::vector<std::uint32_t> node;
    std::vector<double>        weight;
  };
  void add_tie(const Tie &, std::size_t slave_mesh, std::size_t master_mesh,
               const std::vector<BodyMesh<dim>> &, const std::vector<std::size_t> &first_node,
               std::vector<Terms> &);
  void resolve(std::uint32_t slave, std::vector<Terms> &terms, std::vector<char> &state) const;
  void store(const std::vector<Terms> &);
  void place(std::vector<BodyMesh<dim>> &, const std::vector<std::size_t> &first_node) const;

  std::vector<std::int64_t>      row_;    ///< row of each node, -1 for a free one
  std::vector<std::uint32_t>     slaves_; ///< node of each row
  std::vector<std::size_t>       first_;  ///< rows of master_ and weight_
  std::vector<std::uint32_t>     master_;
  std::vector<double>            weight_;
  AlignedVector<double>          folded_; ///< kg that slaves gave each node
  std::vector<TieReport>         ties_;
  std::vector<std::vector<bool>> covered_;
};
} // namespace ogive::fem
