// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/element_partition.h"

#include "core/base/error.h"
#include "core/parallel/partition.h"

#include <span>

namespace ogive::fem
{
template <int dim>
std::vector<int> partition_elements(const Ranks &ranks, const std::string &how, const ElementCloud<dim> &all)
{
  const std::size_t n = all.work.size();
  if (ranks.alone())
    return std::vector<int>(n, 0);
  if (how == "p4est" && dim > 1)
    return partition_by_forest(ranks, all);
  if (how != "rcb" && how != "p4est")
    throw InputError({"", 0, "Parallel/partition"}, "is " + how, "rcb or p4est");
  // Each rank brings in an even part of the elements.
  const auto at = [&](int r)
  { return n * static_cast<std::size_t>(r) / static_cast<std::size_t>(ranks.size()); };
  const std::size_t                        first = at(ranks.rank()), count = at(ranks.rank() + 1) - first;
  std::array<std::span<const double>, dim> x;
  for (int i = 0; i < dim; ++i)
    x[i] = std::span(all.x[i]).subspan(first, count);
  Partition<dim> partition(ranks);
  return ranks.gather(partition.cut(x, std::span(all.work).subspan(first, count)));
}

template std::vector<int> partition_elements(const Ranks &, const std::string &, const ElementCloud<1> &);
template std::vector<int> partition_elements(const Ranks &, const std::string &, const ElementCloud<2> &);
template std::vector<int> partition_elements(const Ranks &, const std::string &, const ElementCloud<3> &);
} // namespace ogive::fem
