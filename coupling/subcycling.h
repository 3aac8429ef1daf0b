// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"
#include "core/input/scene.h"
#include "core/io/archive.h"
#include "core/time/time_step.h"

#include <cstddef>
#include <functional>
#include <string>

namespace ogive::coupling
{
/// Parts a step between two solvers: the finer one takes as many steps in it as
/// its own bound asks for, up to those of the scene; the coarser one gives its
/// internal forces once, as one impulse at t_n, and both move and feel contact
/// and interfaces in every part. Forces so stay centred in time, each pair of
/// them acts over the same kick, and slaves move with their nodes throughout:
/// momentum is exact and no gap opens.
///
/// What is not exact is the work of the coarse forces: within a step the
/// velocity of what the coupling pushes jumps, and the strain follows its mean.
/// That error is in the ledger (interface_work); above the scene's limit the
/// run goes on without parts.
class Subcycling
{
public:
  Subcycling() = default; ///< no parts
  Subcycling(const input::Subcycling &, bool both_solvers);

  /// "auto" settled: whoever's bound (s) is at most half of the other's steps
  /// more often, as often as whole steps of it are in the other's, at most 8 times.
  /// `elements_wait`: whether elements may step less often than particles.
  static input::Subcycling settled(input::Subcycling, double elements_dt, double particles_dt, bool elements_wait);

  /// Whether steps may have parts in this scene.
  bool on() const { return most_ > 1; }
  const std::string &who() const { return who_; }   ///< "none", "particles", "elements": who steps more often
  std::size_t        most() const { return most_; } ///< parts of a step
  bool mesh_is_coarse() const { return on() && who_ == "particles"; }
  bool particles_are_coarse() const { return on() && who_ == "elements"; }

  /// Bound of a whole step.
  StepLimit limit(const StepLimit &fine, const StepLimit &coarse) const;
  /// How many parts of at most `fine_dt` (s) a step takes.
  std::size_t parts(const TimeStep &whole, double fine_dt) const;
  /// Part j of n. Its kick reaches from the middle of the last part that was
  /// taken to its own.
  TimeStep part(const TimeStep &whole, std::size_t n, std::size_t j) const;
  void     took(const TimeStep &part) { state_.last = part.drift; }

  /// Compares the error (J) with the kinetic energy at the start, or that of
  /// now (J) where nothing moved then. True once: when it ends the parts.
  void measure(double kinetic) { reference_ = kinetic; }
  bool review(double error, const std::function<double()> &now);

  void snapshot() { kept_ = state_; }
  void restore() { state_ = kept_; }
  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  struct State
  {
    double last  = 0;     ///< length of the last part, s
    bool   ended = false; ///< by its error
  };
  std::string who_ = "none";
  std::size_t most_  = 1;
  double      limit_ = 0, reference_ = 0;
  State       state_, kept_;
};
} // namespace ogive::coupling
