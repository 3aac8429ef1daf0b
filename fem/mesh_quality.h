// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"
#include "core/input/scene.h"
#include "fem/mesh.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ogive::fem
{
/// How good the elements of a body are, and which of them hold the step down.
struct MeshQuality
{
  /// A figure of one element, and which.
  struct Worst
  {
    double       value   = 0;
    std::size_t  element = 0;  ///< of the body, counted from 0
    std::int64_t number  = -1; ///< as the mesh file counts; -1: generated
    Vec3         where   = Vec3::Zero(); ///< its middle, m
  };

  std::string body;
  std::size_t elements = 0, nodes = 0;
  /// Least over the corners of det[e1 e2 e3]/(|e1||e2||e3|) with the edges that
  /// leave the corner: 1 for a brick, 0 for a flat corner.
  Worst       jacobian;
  Worst       aspect;       ///< longest over shortest edge of an element
  double      shortest = 0, longest = 0; ///< edges, m
  Worst       step;         ///< least bound of the step by an element alone, s, without the step factor
  double      step_twentieth = 0, step_median = 0; ///< s: bounds that 5 % and 50 % of the elements undercut or meet
  double      share_near     = 0; ///< of elements whose bound is at most twice the least
  std::map<std::string, std::size_t> faces; ///< facets of each boundary
  std::vector<std::string>           notes, warnings;
};

/// The step bound of each element is that of its formulation, alone.
template <int dim>
MeshQuality measure_quality(const BodyMesh<dim> &, const std::string &body_name, const input::FemOptions &);
} // namespace ogive::fem
