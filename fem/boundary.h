// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/time/time_step.h"
#include "fem/constraints.h"
#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/solver.h"
#include "fem/turn.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// What the outside did to the nodes since the start: work, J, entering the
/// books so that kinetic + internal - external + wall_loss + friction + absorbed
/// stays constant; impulse, N s, so that momentum - impulse does.
struct BoundaryWork
{
  double                external = 0, wall_loss = 0, friction = 0, absorbed = 0;
  std::array<double, 3> impulse{};
};

/// Prescribed motion of nodes: fixed and driven faces, symmetry planes, the
/// axis of axial symmetry. A driven velocity is that of the middle of the step,
/// t_{n+1/2}; a displacement lands the node on x0 + u(t_{n+1}), so that it does
/// not drift. Slave nodes are left to their masters.
template <int dim>
class PrescribedMotion
{
public:
  PrescribedMotion() = default;
  PrescribedMotion(const Parameters &, const std::vector<BodyMesh<dim>> &,
                   const std::vector<std::size_t> &first_node, const Constraints<dim> &);

  /// Sets the prescribed components, of all nodes or of those whose turn it is,
  /// and books the work of the reactions.
  void apply(const TimeStep &, Nodes<dim> &, const std::array<AlignedVector<double>, dim> &v_old, BoundaryWork &,
             const Turn * = nullptr) const;
  /// Sets them in the initial velocities; displaced nodes start at rest.
  void start(Nodes<dim> &) const;
  /// True where component `i` of node `node` is prescribed.
  bool prescribed(std::size_t node, int i) const { return !mask_.empty() && (mask_[node] >> i & 1); }

private:
  static constexpr int held = -1; ///< in place of a boundary: at rest
  struct Entry
  {
    std::uint32_t           node;
    std::array<double, dim> amount;   ///< m/s or m, of the prescribed components
    std::array<int, dim>    boundary; ///< of the scene, or `held`
  };
  void set(std::uint32_t node, int component, int boundary, double amount);
  void hold_planes(const Parameters &, const BodyMesh<dim> &, std::size_t first_node, const Constraints<dim> &);

  std::vector<unsigned char>   mask_; ///< bit i: component i, one entry a node
  std::vector<Entry>           entries_;
  std::vector<std::int64_t>    entry_of_; ///< index into entries_, -1 for none
  std::vector<input::Boundary> boundaries_;
};

/// Flat rigid walls with Coulomb friction. Kinematic: a node that would pass
/// gets the normal velocity that lands it on the wall.
template <int dim>
class RigidWalls
{
public:
  RigidWalls() = default;
  RigidWalls(const Parameters &, std::vector<std::uint32_t> nodes);

  void   apply(const TimeStep &, const PrescribedMotion<dim> &, Nodes<dim> &,
               const std::array<AlignedVector<double>, dim> &v_old, BoundaryWork &, const Turn * = nullptr);
  double force(std::size_t wall) const { return force_.at(wall); }
  AlignedVector<double> &forces() { return force_; }

private:
  /// What one wall gave to one node in this step, N s.
  struct Touch
  {
    std::uint32_t           node;
    std::size_t             wall;
    std::array<double, dim> normal, friction;
  };
  bool touch(std::size_t wall, std::uint32_t node, const TimeStep &, const PrescribedMotion<dim> &,
             Nodes<dim> &, Touch &) const;

  std::vector<input::RigidWall> walls_;
  std::vector<std::uint32_t>    nodes_;
  AlignedVector<double>         force_;   ///< N
  std::vector<Touch>            touches_; ///< of this step
};
} // namespace ogive::fem
