// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/base/culprit.h"
#include "core/base/error.h"
#include "core/base/sample.h"
#include "core/base/simd.h"
#include "core/input/scene.h"
#include "core/time/time_step.h"
#include "fem/mesh.h"
#include "fem/nodes.h"
#include "fem/shared_nodes.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ogive::fem
{
/// Factor by which the mass of elements must grow for the step of the bound
/// dt = 2/(D/2 + sqrt(D^2/4 + w^2)) to be 2/s: both D and w^2 go with 1/mass.
template <class T>
T mass_factor(const T &damping, const T &frequency2, double s)
{
  return stdx::max(T((frequency2 + s * damping) * (1. / (s * s))), T(1.));
}

/// Where a group's elements stand among all of the solver.
struct GroupPlace
{
  std::size_t first_node    = 0; ///< of the body, among the solver's nodes
  std::size_t first_element = 0; ///< global id of the group's first element
  std::size_t grave         = 0; ///< first of 2^dim nodes where the dead of an eroding body rest
  /// On ranks, which have a part of the body each, or nothing of it; else none.
  const SharedNodes                *shared = nullptr;
  const std::vector<std::uint32_t> *own    = nullptr; ///< which of the body's elements are here
};

/// The elements of one body in one formulation, with their history. One virtual
/// call a step; lanes of a register are elements inside.
template <int dim>
class ElementGroup
{
public:
  static constexpr int corners = 1 << dim;
  using Visitor                = std::function<void(const std::string &, AlignedVector<double> &)>;
  using NodeVisitor            = std::function<void(std::uint32_t node, std::size_t force_index)>;

  virtual ~ElementGroup() = default;

  virtual int         body() const = 0;
  virtual std::size_t size() const = 0; ///< elements
  /// Cells with a node at each corner and none else: the elements, or what the
  /// nodes of a spectral element part it into. Facets and samples name cells.
  virtual std::size_t cells() const { return size(); }
  /// Solver nodes of a cell, VTK order.
  virtual std::array<std::uint32_t, corners> nodes(std::size_t cell) const = 0;
  /// Component i of the elements' forces at the nodes of the body at t_n, N.
  virtual std::span<const double> nodal_forces(int i) const = 0;
  /// Visits each node of each element with the index of its component 0 in the
  /// arrays of tangent(); component d follows d * simd_width entries later.
  virtual void for_each_node(const NodeVisitor &) const = 0;

  /// Adds the lumped mass of the elements to the nodes, kg; after initialise().
  virtual void lump_mass(Nodes<dim> &) const = 0;
  /// Shape, zero forces, masses and step bound of the undeformed state at nodes.x.
  virtual void initialise(const Nodes<dim> &) = 0;
  /// Mass that was added for the sake of the step, kg; known after initialise().
  virtual double added_mass() const = 0;
  /// Takes the step of the elements: internal energy with the forces of t_n,
  /// then strain, stress and forces at x(t_{n+1}).
  virtual StepStatus advance(const Nodes<dim> &, const TimeStep &) = 0;
  /// Bound of the step at the present state, without a safety factor.
  virtual StepLimit stable_dt() const = 0;

  /// What small displacements u (m) at the nodes make of elastic forces, and
  /// velocities u (m/s) of viscous ones, N at the nodes of each element, against
  /// the motion, at the present shape and sound speeds.
  virtual void tangent(const Nodes<dim> &, const std::array<AlignedVector<double>, dim> &u,
                       AlignedVector<double> &stiff, AlignedVector<double> &damp) const = 0;

  virtual void add_energies(Balance &) const                   = 0;
  virtual void sample(const Nodes<dim> &, Sample &) const      = 0;
  /// Arrays called nodal_.. or weak_acceleration_.. have an entry for each node of
  /// the body, "limit" is 2/dt and the element that sets it, all others have a
  /// fixed number of entries an element, in packs.
  virtual void for_each_state(const Visitor &)                 = 0;
  /// Cost of a step of an element, in points of one-point elements: counted, not timed.
  virtual double work(std::size_t) const { return 1; }

  /// What leaves with an element: lumped mass at its corners, kg; J of energy:
  /// internal (with what bulk viscosity heated), in hourglass patterns.
  struct Remains
  {
    std::array<double, corners> mass{};
    double                      internal_energy = 0, hourglass_energy = 0, plastic_work = 0;
  };
  /// History of a cell, the mean over its points, into entry k.
  virtual void copy_state(std::size_t cell, materials::Points &, std::size_t k) const = 0;
  /// Adds the stress of damp() in a cell to entry k.
  virtual void add_damping_stress(std::size_t, materials::Points &, std::size_t) const {}
  /// Viscous stress `share` (L/c) C : D in these elements, in none else; L the
  /// size of an element. One-point elements only; others have none.
  virtual void damp(std::span<const std::size_t>, double) {}

  /// Share of elements in the energy and mass of the material they stand for;
  /// Nodes::mass loses the rest. Once, after lump_mass().
  virtual void weigh(std::span<const std::size_t>, std::span<const double>, Nodes<dim> &)
  {
    throw InputError({"", 0, "FEM/element"}, "elements of this formulation cannot share their material with particles",
                     "one-point");
  }

  /// Death of elements. Formulations whose elements cannot die keep these.
  /// Called once before the first step: places the nodes of the grave.
  virtual void prepare_erosion(Nodes<dim> &)
  {
    throw InputError({"", 0, "Bodies"}, "elements of this formulation cannot leave the mesh",
                     "erosion none and method fem, or element = one-point");
  }
  /// Adds the living that must die now: all points of an element have failed, or
  /// one of the other criteria holds. Ascending.
  virtual void find_failed(const input::Erosion &, std::vector<std::size_t> &) const {}
  /// Corner forces, stress and hourglass forces of e are zero from now on.
  virtual Remains kill(std::size_t) { return {}; }
  /// What would leave with e.
  virtual Remains remains(std::size_t) const { return {}; }
  /// How near each element is to turning into particles: 1 or more where it
  /// must, 0 for the dead (input::Conversion).
  virtual void    measure(const input::Conversion &, std::vector<double> &of) const { of.assign(size(), 0.); }
  virtual bool    alive(std::size_t) const { return true; }
  /// Nodal forces of those who are left.
  virtual void sum_forces() {}
  /// After the state was read or taken back: sorts the living from the dead.
  virtual void rebury() {}
  /// After the state was read or taken back: elements that slept are computed again.
  virtual void wake() {}
  /// Elements that the last advance() left out, since nothing has reached them.
  virtual std::size_t skipped() const { return 0; }
};

/// Elements of the formulation that the mesh names (input::Body::element).
template <int dim>
std::unique_ptr<ElementGroup<dim>> make_element_group(const BodyMesh<dim> &, const GroupPlace &,
                                                      const input::FemOptions &);
} // namespace ogive::fem
