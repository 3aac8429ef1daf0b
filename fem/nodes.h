// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// All nodes of the solver, body after body, SI.
template <int dim>
struct Nodes
{
  std::array<AlignedVector<double>, dim> x0, x, v;
  std::array<AlignedVector<double>, dim> v_mean; ///< mean of the last two half-step velocities
  std::array<AlignedVector<double>, dim> force;  ///< from the coupling layer
  std::array<std::vector<char>, dim>     held;   ///< 1 where the component is prescribed
  AlignedVector<double>                  mass;
  std::vector<int>                       body; ///< index into the scene's bodies
  std::vector<std::int64_t>              id;

  std::size_t size() const { return mass.size(); }

  void resize(std::size_t n)
  {
    for (auto *field : {&x0, &x, &v, &v_mean, &force})
      for (auto &component : *field)
        component.resize(n, 0.);
    for (auto &component : held)
      component.resize(n, 0);
    mass.resize(n, 0.);
    body.resize(n, 0);
    id.resize(n, 0);
  }
};
} // namespace ogive::fem
