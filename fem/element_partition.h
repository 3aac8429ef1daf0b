// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"
#include "fem/mesh.h"

#include <array>
#include <string>
#include <vector>

namespace ogive::fem
{
/// Elements as those see them who share them out: all of them on every rank.
template <int dim>
struct ElementCloud
{
  static constexpr int                           corners = 1 << dim;
  std::array<std::vector<double>, dim>           x;      ///< centres, m
  std::vector<double>                            work;   ///< counted cost of a step, > 0
  std::vector<std::array<double, dim>>           vertex; ///< m
  std::vector<std::array<unsigned int, corners>> cell;   ///< vertices of each element, VTK order
};

/// A rank for each element, so that the work of all ranks is even. "rcb": boxes of
/// recursive coordinate bisection (Zoltan); "p4est": pieces of the space-filling
/// curve of p4est through a forest whose trees are the elements, as deal.II orders
/// them; in one dimension, which p4est lacks, "rcb". Depends on the elements and the
/// number of ranks alone. Called by all ranks.
template <int dim>
std::vector<int> partition_elements(const Ranks &, const std::string &how, const ElementCloud<dim> &);

/// The second of these.
template <int dim>
std::vector<int> partition_by_forest(const Ranks &, const ElementCloud<dim> &);
} // namespace ogive::fem
