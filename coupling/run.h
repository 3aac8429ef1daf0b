// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/log.h"
#include "core/input/scene.h"
#include "core/io/hdf5_archive.h"
#include "core/io/run_directory.h"
#include "core/io/summary.h"
#include "core/parallel/ranks.h"
#include "coupling/contact.h"
#include "fem/mesh_quality.h"
#include "fem/solver.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// Runs a scene to its end and writes what design.md promises into the
/// directory: history.csv, results.xdmf + .h5, checkpoints, summary.json.
/// `resolved` is the text of the scene with every default filled in; it goes
/// into each checkpoint. `version` and `commit` go into the summary. Throws
/// RunError naming entity, place, time and cause when the run cannot go on.
struct RunLabels
{
  std::string resolved, version, commit;
};

/// `open` makes the directory; it is called once the model stands, so that a
/// scene that cannot be built touches nothing.
///
/// On several ranks all call it alike, and `open` is called on all. The first one
/// writes all files but checkpoints, which all write together; each rank gets the
/// whole summary and meets every error.
io::Summary run_scene(const input::Scene &, const std::function<io::RunDirectory()> &open, const RunLabels &, Log &,
                      const Ranks & = {});

/// Goes on from a checkpoint of the directory; rows and states written after it
/// are dropped, and what follows is equal to the bit to an unbroken run on the same
/// number of ranks; any other number gives the same to rounding.
io::Summary restart_scene(const input::Scene &, const io::RunDirectory &, const io::Hdf5ArchiveReader &checkpoint,
                          const RunLabels &, Log &, const Ranks & = {});

/// What `ogive check` prints: counts, the first step and who sets it, and the
/// processor time of one step, measured on a few steps that are thrown away.
struct Plan
{
  std::size_t particles = 0, elements = 0;
  StepLimit   limit;
  double      steps            = 0; ///< to the end time at the first step
  double      seconds_per_step = 0;
  double      memory_bytes     = 0; ///< of the process, with the model built
  double      mass             = 0; ///< kg, of the modelled part
  std::vector<fem::TieReport> ties;  ///< of bodies of elements
  std::vector<InitialOverlap> overlaps; ///< of bodies in contact, as the run begins
  std::map<std::string, double> added_mass_fraction; ///< by mass scaling, of bodies that got any

  /// FEM/local steps: elements of each class of steps, the bound of the shortest
  /// one (s), updates of elements over those with one step for all.
  std::vector<std::size_t> local_classes;
  double                   local_part = 0, local_updates = 1;
  /// Subcycling: who steps more often, how often at most; bounds of both, s.
  std::string who = "none";
  std::size_t parts = 1;
  double      elements_dt = 0, particles_dt = 0;

  std::vector<fem::MeshQuality> meshes;   ///< one a body of elements
  StepLimit                     critical; ///< of all meshes, by power iteration; infinite if not looked for
};
Plan plan_scene(const input::Scene &);
} // namespace ogive::coupling
