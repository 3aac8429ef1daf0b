// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/base/culprit.h"
#include "core/base/sample.h"
#include "core/base/surface.h"
#include "core/input/scene.h"
#include "core/io/archive.h"
#include "core/materials/material.h"
#include "core/parallel/ranks.h"
#include "core/time/time_step.h"
#include "sph/mirror.h"
#include "sph/newcomers.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ogive::sph
{
/// Particles of one body as laid out at t = 0 (sph/fill.h makes them).
template <int dim>
struct BodyParticles
{
  int                                     body = 0;      ///< index into Scene::bodies
  std::shared_ptr<const materials::Material> material;
  double                                  spacing = 0;   ///< m
  std::array<double, dim>                 cell{};        ///< distances of the layers across each axis, m; 0: spacing
  std::vector<std::array<double, dim>>    x, v;          ///< m, m/s
  std::vector<double>                     mass;          ///< kg
  bool                                    grows = false; ///< more may come (Solver::add); it may begin with none
  /// For the faces of round bodies; boxes take their faces from the particles.
  input::Shape shape;
};

/// What the solver needs from the scene.
struct Parameters
{
  input::SphOptions                  options;
  bool                               axisymmetric = false; ///< dim 2: x = r, y = z, particles are rings
  std::vector<input::SymmetryPlane>  symmetry;
  std::vector<input::RigidWall>      walls;
  std::vector<input::Boundary>       boundaries; ///< fixed and velocity, by Boundary::body through `boundary_bodies`
  std::vector<int>                   boundary_bodies;
  std::vector<Mirror>                mirrors{}; ///< for measurements; not with walls or a reference configuration
  input::ParallelOptions             parallel{}; ///< when particles are shared among the ranks anew
  Ranks                              ranks{};    ///< that share the particles
};

/// What a run should watch.
struct Diagnostics
{
  std::size_t   fallbacks = 0; ///< particles whose corrected gradient fell back to the plain one, last step
  std::size_t   pairs     = 0; ///< directed pairs in the lists, skin included
  std::uint64_t rebuilds  = 0; ///< of the neighbour lists since construction
  std::size_t   own       = 0; ///< particles of this rank
  std::size_t   halo      = 0; ///< particles of other ranks that its pairs need
  double        imbalance = 1; ///< most over mean counted work of a rank (sph/migrate.cc), when last looked at
  std::uint64_t migrated  = 0; ///< particles that went from this rank to another
  double        rebuild_s = 0; ///< processor time of the rebuilds within steps so far, s
  std::size_t   bytes     = 0; ///< held for the particles, by vector sizes
  /// Rows of sweeps that may be left out where nothing changes (SphOptions::quiescent_skip),
  /// and those of them that were, so far.
  std::uint64_t rows = 0, rows_skipped = 0;
};

/// Smoothed particle hydrodynamics of solids, total set of bodies of a scene.
/// Bodies do not feel each other here: contact belongs to the coupling layer.
///
/// On several ranks each owns the particles of a part of space. All functions
/// are called by all ranks alike and answer alike, but for those that show a
/// rank its own particles: surface(), damage(), index_of_id(), seam_forces(),
/// seam_normals(), and updates(), which counts them. Lists that come in (bodies,
/// slaves, pieces, shares, newcomers, riders) are the same on all ranks.
template <int dim>
class Solver
{
public:
  Solver(const Parameters &, std::vector<BodyParticles<dim>>);
  ~Solver();

  StepLimit     stable_dt() const;
  Surface<dim>  surface();
  StepStatus    step(const TimeStep &);
  /// The same step in parts, for a coupling layer that pushes and looks more
  /// often: begin, go_on for each further part, finish. Surface::force and the
  /// velocities of slaves are asked for before begin and each go_on, and act
  /// over that part; forces between particles, walls and planes act once, over
  /// the kick of the whole. Announce it with allow_parts() at the initial state.
  void          allow_parts();
  StepStatus    begin(const TimeStep &whole, const TimeStep &part);
  StepStatus    go_on(const TimeStep &part);
  StepStatus    finish(const TimeStep &whole);
  /// Energy that steps in parts gave the particles and took from no pair, J (sph/substeps.cc).
  double        parts_error() const;
  Balance       balance() const;
  void          snapshot();
  void          restore();
  void          save(ArchiveWriter &, const std::string &prefix) const;
  void          load(const ArchiveReader &, const std::string &prefix);
  Sample        sample(int body) const;
  std::size_t   size() const;
  std::uint64_t updates() const;

  /// Tied slaves. The coupler names the particles (by Surface::id) once; before
  /// each step it gives their velocities at t_{n+1/2}, in the order of the ids.
  /// A slave's inertia counts in the mesh: it is left out of balance() (mass,
  /// momentum, kinetic energy; its internal energy stays).
  void set_slaves(std::span<const std::int64_t> ids);
  void drive_slaves(const std::array<std::span<const double>, dim> &velocity);
  /// Force on each slave at t_n (internal plus Surface::force), same order.
  void slave_forces(const std::array<std::span<double>, dim> &force) const;
  /// Share of slaves (by Surface::id) in the energy of the material they stand
  /// for, and so in its forces, 0 < share <= 1: stress, hourglass control and
  /// linear viscosity of a pair act by the mean of its two shares. The rest
  /// belongs to the elements that carry them. Once, before the first step.
  void weigh(std::span<const std::int64_t> ids, std::span<const double> shares);
  /// Present index of each particle id (particles are reordered as they move);
  /// of those of other ranks `elsewhere`.
  static constexpr std::uint32_t elsewhere = 0xffffffffu;
  std::span<const std::uint32_t> index_of_id() const;

  /// Damage of each particle by its present index.
  std::span<const double> damage() const;
  /// Parts a body: particles of two pieces, by id and neither negative, are no
  /// pair from the next step on. Nothing else tells pieces from one body.
  void set_pieces(std::span<const std::int64_t> piece_of_id);

  /// Lets particles come in, between two steps; snapshots taken before are void.
  /// The body may have had none. Returns their ids, which follow the largest so
  /// far. InputError where the options do not allow it.
  std::vector<std::int64_t> add(const Newcomers<dim> &);

  /// Riders complete the neighbourhood of a body's particles within a mesh that
  /// goes on behind a seam: they stand where a mesh carries them, with its
  /// stress, and enter gradients and forces of the particles, but have no inertia,
  /// no energy and no material step of their own, and feel no force. Replaces the
  /// riders of the body; like add() between two steps. Rider k is entry k.
  void set_riders(const Newcomers<dim> &);
  /// What a step must know of the riders of a body, to be written before it:
  /// velocities at t_{n+1/2} and the state of the material at t_{n+1}.
  struct Riders
  {
    std::size_t                        n = 0;
    std::array<std::span<double>, dim> velocity; ///< m/s
    materials::Points                 *state = nullptr;
  };
  Riders riders(int body);
  /// Force of the riders on each particle of the body at t_n, N, by its present
  /// index; what is not of the body is left alone.
  void seam_forces(int body, const std::array<std::span<double>, dim> &force) const;
  /// Coefficient of the hourglass control of riders and of particles with riders
  /// in reach, where larger than that of the options; before set_riders().
  void set_seam_hourglass(int body, double coefficient);
  /// Distances of the layers of a body's lattice at the start, m.
  std::array<double, dim> cell(int body) const;
  /// How far two particles of the body may stand apart and be listed as a pair, m.
  double reach(int body) const;
  /// What seam_forces() would be under a unit stress everywhere and without
  /// viscosity, m^2 (m in plane strain, 1 in one dimension): the share of the
  /// seam's area that each particle sees, along the normal into the riders.
  void seam_normals(int body, const std::array<std::span<double>, dim> &area);
  /// Energy that the riders have given the particles of a body so far, J: work on their
  /// motion and what stress and viscosity of the pairs with riders heat them.
  double seam_work(int body) const;

  /// Normal force sum that rigid wall `w` gave in the last step, N (into the material).
  double wall_force(std::size_t w) const;

  Diagnostics diagnostics() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};
} // namespace ogive::sph
