// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/constraints.h"
#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/solver.h"

#include <array>
#include <vector>

namespace ogive::fem
{
/// Pressures on faces, of the present shape, and body forces: nodal forces with
/// a history in time.
template <int dim>
class Loads
{
public:
  Loads() = default;
  Loads(const Parameters &, const std::vector<BodyMesh<dim>> &, const std::vector<std::size_t> &first_node,
        const Constraints<dim> &);

  bool empty() const { return pressures_.empty() && body_forces_.empty(); }
  /// The forces at `time` (s) and nodes.x, N.
  void gather(const Nodes<dim> &, const Constraints<dim> &, double time,
              std::array<AlignedVector<double>, dim> &force) const;

private:
  struct Pressure
  {
    typename BodyMesh<dim>::Facet facet; ///< nodes counted among all of the solver
    double                        pressure;
    std::size_t                   boundary;
  };
  struct BodyForce
  {
    std::size_t first_node, last_node, boundary;
    Vec3        acceleration;
  };
  std::vector<Pressure>       pressures_;
  std::vector<BodyForce>      body_forces_;
  std::vector<input::History> history_; ///< of each boundary of the scene
  bool                        axisymmetric_ = false;
};
} // namespace ogive::fem
