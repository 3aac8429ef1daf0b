// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/time/time_step.h"
#include "fem/boundary.h"
#include "fem/constraints.h"
#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/turn.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ogive::fem
{
/// Faces that let waves out: tractions t_n = -rho c_p v_n, t_t = -rho c_s v_t of
/// dashpots with the impedances of the material at rest (Lysmer and Kuhlemeyer,
/// J. Eng. Mech. Div. ASCE 95 (1969) 859), lumped to the nodes of the present
/// shape. The force of a node follows the mean velocity of the step,
///   m (v+ - v-) = kick (f - C (v+ + v-)/2),
/// so what it takes, kick C v_mean . v_mean, is positive and exactly booked, and
/// no step is too long for it.
template <int dim>
class AbsorbingFaces
{
public:
  AbsorbingFaces() = default;
  AbsorbingFaces(const Parameters &, const std::vector<BodyMesh<dim>> &,
                 const std::vector<std::size_t> &first_node, const Constraints<dim> &);

  bool empty() const { return facets_.empty(); }
  /// Corrects velocities that were kicked without the dashpots. Prescribed
  /// components and slave nodes feel none; the masters of slaves do.
  void apply(const TimeStep &, const PrescribedMotion<dim> &, const Constraints<dim> &, Nodes<dim> &,
             const std::array<AlignedVector<double>, dim> &v_old, const Turn * = nullptr);
  /// Books the impulses of the step just made, with its mean velocities.
  void book(const Nodes<dim> &, BoundaryWork &, const Turn * = nullptr) const;

private:
  using Matrix = Eigen::Matrix<double, dim, dim>;
  using Vector = Eigen::Matrix<double, dim, 1>;
  struct Facet
  {
    typename BodyMesh<dim>::Facet facet;         ///< nodes counted among all of the solver
    double                        normal, shear; ///< impedances rho c, kg/(m^2 s)
  };
  std::size_t slot(std::uint32_t node);

  std::vector<Facet>                             facets_;
  std::unordered_map<std::uint32_t, std::size_t> slot_;    ///< of each node with a dashpot
  std::vector<std::uint32_t>                     nodes_;   ///< of each slot
  std::vector<Matrix>                            damping_; ///< C, kg/s, of this step
  std::vector<Vector>                            impulse_; ///< N s, of this step
  bool                                           axisymmetric_ = false;
};
} // namespace ogive::fem
