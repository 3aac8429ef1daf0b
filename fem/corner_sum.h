// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"
#include "fem/element_group.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ogive::fem
{
/// Sums the forces of the elements at their corners to the nodes, node by node
/// in a fixed order: no conflicts, and the same bits every time.
template <int dim>
class CornerSum
{
public:
  CornerSum() = default;
  CornerSum(std::size_t first_node, std::size_t last_node, const ElementGroup<dim> &group)
    : first_node_(first_node)
  {
    first_.assign(last_node - first_node + 1, 0);
    group.for_each_node([&](std::uint32_t node, std::size_t) { ++first_[node - first_node + 1]; });
    for (std::size_t a = 0; a + 1 < first_.size(); ++a)
      first_[a + 1] += first_[a];
    corner_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    group.for_each_node([&](std::uint32_t node, std::size_t force_index) {
      corner_[next[node - first_node]++] = static_cast<std::uint32_t>(force_index);
    });
  }

  /// Force on node `a` of the solver from the group's corner forces, N.
  void at(std::size_t a, const double *forces, double (&sum)[dim]) const
  {
    for (double &s : sum)
      s = 0;
    const std::size_t row = a - first_node_;
    for (std::uint32_t k = first_[row]; k < first_[row + 1]; ++k)
      for (int i = 0; i < dim; ++i)
        sum[i] += forces[corner_[k] + static_cast<std::size_t>(i) * simd_width];
  }

private:
  std::size_t                first_node_ = 0;
  std::vector<std::uint32_t> first_, corner_;
};
} // namespace ogive::fem
