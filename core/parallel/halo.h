// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ogive
{
/// Who sends which entries of an array to whom, and where what comes in goes.
/// Entries are records of a fixed number of doubles, told by their index.
class Halo
{
public:
  Halo() = default;
  /// give[r]: indices that go to rank r; take[r]: where those from r go, in the
  /// order in which r names them. Called by all ranks.
  Halo(const Ranks &, std::vector<std::vector<std::uint32_t>> give, std::vector<std::vector<std::uint32_t>> take);

  /// Copies fields [first, last) of the given records into those taken;
  /// records[i * stride + first] is where record i begins.
  void copy(double *records, std::size_t stride, std::size_t first, std::size_t last) const;
  /// Adds to each taken record what the givers have there: for records that are
  /// both given and taken, as nodes that ranks share. Adds in the order of ranks,
  /// the own part in its place, so that all sharers of a record end with the same bits;
  /// every sharer must give the record to all its other sharers.
  void sum(double *records, std::size_t stride, std::size_t first, std::size_t last) const;
  /// The same for several arrays of one number an entry, in one message.
  void copy(std::span<double *const> arrays) const;
  void sum(std::span<double *const> arrays) const;

  std::size_t given() const { return given_; } ///< entries sent, of all neighbours
  std::size_t taken() const { return taken_; }
  std::size_t neighbours() const { return ranks_of_.size(); }

private:
  struct Side
  {
    std::vector<std::uint32_t> give, take;
  };
  /// Sends what `pack` puts together of each given entry and hands what came in to `unpack`.
  template <class Pack, class Unpack>
  void exchange(std::size_t width, Pack &&, Unpack &&) const;
  template <class At>
  void add_in_order(std::size_t width, At &&at) const;

  Ranks                       ranks_;
  std::vector<int>            ranks_of_; ///< neighbours, ascending
  std::vector<Side>           sides_;    ///< beside ranks_of_
  std::size_t                 given_ = 0, taken_ = 0;
  std::vector<std::uint32_t>  shared_; ///< entries that sum() changes
  mutable std::vector<double> out_, in_, own_; ///< room, kept from call to call
};
} // namespace ogive
