// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ogive::fem
{
/// State of some elements of a body outside their group: what a checkpoint keeps
/// and what goes with elements to another rank.
struct ElementStore
{
  struct Array
  {
    std::string         name;
    std::size_t         width = 0; ///< numbers an element
    std::vector<double> values;    ///< element after element
  };
  std::vector<Array> arrays;
  std::vector<Array> nodes;       ///< width 1, all nodes of the body
  double             bound   = 0; ///< largest 2/dt of all ranks, 1/s
  double             element = 0; ///< that sets it, within the body
};
} // namespace ogive::fem
