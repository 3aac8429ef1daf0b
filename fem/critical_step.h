// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"
#include "fem/boundary.h"
#include "fem/constraints.h"
#include "fem/element_group.h"

#include <vector>

namespace ogive::fem
{
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
  using Groups = std::vector<const ElementGroup<dim> *>;

  /// What the nodes are not free to do.
  struct Bonds
  {
    const PrescribedMotion<dim> &held;
    const Constraints<dim>      &constraints;
    const SharedNodes           *shared = nullptr; ///< on ranks, which all take part
  };

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
  Answer estimate(const Groups &, const Nodes<dim> &, const Bonds &, double tolerance, int most);

  template <class F>
  void for_each_state(F &&f)
  {
    for (int i = 0; i < dim; ++i)
      f(i, motion_[i]);
  }

private:
  using Field = std::array<AlignedVector<double>, dim>;
  static double sum(const Bonds &bonds, double own) { return bonds.shared ? bonds.shared->ranks().sum(own) : own; }
  std::uint32_t fastest(const Nodes<dim> &, const Bonds &) const;
  void apply(const Groups &, const Nodes<dim> &, const Bonds &);
  void scale(const Nodes<dim> &, const Bonds &);

  Field                 motion_, stiff_, damp_; ///< nodes
  AlignedVector<double> element_stiff_, element_damp_; ///< at the nodes of each element
};
} // namespace ogive::fem
