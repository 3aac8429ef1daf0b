// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/halo.h"
#include "core/parallel/ranks.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ogive::fem
{
/// Nodes whose elements lie on several ranks, and sums over them. Nodes are
/// counted among all of the solver.
class SharedNodes
{
public:
  SharedNodes() = default;
  /// `nodes` ascend; with[r]: places among them that rank r has too, ascending.
  SharedNodes(const Ranks &, std::vector<std::uint32_t> nodes, std::vector<std::vector<std::uint32_t>> with);

  const Ranks                      &ranks() const { return ranks_; }
  const std::vector<std::uint32_t> &nodes() const { return nodes_; }
  std::size_t                       neighbours() const { return halo_.neighbours(); }
  std::size_t                       given() const { return halo_.given(); }

  /// Adds up what the ranks have at their shared nodes in [first, last), in the order
  /// of ranks: all end with the same bits. Entry 0 of each array is node `first`.
  /// Called by all ranks.
  void sum(std::span<double *const> arrays, std::size_t first = 0,
           std::size_t last = std::numeric_limits<std::size_t>::max()) const;

private:
  Ranks                       ranks_;
  std::vector<std::uint32_t>  nodes_;
  Halo                        halo_;
  mutable std::vector<double> records_;
};
} // namespace ogive::fem
