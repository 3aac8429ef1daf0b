// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <span>

namespace ogive::fem
{
/// Whose turn it is in a part of a step (fem/local_steps.h): nodes of one class.
struct Turn
{
  std::span<const unsigned char> of;             ///< class of each node
  unsigned char                  who        = 0; ///< class
  bool                           first      = true; ///< part of the step
  double                         whole_kick = 0;    ///< of the step, s

  bool takes(std::size_t node) const { return of[node] == who; }
};
} // namespace ogive::fem
