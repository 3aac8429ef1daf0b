// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/archive.h"
#include "core/time/time_step.h"
#include "coupling/contact_pair.h"
#include "coupling/fragments.h"
#include "coupling/surfaces.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// What contact did to the energy so far. The work of the contact forces is
/// taken with the mean velocities over each kick, as the solvers take theirs:
///   taken = stored + friction_heat + eroded + loss,
/// where `loss` is what neither the springs nor friction account for: contacts
/// that open and close between two steps, and turning normals. J.
struct ContactEnergy
{
  double taken         = 0; ///< minus the work done on the bodies
  double stored        = 0; ///< in the springs at t_{n+1/2}: sum 1/2 k g_n g_{n+1}, normal and tangential
  double friction_heat = 0;
  double eroded        = 0; ///< was in springs of which a side died
  double work[2]       = {0, 0}; ///< on the points of each party
  double loss() const { return taken - stored - friction_heat - eroded; }
};

/// Bodies that already overlap at the start. At rest: their gap then counts as
/// zero until it opens. Healed: the points were moved apart.
struct InitialOverlap
{
  std::string contact;
  std::size_t count = 0;
  double      worst = 0; ///< m
  Vec3        where = Vec3::Zero();
  bool        healed = false;
  double      moved  = 0; ///< farthest that a point was moved to heal it, m

  /// For the log: how many points, how deep, where, and what becomes of it.
  std::string describe() const;
};

/// A point to be moved before the run begins, so that bodies do not overlap.
struct Move
{
  int          body  = 0;
  Party        party = mesh_party;
  std::int64_t id    = 0;
  Vec3         by    = Vec3::Zero(); ///< m
};

/// Penalty contact with Coulomb friction between the pairs of bodies of a
/// scene. A node or particle touches the nearest point of the other body's
/// facets, or the surface that the other's particles span; the force is k times
/// the penetration along the line to that point, so the potential 1/2 k g^2 of
/// the distance function is conservative. k = stiffness m_eff/dt_ref^2 stays as
/// it was when the contact began. Two bodies of one kind: each one's points
/// against the other's surface, at half stiffness. Friction acts at the points themselves: the couple
/// (penetration or radius) x friction force is not taken up by rotation.
///
/// A contact keeps the side it came from: facets that face away from its last
/// normal are not its own, so a point pressed deep into a thin body is not
/// thrown out of the other side. Deeper than two facets it is given up and
/// counted in lost().
template <int dim>
class ContactSet
{
public:
  /// `reference_dt`: the step that sets the stiffness, s. `step_share`: share of
  /// the leapfrog's limit that the solvers use; contact may have the rest.
  /// With `ranks` the same is called on all of them, with the same faces.
  ContactSet(std::vector<ContactSpec> specs, std::vector<int> symmetry_axes, double reference_dt,
             double step_share, const Ranks &ranks = {});

  /// Measures sizes and settles overlaps at t = 0, once. InputError if bodies
  /// overlap by more than half a spacing, or at all where they must not.
  void start(const Faces<dim> &);
  /// Moves that leave the contacts with overlap = heal without one: by point, each
  /// along the way out, as often as it takes. Asked for before start(); InputError
  /// as there.
  std::vector<Move> healing(const Faces<dim> &, std::vector<InitialOverlap> &healed);
  /// Told by whoever has made the moves.
  void report_healed(std::vector<InitialOverlap> healed);
  /// Which particles it asks for (ParticlePort::attend). After start().
  std::vector<Attention> attention() const;
  /// Finds the contacts at x(t_n) and adds their forces to Faces::force.
  void gather(Faces<dim> &);
  /// Books the step just made, from the velocities before and after it.
  void close(const Faces<dim> &, const TimeStep &);

  /// Bound from the stiffness of all contacts of a point against its mass
  /// (Gershgorin rows, as of the last gather). Elements and particles use
  /// step_share of the leapfrog's limit, (w dt)^2/4 <= step_share^2, and contact
  /// has the rest, so the sum of both stays stable.
  StepLimit stable_dt() const { return state_.limit; }

  const ContactEnergy               &energy() const { return state_.energy; }
  const std::vector<InitialOverlap> &initial_overlaps() const { return overlaps_; }
  std::size_t                        active() const;
  /// Contacts given up because the point had gone too deep.
  std::int64_t lost() const { return state_.lost; }
  /// Fragment of each particle by id, to tell the particle solver (see
  /// ParticlePort::set_pieces); empty unless there are new ones since the last call.
  std::vector<std::int64_t> new_pieces();
  /// Force on body `a` by body `b` at the last gather, N; none on itself.
  Vec3 force(int a, int b) const;
  /// Sum of |force| kick over all contacts and steps, N s: the scale for momentum.
  double impulse() const { return state_.impulse; }

  /// Given by the symmetry planes to the bodies through contact, N s.
  Point<dim> plane_impulse() const { return state_.plane_impulse; }

  void snapshot();
  void restore();
  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  using Record = ContactRecord<dim>;
  using List   = ContactList<dim>;
  struct State
  {
    List                list;
    ContactEnergy       energy;
    double              impulse    = 0;
    double              last_drift = 0;
    Point<dim>          plane_impulse = Point<dim>::Zero();
    std::int64_t        lost       = 0;
    std::uint64_t       topology   = 0; ///< of the mesh at the last gather
    bool                died       = false; ///< the mesh has changed since the start
    StepLimit           limit;
  };

  /// Gives a contact found now its lasting properties and its force.
  void continue_contact(const Faces<dim> &, const ContactPair<dim> &, const Record *old, const List &, Record &);
  void begin_contact(const Faces<dim> &, const ContactPair<dim> &, const List &, Record &) const;
  /// Where elements have died, surfaces are ragged from then on, and contacts go on
  /// without a jump: what suddenly lies deeper has an offset. What lies less deep or
  /// has ended as they die gives its energy to `eroded`.
  void   bridge_jump(const Faces<dim> &, const ContactPair<dim> &, const Record *old, bool death, const List &,
                     Record &);
  /// Depth that the point may have gained in the last drift, m.
  double gained(const Faces<dim> &, const ContactPair<dim> &, const List &, const Record &) const;
  /// Force on a carrier of a contact, N.
  static Point<dim> force_on(const Carrier<dim> &, const Record &);
  /// What the springs of a contact that has opened still hold becomes heat.
  void end_contact(const Record &, bool death);
  /// Pair by pair, each by ascending key: found by all ranks together.
  List detect(const Faces<dim> &);
  /// Of what each rank has found, pair by pair, all of it.
  List joined(const Faces<dim> &, const List &own, std::int64_t lost);
  void add_overlaps(const Faces<dim> &, const ContactPair<dim> &, List &);
  void add_forces(Faces<dim> &) const;
  void limit_step(const Faces<dim> &);
  /// What of the records is deeper than rounding. InputError if it may not be.
  InitialOverlap overlap_of(const Faces<dim> &, const ContactPair<dim> &, std::span<const Record>) const;
  const Fragments<dim> *fragments_of(const ContactPair<dim> &) const;
  /// Bodies of particles that meet themselves.
  void start_fragments(const Faces<dim> &);
  void save_fragments(ArchiveWriter &, const std::string &prefix) const;

  Ranks                         ranks_;
  std::vector<ContactPair<dim>> pairs_;
  std::vector<int>              symmetry_axes_;
  double                        reference_dt_, step_share_;
  std::vector<InitialOverlap>   overlaps_;
  State                         state_, kept_;
  std::vector<Fragments<dim>>   fragments_;
  std::vector<std::vector<std::int64_t>> kept_fragments_;
  std::vector<std::int64_t>     told_; ///< version of each that the particle solver knows
};
} // namespace ogive::coupling
