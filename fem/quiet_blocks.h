// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ogive::fem
{
/// Blocks of elements that a step would leave as they are, bit for bit.
///
/// A block is quiet when all its nodes are at their first places with no velocity.
/// It falls asleep when a step of a quiet block changed no bit of its state and it
/// pushes no node: the same step would do the same again, however long it is. As
/// soon as one of its nodes has moved it is awake for good.
class QuietBlocks
{
public:
  void resize(std::size_t blocks, bool on)
  {
    state_.assign(on ? blocks : 0, watched);
    limit_.resize(on ? blocks : 0);
  }
  /// Whether the nodes of a block are worth a look.
  bool watches(std::size_t block) const { return !state_.empty() && state_[block] < tries; }
  bool sleeps(std::size_t block) const { return !state_.empty() && state_[block] == asleep; }
  void moved(std::size_t block)
  {
    if (!state_.empty())
      state_[block] = awake;
  }
  /// The state was changed by others than a step.
  void wake()
  {
    for (unsigned char &s : state_)
      s = watched;
  }

  /// Before the step of a quiet block: keeps the state. `visit(f)` calls f(first, last) for all of it.
  template <class Visit>
  void keep(const Visit &visit)
  {
    before_.clear();
    visit([this](const double *first, const double *last) { before_.insert(before_.end(), first, last); });
  }
  /// After it; limit: largest 2/dt (1/s) of the block and its element.
  template <class Visit>
  void compare(std::size_t block, const std::array<double, 2> &limit, const Visit &visit)
  {
    std::size_t at   = 0;
    bool        same = true;
    visit([&](const double *first, const double *last) {
      same = same && same_bits(first, last, &before_[at]);
      at += last - first;
    });
    state_[block] = same ? asleep : static_cast<unsigned char>(state_[block] + 1);
    limit_[block] = limit;
  }
  const std::array<double, 2> &limit(std::size_t block) const { return limit_[block]; }

private:
  // What a block is; from `watched` on, steps at rest that did change its state.
  static constexpr unsigned char asleep = 0, watched = 1, tries = 4, awake = 4;

  static bool same_bits(const double *first, const double *last, const double *other);

  std::vector<unsigned char>         state_;
  std::vector<std::array<double, 2>> limit_;
  AlignedVector<double>              before_;
};
} // namespace ogive::fem
