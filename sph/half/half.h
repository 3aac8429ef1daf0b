// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"
#include "sph/sweep.h"

#include <algorithm>
#include <cmath>

/// Sweeps that see each pair of two owned particles once, from the end with the
/// smaller number, and write both ends' sums, which are set to zero before. Images
/// have sums too, which nobody reads. What both ends get is antisymmetric or
/// symmetric to the bit, and is summed in the order of the list.
namespace ogive::sph
{
/// Entries of row i that a half sweep takes begin at row[i]; the last register
/// may hold entries beyond half[i], whose pair belongs to the other end.
struct HalfRow
{
  std::size_t begin, end;

  HalfRow(const Sweep &s, std::size_t i) : begin(s.row[i]), end(s.half[i]) {}

  /// a, and 0 in lanes that do not belong to the row.
  VDouble mine(std::size_t p, const VDouble &a) const
  {
    return select(lane_numbers() < VDouble(static_cast<double>(end - p)), a, VDouble(0.));
  }
};

/// Rows between a row and the one whose neighbours are asked for meanwhile.
inline constexpr std::size_t rows_ahead = 4;

/// Asks for `lines` lines of the neighbours' records of a row to come. Most are
/// in a cache; the others, beyond a bend of the curve, come from far.
template <int lines>
inline void ask_ahead(const Sweep &s, std::size_t i, const double *records, std::size_t stride)
{
  const std::size_t row = i + rows_ahead;
  if (row >= s.end)
    return;
  for (std::size_t p = s.row[row]; p < s.half[row]; ++p)
  {
    const char *at = reinterpret_cast<const char *>(records + s.index[p] * stride);
#pragma GCC unroll 4
    for (int l = 0; l < lines; ++l)
      __builtin_prefetch(at + 64 * l);
  }
}

/// Sound speed and shock share in one number, so that a record of the forces is
/// three lines long: c in whole units, half of the share in what is left. They come
/// back within half a unit, 8e-8 of 50 m/s, and within 3e-7 up to 10 km/s; pair
/// forces that dissipate know c no better, and both ends the same.
struct SoundAndShare
{
  static constexpr double unit = 1. / (1 << 17); ///< m/s

  static double pack(double c, double share) { return std::floor(c / unit + .5) + .5 * share; }

  template <class T>
  static void unpack(const T &packed, T &c, T &share)
  {
    using std::floor;
    const T whole = floor(packed);
    c             = unit * whole;
    share         = 2. * (packed - whole);
  }
};
} // namespace ogive::sph
