// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <cstdint>

namespace ogive
{
/// What one rank has of a run, and what it tells the others.
struct RankShare
{
  std::int64_t particles = 0, halo_particles = 0; ///< own ones, and those of others that their pairs need
  std::int64_t elements = 0, nodes = 0;           ///< own ones, and nodes of these
  std::int64_t shared_nodes = 0;                  ///< nodes that other ranks have too
  double       particle_work = 0, element_work = 0; ///< of a step, counted as the partition counts it
  double       messages = 0, bytes = 0, together = 0; ///< a step: messages sent, bytes in them, operations of all
  double       solver_s = 0; ///< processor time in both solvers
  double       waited_s = 0; ///< wall time of steps spent in messages, waiting included
  double       memory   = 0; ///< most that the process ever held, bytes
};

/// Sums up what this rank tells others between begin() and end().
class TrafficMeter
{
public:
  explicit TrafficMeter(const Ranks &ranks)
    : ranks_(ranks)
  {}
  void begin()
  {
    if (!ranks_.alone())
      before_ = ranks_.traffic();
  }
  void end()
  {
    ++spans_;
    if (ranks_.alone())
      return;
    const Traffic &now = ranks_.traffic();
    sum_.messages += now.messages - before_.messages;
    sum_.bytes += now.bytes - before_.bytes;
    sum_.together += now.together - before_.together;
    sum_.waited_s += now.waited_s - before_.waited_s;
  }
  /// The mean of all spans into messages, bytes, together; the sum into waited_s.
  void tell(RankShare &share) const
  {
    const double n = spans_ > 0 ? static_cast<double>(spans_) : 1.;
    share.messages = static_cast<double>(sum_.messages) / n;
    share.bytes    = static_cast<double>(sum_.bytes) / n;
    share.together = static_cast<double>(sum_.together) / n;
    share.waited_s = sum_.waited_s;
  }

private:
  Ranks         ranks_;
  Traffic       before_, sum_;
  std::uint64_t spans_ = 0;
};

/// Most over mean of what `of` gives of each; 1 where all is 0.
template <class List, class F>
double imbalance(const List &shares, F &&of)
{
  double most = 0, sum = 0;
  for (const RankShare &share : shares)
  {
    most = most < of(share) ? of(share) : most;
    sum += of(share);
  }
  return sum > 0 ? most * static_cast<double>(shares.size()) / sum : 1.;
}
} // namespace ogive
