// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/boundary.h"
#include "fem/corner_sum.h"
#include "fem/element_group.h"

#include <vector>

namespace ogive::fem
{
/// A body's elements and how their forces come to the nodes.
template <int dim>
struct AssembledGroup
{
  const ElementGroup<dim> *group;
  const CornerSum<dim>    *sum;
  std::size_t              first_node, last_node;
};

/// The critical step of the assembled mesh by power iteration. The leapfrog is
/// stable iff M - dt/2 C - dt^2/4 K is not negative (numerics.md, "Time"); with v
/// the least favourable motion so far, v.M.v = 1, the step is the root of
/// dt/2 v.C.v + dt^2/4 v.K.v = 1, and M^-1 (dt/2 C + dt^2/4 K) v the next motion.
/// K is the elastic tangent with hourglass stiffness at the present shape and
/// sound speeds, C the linear bulk viscosity and hourglass damping. A Rayleigh
/// quotient meets the step from above.
template <int dim>
class CriticalStep
{
public:
  /// A motion with no symmetry, the same in every run.
  explicit CriticalStep(std::size_t n_nodes = 0);

  struct Answer
  {
    double        dt         = 0; ///< s
    int           iterations = 0;
    std::uint32_t node       = 0; ///< that moves most
  };
  /// Goes on from the last motion until the step changes by less than
  /// `tolerance` (relative) in each of ten iterations.
  Answer estimate(const std::vector<AssembledGroup<dim>> &, const Nodes<dim> &, const PrescribedMotion<dim> &,
                  double tolerance, int most);

  template <class F>
  void for_each_state(F &&f)
  {
    for (int i = 0; i < dim; ++i)
      f(i, motion_[i]);
  }

private:
  using Field = std::array<AlignedVector<double>, dim>;
  void   apply(const std::vector<AssembledGroup<dim>> &, const Nodes<dim> &);
  double scale(const Nodes<dim> &, const PrescribedMotion<dim> &);

  Field                 motion_, stiff_, damp_; ///< nodes
  AlignedVector<double> corner_stiff_, corner_damp_;
};
} // namespace ogive::fem
