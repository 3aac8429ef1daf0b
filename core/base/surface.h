// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive
{
/// The face that a solver shows to the coupling layer. The spans view arrays
/// that the solver owns: valid until its next step or load. Units SI; forces
/// are N (per metre in plane strain, per square metre in one dimension, of the
/// whole ring in axial symmetry).
///
/// Points are the nodes of the mesh or the particles. `force` is written by the
/// coupling layer (the solver clears it when it has used it) and holds the
/// forces at the beginning of the step, x(t_n).
template <int dim>
struct Surface
{
  std::size_t                                    n = 0; ///< points of the solver
  std::array<std::span<const double>, dim>       x;     ///< m
  std::array<std::span<const double>, dim>       v;     ///< m/s at t_{n-1/2}
  std::span<const double>                        mass;  ///< kg
  std::span<const int>                           body;  ///< index into the scene's bodies
  std::span<const std::int64_t>                  id;    ///< stable name of a point
  std::array<std::span<double>, dim>             force; ///< N, accumulated by the coupling layer

  /// Points that may touch: surface nodes of the meshes, all particles that
  /// are near their body's surface.
  std::vector<std::uint32_t> contact_points;
  /// Half a particle spacing for particles, 0 for nodes; one entry a point,
  /// empty for a solver whose points are all nodes.
  std::span<const double> radius;

  /// A boundary facet of a mesh: corner points ordered so that the outward
  /// normal is right-handed (3-D: quad, counter-clockwise seen from outside;
  /// 2-D: segment with the outside on the right of a -> b; 1-D: one point).
  struct Facet
  {
    static constexpr int                 n_nodes = dim == 3 ? 4 : dim;
    std::array<std::uint32_t, n_nodes>   node;
    int                                  body    = -1;
    std::uint32_t                        element = 0; ///< the element behind it
    double                               outward = 1; ///< 1-D: sign of the outward normal
    bool                                 bared   = false; ///< a seam: the element beyond it turned into particles
  };
  std::vector<Facet> facets; ///< empty for particles
  /// Changes whenever the lists above or the order of the points change.
  std::uint64_t topology = 0;
};
} // namespace ogive
