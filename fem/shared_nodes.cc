// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/shared_nodes.h"

#include <algorithm>

namespace ogive::fem
{
SharedNodes::SharedNodes(const Ranks &ranks, std::vector<std::uint32_t> nodes,
                         std::vector<std::vector<std::uint32_t>> with)
    : ranks_(ranks), nodes_(std::move(nodes)), halo_(ranks, with, with)
{
}

void SharedNodes::sum(std::span<double *const> arrays, std::size_t first, std::size_t last) const
{
  const std::size_t width = arrays.size();
  records_.assign(nodes_.size() * width, 0.);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k] >= first && nodes_[k] < last)
      for (std::size_t f = 0; f < width; ++f)
        records_[k * width + f] = arrays[f][nodes_[k] - first];
  halo_.sum(records_.data(), width, 0, width);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k] >= first && nodes_[k] < last)
      for (std::size_t f = 0; f < width; ++f)
        arrays[f][nodes_[k] - first] = records_[k * width + f];
}
} // namespace ogive::fem
