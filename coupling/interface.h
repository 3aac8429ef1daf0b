// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/archive.h"
#include "core/time/time_step.h"
#include "coupling/surfaces.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// A seam between a particle body and a mesh body.
struct InterfaceSpec
{
  std::string      name;
  std::string      method = "tied";
  int              particles = 0, mesh = 0; ///< index into Scene::bodies
  std::string      particle_body, mesh_body;
  std::vector<int> symmetry_axes;
  bool             axisymmetric = false;
  double           damping = .1, pair_viscosity = 1; ///< see input::Interface
  int              per_edge = 0; ///< particles an edge of converting elements; 0: two bodies
};

/// Particles that some mesh carries, of all interfaces together: a particle
/// has one carrier. Velocities (m/s) and forces (N) in the order of `id`.
template <int dim>
struct Slaves
{
  std::vector<std::int64_t>             id;
  std::array<std::vector<double>, dim>  velocity, force;

  bool holds(std::int64_t id) const;
  void add(std::int64_t id);
};

/// Work of the interface forces, J. What the particles give the mesh should
/// take: the difference is the interface's own error.
struct InterfaceEnergy
{
  double work_on_mesh      = 0;
  double work_on_particles = 0;
  double residue() const { return work_on_mesh + work_on_particles; }
};

/// One way to join particles and mesh. Called once a step, in this order:
/// gather, (mesh steps), drive, (particles step), close.
template <int dim>
class Interface
{
public:
  virtual ~Interface() = default;

  /// Between two steps, after elements have turned into particles.
  virtual void renew() {}

  /// Adds its forces at t_n to Faces::force; Slaves::force is what acts on the
  /// slaves at t_n, contact included.
  virtual void gather(Faces<dim> &, const Slaves<dim> &) = 0;
  /// Writes the velocities at t_{n+1/2} of its slaves. The faces show the mesh alone.
  virtual void drive(const Faces<dim> &, Slaves<dim> &) const = 0;
  /// Books the work of the step.
  virtual void close(const Faces<dim> &, const Slaves<dim> &, const TimeStep &) = 0;

  virtual const InterfaceEnergy &energy() const                                   = 0;
  virtual void                   snapshot()                                       = 0;
  virtual void                   restore()                                        = 0;
  virtual void                   save(ArchiveWriter &, const std::string &) const = 0;
  virtual void                   load(const ArchiveReader &, const std::string &) = 0;
};

/// Builds the interface that `spec.method` names, at the initial state: it may
/// add slaves and give their mass to the mesh. InputError if the method is
/// unknown or no particle lies at the seam.
template <int dim>
std::unique_ptr<Interface<dim>> make_interface(const InterfaceSpec &spec, MeshPort<dim> &,
                                               ParticlePort<dim> &, Slaves<dim> &);
/// Names of the methods that exist.
std::vector<std::string> interface_methods();
} // namespace ogive::coupling
