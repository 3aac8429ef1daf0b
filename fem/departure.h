// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

namespace ogive::fem
{
/// An element that turns into particles, as it is between two steps: corners in
/// VTK order at x(t_n) with v(t_{n-1/2}), SI.
template <int dim>
struct Departure
{
  static constexpr int                             corners = 1 << dim;
  std::array<std::uint32_t, corners>               node{};
  std::array<std::array<double, dim>, corners>     x0{}, x{}, v{};
  std::array<double, corners>                      mass{};  ///< that leaves each node, kg
  double                                           internal = 0;  ///< J, without the next
  double                                           hourglass = 0; ///< J
  double                                           plastic_work = 0; ///< J, part of `internal`
};
} // namespace ogive::fem
