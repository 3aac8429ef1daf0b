// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/base/culprit.h"
#include "core/base/sample.h"
#include "core/input/scene.h"
#include "core/io/archive.h"
#include "core/parallel/rank_share.h"
#include "core/parallel/ranks.h"
#include "core/time/time_step.h"
#include "coupling/conversion.h"
#include "coupling/coupler.h"
#include "coupling/ledger.h"
#include "coupling/subcycling.h"
#include "fem/mesh_quality.h"
#include "fem/solver.h"
#include "sph/solver.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace ogive::coupling
{
/// What a measurement adds to a scene, and no scene file can.
struct Setup
{
  std::vector<sph::Mirror>                mirrors;  ///< of all bodies of particles
  std::function<Vec3(int body, const Vec3 &x)> velocity; ///< at the start, m/s, in place of the bodies'
};

/// The bodies of a scene in their solvers, and the layer between: everything
/// that moves, nothing that watches.
template <int dim>
class Model
{
public:
  /// `ranks` share the work; all functions are called by all of them alike, and
  /// give the same answer on each.
  explicit Model(const input::Scene &, const Setup & = {}, const Ranks &ranks = {});

  StepLimit stable_dt() const;

  /// One step of all: forces of the coupling at t_n, the mesh, the slaves, the
  /// particles, the books.
  /// Where the scene lets one solver take several steps in one of the other,
  /// all of that in parts of the step (coupling/subcycling.h).
  StepStatus step(const TimeStep &);
  /// After a step: empty, or what to tell when parts of steps end by their error.
  std::string review();
  /// Parts of the last step.
  std::size_t parts() const { return parts_; }

  /// Between two steps: elements of bodies with method auto that must turn into
  /// particles do. Snapshots taken before are void if there are events.
  std::vector<ConversionEvent> convert(std::int64_t step, double time);
  bool                         converts() const { return conversion_ != nullptr; } ///< any such body

  void snapshot();
  void restore();
  void save(ArchiveWriter &) const;
  void load(const ArchiveReader &);

  LedgerRow ledger() const;
  /// Elements and particles of the body in one.
  Sample    sample(int body) const;
  Sample    particle_sample(int body) const; ///< its particles alone, none: empty
  Sample    mesh_sample(int body) const;

  /// Force of each rigid wall in the last step, N into the material.
  std::vector<double> wall_forces() const;
  /// Sum over the listed contacts of the force between the two bodies, N.
  double contact_force() const;

  const std::vector<InitialOverlap> &initial_overlaps() const { return coupler_->initial_overlaps(); }
  std::vector<fem::TieReport>        ties() const; ///< of bodies of elements
  std::vector<typename fem::Solver<dim>::AddedMass> added_masses() const
  {
    return fem_ ? fem_->added_masses() : std::vector<typename fem::Solver<dim>::AddedMass>{};
  }
  std::int64_t                       lost_contacts() const { return coupler_->lost_contacts(); }

  /// Of the meshes as they were made, one a body of elements; makes them again.
  std::vector<fem::MeshQuality>   mesh_qualities(const input::Scene &) const;
  /// What the readers of mesh files have to say, with the name of the body.
  const std::vector<std::string> &mesh_notes() const { return mesh_notes_; }
  /// Critical step of all meshes by power iteration; infinite without one.
  StepLimit                       critical_dt() { return fem_ ? fem_->critical_dt() : StepLimit(); }

  std::size_t   particles() const { return sph_ ? sph_->size() : 0; }
  std::size_t   elements() const { return fem_ ? fem_->size() - fem_->converted_elements() : 0; }
  std::uint64_t particle_updates() const { return sum(sph_ ? sph_->updates() : 0); } ///< of all ranks
  std::uint64_t element_updates() const { return sum(fem_ ? fem_->updates() : 0); }
  std::uint64_t element_skips() const { return sum(fem_ ? fem_->skipped() : 0); } ///< of them, left out
  /// Processor time that all ranks spent in the particle solver, and in that of the mesh.
  double        sph_seconds() const { return ranks_.sum(sph_seconds_); }
  double        fem_seconds() const { return ranks_.sum(fem_seconds_); }
  const Ranks  &ranks() const { return ranks_; }
  /// What this rank has of all; what it tells others is not in it.
  RankShare     share() const;

private:
  /// `moves`: of points that would overlap.
  void build(const input::Scene &, const Setup &, const std::vector<Move> &moves);
  // model_step.cc
  void       begin_parts(const input::Scene &);
  StepLimit  fine_limit() const;
  StepLimit  coarse_limit() const;
  StepStatus take_part(const TimeStep &whole, std::size_t j);
  double     parts_error(Party) const; ///< of steps in parts, J
  std::uint64_t sum(std::uint64_t own) const
  {
    return static_cast<std::uint64_t>(ranks_.sum(static_cast<std::int64_t>(own)));
  }

  Ranks                              ranks_;
  std::size_t                        n_walls_;
  std::vector<std::pair<int, int>>   contact_bodies_; ///< of each contact of the scene
  std::unique_ptr<fem::Solver<dim>>  fem_;
  std::unique_ptr<sph::Solver<dim>>  sph_;
  std::unique_ptr<Conversion<dim>>   conversion_; ///< where a body has method auto
  std::unique_ptr<Coupler<dim>>      coupler_;
  Subcycling                         subcycling_;
  std::size_t                        parts_ = 1;
  std::vector<std::string>           mesh_notes_;
  double                             sph_seconds_ = 0, fem_seconds_ = 0;
};

extern template class Model<1>;
extern template class Model<2>;
extern template class Model<3>;
} // namespace ogive::coupling
