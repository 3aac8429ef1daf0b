// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive::sph
{
/// Directed neighbour rows of the owned particles, each filled up with `dummy`
/// to whole registers.
struct NeighbourRows
{
  std::vector<std::size_t>     row{0}; ///< row i is index[row[i] .. row[i+1])
  AlignedVector<std::uint32_t> index;
  std::size_t                  pairs = 0; ///< without the filling
  std::vector<std::size_t>     half;      ///< of halved rows: in row i, entries beyond i end at half[i]
  std::vector<std::size_t>     half_at;   ///< where its registers stand with none between; one more than rows

  void clear()
  {
    row.assign(1, 0);
    index.clear();
    pairs = 0;
    half.clear();
    half_at.clear();
  }
};

/// Turns the first `n` rows so that entries beyond their own number come first.
void halve(NeighbourRows &, std::size_t n);

/// Appends one row for each particle of [first, last): all others of
/// [first, last) and all of [first_ghost, last_ghost) closer than `radius`
/// (strictly); with `only_ghosts` the ghosts alone. Sorted by cells, so the order of a row depends on the positions
/// only. Positions must be finite.
template <int dim>
void append_rows(const std::array<std::span<const double>, dim> &x, std::size_t first, std::size_t last,
                 std::size_t first_ghost, std::size_t last_ghost, double radius, std::uint32_t dummy,
                 NeighbourRows &rows, bool only_ghosts = false);

/// Appends one row for each point of [first, last): all of `points`, itself
/// excepted, closer than `radius`.
template <int dim>
void append_rows_of(const std::array<std::span<const double>, dim> &x, std::size_t first, std::size_t last,
                    std::span<const std::uint32_t> points, double radius, std::uint32_t dummy, NeighbourRows &rows);

/// Order of [first, last) along a Morton curve over cells of edge `cell`, ties
/// by `id`.
template <int dim>
std::vector<std::uint32_t> morton_order(const std::array<std::span<const double>, dim> &x, std::size_t first,
                                        std::size_t last, double cell, std::span<const std::int64_t> id);
} // namespace ogive::sph
