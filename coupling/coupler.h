// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "core/parallel/ranks.h"
#include "coupling/contact.h"
#include "coupling/interface.h"
#include "coupling/surfaces.h"

#include <memory>
#include <string>
#include <vector>

namespace ogive::fem
{
template <int dim>
class Solver;
}
namespace ogive::sph
{
template <int dim>
class Solver;
}

namespace ogive::coupling
{
/// What coupling contributes to the ledger at t_{n+1/2}. J, N s.
struct CouplingBalance
{
  double contact_stored = 0; ///< in the springs: part of the total
  double friction_heat  = 0; ///< part of the total
  double contact_taken  = 0; ///< minus the work of contact on the bodies
  double contact_eroded = 0; ///< was in springs of which a side died
  double contact_loss   = 0; ///< taken - stored - heat: numerical, not in the total
  double conversion_heat = 0; ///< of elements turned into particles: part of the total
  double interface_work = 0; ///< net work of the interfaces: numerical, not in the total
  double work_on_mesh      = 0; ///< by contact and interfaces
  double work_on_particles = 0;
  double contact_impulse   = 0; ///< sum of |force| dt, N s
  Vec3   plane_impulse = Vec3::Zero(); ///< of symmetry planes, through contact, N s
};

/// Joins the two solvers of a run. One step:
///   gather, mesh.step, drive, particles.step, close.
/// Construct it at the initial state, before the first step and before a
/// checkpoint is loaded into anything: weights and masses of the interfaces and
/// initial overlaps are those of t = 0.
template <int dim>
class Coupler
{
public:
  /// Either solver may be null. InputError names what is wrong in the scene's
  /// contacts and interfaces. `ranks`: those that share both solvers; they call all
  /// functions alike.
  Coupler(const input::Scene &, fem::Solver<dim> *, sph::Solver<dim> *, const Ranks &ranks = {});
  /// The same between any two parties. Where there are several ranks, the port of
  /// the particles shows each of them its own.
  Coupler(const input::Scene &, std::unique_ptr<MeshPort<dim>>, std::unique_ptr<ParticlePort<dim>>,
          const Ranks &ranks = {});
  ~Coupler();

  /// Between two steps, after elements have turned into particles.
  void renew();
  /// Contact and interface forces at t_n into Surface::force of both parties
  /// (what stands there is cleared first). In a part of a step `own_share` of
  /// what particles do to their slaves acts.
  void gather(double own_share = 1);
  /// Velocities of the tied particles, from the nodes just kicked.
  void drive();
  /// Books the energy of the step. Call once both parties have stepped.
  void close(const TimeStep &);

  StepLimit       stable_dt() const;
  CouplingBalance balance() const;
  void            snapshot();
  void            restore();
  void            save(ArchiveWriter &, const std::string &prefix) const;
  void            load(const ArchiveReader &, const std::string &prefix);

  /// Force on body `a` by body `b` through contact at the last gather, N.
  Vec3        contact_force(int a, int b) const { return contacts_->force(a, b); }
  std::size_t active_contacts() const { return contacts_->active(); }
  std::int64_t lost_contacts() const { return contacts_->lost(); }
  const std::vector<InitialOverlap> &initial_overlaps() const { return contacts_->initial_overlaps(); }
  /// What must be moved before the run, where overlaps are to be healed. Whoever
  /// has moved it makes another Coupler and tells it what this one had found.
  const std::vector<Move>           &moves() const { return moves_; }
  const std::vector<InitialOverlap> &healed() const { return healed_; }
  void report_healed(std::vector<InitialOverlap> healed) { contacts_->report_healed(std::move(healed)); }
  std::size_t tied_particles() const { return slaves_.id.size(); }

private:
  void share_slave_forces(const Faces<dim> &, double own_share);
  void build_interfaces(const input::Scene &);
  void build_contacts(const input::Scene &);

  Ranks                                        ranks_;
  std::unique_ptr<MeshPort<dim>>               mesh_;
  std::unique_ptr<ParticlePort<dim>>           particles_;
  bool                                         axisymmetric_ = false;
  std::vector<std::string>                     interface_names_;
  std::vector<std::unique_ptr<Interface<dim>>> interfaces_;
  Slaves<dim>                                  slaves_;
  std::unique_ptr<ContactSet<dim>>             contacts_;
  std::vector<Move>                            moves_;
  std::vector<InitialOverlap>                  healed_;
};
} // namespace ogive::coupling
