// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// Nodes [first, last).
struct Run
{
  std::size_t first = 0, last = 0;
};

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

  /// What a rank has to do with a node (fem/distribution.h); empty: all is its own.
  enum Role : unsigned char
  {
    none  = 0,
    felt  = 1, ///< its loads act on nodes of this rank
    kept  = 3, ///< moved by this rank
    owned = 7  ///< and counted by it
  };
  std::vector<unsigned char> role;

  bool feels(std::size_t a) const { return role.empty() || role[a] != none; }
  bool keeps(std::size_t a) const { return role.empty() || role[a] >= kept; }
  bool counts(std::size_t a) const { return role.empty() || role[a] == owned; }

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
