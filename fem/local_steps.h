// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"
#include "fem/classed_group.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// Steps of elements by their own bounds (docs/local_steps.md).
///
/// Elements are of classes c = 0 .. top, of steps h 2^c; the step of all has
/// 2^top parts h. The forces of an element act on its nodes as impulses, at the
/// beginning of its own steps and over their length; a node moves steadily from
/// impulse to impulse, so it steps with the finest class that touches it, and all
/// nodes of an element of class 0 do so at every part. Loads, walls and
/// prescribed motion act with the steps of the node, contact and interfaces as
/// elements of the class of the whole step. Elements and whoever pushes see the
/// mean velocity of their own step.
///
/// Momentum is exact: each impulse has its counterpart at the same time. An
/// element of class c works with the mean of two such mean velocities, the node
/// gets the impulse at the velocity it happens to have: the difference is the
/// error that is booked.
///
/// Neighbours differ by at most one class, and each class reaches one layer of
/// elements into those that could be coarser: the bars of the test LocalStepsScheme
/// are stable then, and the shaking between the impulses of a coarser element is small.
template <int dim>
struct LocalSteps
{
  using Vectors                  = std::array<AlignedVector<double>, dim>;
  static constexpr int n_classes = ClassedGroup<dim>::n_classes;

  /// Elements of one body and class.
  struct Unit
  {
    std::size_t                body;  ///< index into groups
    std::size_t                of;    ///< class
    std::vector<std::uint32_t> inner; ///< its nodes that finer elements touch
    std::array<std::vector<double>, dim> start, velocity; ///< of these: x as its step began; v while it sees the mean
    double                     begin = 0, kick = 0; ///< of its present step, s
    double                     given = 0; ///< power of its forces at the mean of the velocities around the kick, W
  };
  struct Push
  {
    std::uint32_t           node;
    std::array<double, dim> force; ///< N, from outside
  };

  bool          on      = false; ///< any body has classes
  bool          chosen  = false; ///< the ratio is free: none if nothing is won
  unsigned char most    = 0;     ///< classes beyond 0 that the scene allows
  unsigned char top     = 0;     ///< coarsest class there is
  std::vector<unsigned char>                        of_node; ///< class of each node
  std::array<std::vector<std::uint32_t>, n_classes> active;  ///< nodes of classes up to this one
  std::vector<Unit>                                 units;
  std::vector<Push>                                 pushed;
  Vectors                                           seen;  ///< mean velocity over the step, m/s
  Vectors                                           begin; ///< x as it began, of nodes finer than it, m

  /// What an archive keeps beside the classes.
  struct State
  {
    double last  = 0; ///< last part, s
    double error = 0; ///< energy that nodes got and no element lost, J
    double ended = 0; ///< 1: by the error
    double count = 0; ///< steps since the classes were last looked at
    double moved = 0; ///< 1: elements changed class after the last step
    double limit = 0; ///< longest whole step that somebody else let pass since then, s
  };
  State state;
};
} // namespace ogive::fem
