// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// What a step in parts keeps (Solver::begin, go_on, finish).
///
/// A node that nobody else pushes gets the force f_n of its elements over the
/// kick of the step. One that is pushed in every part gets it in every part: as
/// one impulse it would shake the node against a steady push. At the end of a
/// step H in parts h its velocity belongs to H/2 - h/2 later than those of the
/// others, so f_n of that time is owed: it counts in the momentum, and is
/// settled at the next f_n. Within a step the force is behind by at most its
/// change over the step.
///
/// Within a step the velocity of such a node changes. Elements are strained by
/// its mean, and work with the mean of two such means; what the nodes got beyond
/// that is booked as error.
template <int dim>
struct Substeps
{
  using Vectors = std::array<AlignedVector<double>, dim>;
  struct Pushed
  {
    std::uint32_t           node;
    std::array<double, dim> force; ///< of its elements and loads at t_n, N
  };

  Vectors               first; ///< velocities in the first part, m/s
  Vectors               path;  ///< way beyond that with the velocities of the first part, m
  Vectors               shift; ///< mean velocity of the last step less its last one, m/s
  Vectors               owed;  ///< impulse of the elements still to come, N s
  std::vector<Pushed>   pushed;
  AlignedVector<double> error{0.}; ///< energy that the nodes got and no element lost, J

  /// Empty in scenes without parts.
  bool on() const { return !first[0].empty(); }
  void resize(std::size_t n)
  {
    for (auto *field : {&first, &path, &shift, &owed})
      for (auto &component : *field)
        component.assign(n, 0.);
  }
};
} // namespace ogive::fem
