// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/surfaces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ogive::coupling
{
/// Which particles of a body are of one piece: the particle solver acts on their
/// pairs, contact on all others, so nothing is counted twice.
///
/// With neighbours of t = 0 (SPH/configuration = reference) a body cannot break:
/// it is of one piece wherever particles were near at t = 0, and its folds touch.
///
/// With neighbours of now a body falls into fragments: the connected parts of the
/// graph of pairs within `reach` of which neither particle has failed (damage >=
/// 1). Fragments only ever split; two that meet again stay two. A failed particle
/// is nobody's: all of its pairs stay with the particle solver, which gives them
/// pressure and no pull.
template <int dim>
class Fragments
{
public:
  Fragments() = default;
  /// `reach`: below it particles are neighbours, m.
  Fragments(int body, double reach, bool of_start);

  int  body() const { return body_; }
  /// Takes the state of t = 0 down.
  void start(const Faces<dim> &);
  /// Looks for new fragments, every 16th call. True if there are any.
  bool update(const Faces<dim> &);

  /// Whether the pair belongs to the particle solver; by ids.
  bool joined(std::int64_t i, std::int64_t j) const;
  /// Changes whenever answers do.
  std::int64_t version() const { return state_[0]; }
  /// Fragment of each particle by id: the least id in it, nobody or unknown.
  std::span<const std::int64_t> label() const { return std::span(state_).subspan(header); }
  bool                          of_start() const { return of_start_; }

  static constexpr std::int64_t nobody = -1, unknown = -2;
  static constexpr std::size_t  header = 2;

  /// Version, calls, labels: all that a restart needs.
  const std::vector<std::int64_t> &state() const { return state_; }
  void                             set_state(std::vector<std::int64_t> state) { state_ = std::move(state); }

private:
  void take_in(const Faces<dim> &, const std::vector<std::uint32_t> &points,
               const std::vector<std::array<std::uint32_t, 2>> &pairs);
  std::vector<std::array<std::uint32_t, 2>> near_pairs(const Faces<dim> &,
                                                       const std::vector<std::uint32_t> &points) const;

  int                       body_     = -1;
  double                    reach_    = 0;
  bool                      of_start_ = false;
  std::vector<Point<dim>>   start_;                   ///< places of t = 0 by id, of_start
  std::vector<std::int64_t> state_ = {0, 0}; ///< version, calls, then the labels by id
};
} // namespace ogive::coupling
