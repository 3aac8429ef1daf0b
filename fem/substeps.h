// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>

namespace ogive::fem
{
/// What a step in parts keeps (Solver::begin, go_on, finish). The elements push
/// the nodes once a step, what others push comes in every part: within the step
/// the velocity of a node jumps. Elements are strained by its mean over the
/// step, and work with the mean of two such means, while the nodes were pushed
/// at the velocities just before and after: the difference is booked as error.
template <int dim>
struct Substeps
{
  using Vectors = std::array<AlignedVector<double>, dim>;

  Vectors               first; ///< velocities in the first part, m/s
  Vectors               path;  ///< way beyond that with the velocities of the first part, m
  Vectors               shift; ///< mean velocity of the last step less its last one, m/s
  AlignedVector<double> error{0.}; ///< energy that the nodes got and no element lost, J

  /// Empty in scenes without parts.
  bool on() const { return !first[0].empty(); }
  void resize(std::size_t n)
  {
    for (auto *field : {&first, &path, &shift})
      for (auto &component : *field)
        component.assign(n, 0.);
  }
};
} // namespace ogive::fem
