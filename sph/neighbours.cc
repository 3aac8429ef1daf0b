// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/neighbours.h"

#include "core/base/simd.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace ogive::sph
{
namespace
{
/// A regular grid of cells over the points, points sorted by cell (x fastest,
/// so that neighbouring cells along x are one run).
template <int dim>
struct Cells
{
  std::array<double, dim>             lower{};
  std::array<std::int64_t, dim>       n{};
  double                              edge = 0;
  std::vector<std::uint32_t>          start, point;
  std::array<std::vector<double>, dim> x; ///< in the order of the cells

  std::int64_t coordinate(double at, int d) const
  {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((at - lower[d]) / edge), 0, n[d] - 1);
  }
};

template <int dim>
Cells<dim> sort_into_cells(const std::array<std::span<const double>, dim> &x,
                           std::span<const std::uint32_t> points, double radius)
{
  Cells<dim>              c;
  std::array<double, dim> upper;
  for (int d = 0; d < dim; ++d)
  {
    c.lower[d] = std::numeric_limits<double>::max();
    upper[d]   = std::numeric_limits<double>::lowest();
    for (const auto p : points)
    {
      c.lower[d] = std::min(c.lower[d], x[d][p]);
      upper[d]   = std::max(upper[d], x[d][p]);
    }
  }
  // Fragments flown far apart must not ask for a grid without bound.
  const double most = 32. * points.size() + 64;
  for (c.edge = radius;; c.edge *= 2)
  {
    double total = 1;
    for (int d = 0; d < dim; ++d)
      total *= std::floor((upper[d] - c.lower[d]) / c.edge) + 1;
    if (total <= most)
      break;
  }
  std::size_t total = 1;
  for (int d = 0; d < dim; ++d)
  {
    c.n[d] = static_cast<std::int64_t>((upper[d] - c.lower[d]) / c.edge) + 1;
    total *= c.n[d];
  }
  std::vector<std::uint32_t> cell(points.size());
  c.start.assign(total + 1, 0);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    std::int64_t key = 0;
    for (int d = dim - 1; d >= 0; --d)
      key = key * c.n[d] + c.coordinate(x[d][points[k]], d);
    cell[k] = static_cast<std::uint32_t>(key);
    ++c.start[key + 1];
  }
  for (std::size_t k = 0; k < total; ++k)
    c.start[k + 1] += c.start[k];
  std::vector<std::uint32_t> next(c.start.begin(), c.start.end() - 1);
  c.point.resize(points.size() + simd_width);
  // The filling lets whole registers be read past the last point.
  for (auto &a : c.x)
    a.assign(points.size() + simd_width, std::numeric_limits<double>::max() / 4);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const std::uint32_t to = next[cell[k]]++;
    c.point[to]            = points[k];
    for (int d = 0; d < dim; ++d)
      c.x[d][to] = x[d][points[k]];
  }
  return c;
}

/// What was found for one row; its room is kept from row to row.
struct Found
{
  std::vector<std::uint32_t> index;
  std::size_t                n = 0;

  /// Room for `more` entries, and for whole registers to be written.
  std::uint32_t *end_with_room(std::size_t more)
  {
    if (index.size() < n + more + simd_width)
      index.resize(2 * (n + more + simd_width));
    return index.data() + n;
  }
};

/// Appends those of point[0 .. count), count at most a register, whose squared
/// distance is less, but not `self`; returns how many.
inline std::size_t keep_near(const VDouble &r2, double radius2, const std::uint32_t *point, std::size_t count,
                             std::uint32_t self, std::uint32_t *to)
{
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (simd_width == 8)
  {
    const __m256i      all    = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(point));
    const unsigned int inside = count < simd_width ? (1u << count) - 1 : 0xffu;
    const auto         near   = static_cast<__mmask8>(
      inside & _mm512_cmp_pd_mask(std::bit_cast<__m512d>(r2), _mm512_set1_pd(radius2), _CMP_LT_OQ) &
      _mm256_cmpneq_epi32_mask(all, _mm256_set1_epi32(static_cast<int>(self))));
    _mm256_storeu_si256(reinterpret_cast<__m256i *>(to), _mm256_maskz_compress_epi32(near, all));
    return static_cast<std::size_t>(std::popcount(static_cast<unsigned int>(near)));
  }
#endif
  const VMask near = r2 < radius2;
  std::size_t kept = 0;
  for (std::size_t l = 0; l < count && stdx::any_of(near); ++l)
    if (near[l] && point[l] != self)
      to[kept++] = point[l];
  return kept;
}

/// Appends what lies within the radius among the sorted points [from, to).
template <int dim>
void scan_run(const Cells<dim> &c, const std::array<double, dim> &at, std::uint32_t from, std::uint32_t to,
              double radius2, std::uint32_t self, Found &found)
{
  std::uint32_t *end = found.end_with_room(to - from), *const begin = end;
  for (std::uint32_t k = from; k < to; k += simd_width)
  {
    VDouble r2 = 0.;
    for (int d = 0; d < dim; ++d)
    {
      const VDouble dx = VDouble(c.x[d].data() + k, stdx::element_aligned) - at[d];
      r2 += dx * dx;
    }
    end += keep_near(r2, radius2, c.point.data() + k, std::min<std::size_t>(simd_width, to - k), self, end);
  }
  found.n += static_cast<std::size_t>(end - begin);
}
} // namespace

template <int dim>
void append_rows_of(const std::array<std::span<const double>, dim> &x, std::size_t first, std::size_t last,
                    std::span<const std::uint32_t> points, double radius, std::uint32_t dummy, NeighbourRows &rows)
{
  if (points.empty())
  {
    rows.row.insert(rows.row.end(), last - first, rows.row.back());
    return;
  }
  const Cells<dim> c = sort_into_cells<dim>(x, points, radius);
  Found            found;
  for (std::size_t i = first; i < last; ++i)
  {
    found.n = 0;
    std::array<double, dim>                      at;
    std::array<std::array<std::int64_t, 2>, 3>   range{};
    for (int d = 0; d < dim; ++d)
    {
      at[d]                   = x[d][i];
      const std::int64_t home = c.coordinate(at[d], d);
      range[d]                = {std::max<std::int64_t>(home - 1, 0), std::min(home + 1, c.n[d] - 1)};
    }
    for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z)
      for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y)
      {
        std::int64_t base = 0;
        if constexpr (dim > 2)
          base = z * c.n[1];
        if constexpr (dim > 1)
          base = (base + y) * c.n[0];
        if (range[0][0] <= range[0][1])
          scan_run<dim>(c, at, c.start[base + range[0][0]], c.start[base + range[0][1] + 1], radius * radius,
                        static_cast<std::uint32_t>(i), found);
      }
    rows.index.insert(rows.index.end(), found.index.data(), found.index.data() + found.n);
    rows.pairs += found.n;
    while (rows.index.size() % simd_width != 0)
      rows.index.push_back(dummy);
    rows.row.push_back(rows.index.size());
  }
}

template <int dim>
void append_rows(const std::array<std::span<const double>, dim> &x, std::size_t first, std::size_t last,
                 std::size_t first_ghost, std::size_t last_ghost, double radius, std::uint32_t dummy,
                 NeighbourRows &rows, bool only_ghosts)
{
  std::vector<std::uint32_t> points;
  for (std::size_t i = first; i < last && !only_ghosts; ++i)
    points.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t i = first_ghost; i < last_ghost; ++i)
    points.push_back(static_cast<std::uint32_t>(i));
  append_rows_of<dim>(x, first, last, points, radius, dummy, rows);
}

void halve(NeighbourRows &rows, std::size_t n)
{
  std::vector<std::uint32_t> before;
  rows.half.resize(n);
  rows.half_at.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
  {
    before.clear();
    std::uint32_t *to = &rows.index[rows.row[i]];
    for (std::size_t k = rows.row[i]; k < rows.row[i + 1]; ++k)
      if (rows.index[k] > i)
        *to++ = rows.index[k];
      else
        before.push_back(rows.index[k]);
    // The filling counts as beyond, too: nothing comes of it.
    rows.half[i] = static_cast<std::size_t>(to - rows.index.data());
    std::copy(before.begin(), before.end(), to);
    rows.half_at[i + 1] = rows.half_at[i] + padded(rows.half[i] - rows.row[i]);
  }
}

template <int dim>
std::vector<std::uint32_t> morton_order(const std::array<std::span<const double>, dim> &x, std::size_t first,
                                        std::size_t last, double cell, std::span<const std::int64_t> id)
{
  std::array<double, dim> lower;
  lower.fill(std::numeric_limits<double>::max());
  for (int d = 0; d < dim; ++d)
    for (std::size_t i = first; i < last; ++i)
      lower[d] = std::min(lower[d], x[d][i]);
  struct Entry
  {
    std::uint64_t key;
    std::int64_t  id;
    std::uint32_t index;
    bool operator<(const Entry &o) const { return key != o.key ? key < o.key : id < o.id; }
  };
  constexpr int      bits = 63 / dim < 31 ? 63 / dim : 31;
  std::vector<Entry> entries;
  for (std::size_t i = first; i < last; ++i)
  {
    std::uint64_t key = 0;
    for (int d = 0; d < dim; ++d)
    {
      const double        steps = std::min((x[d][i] - lower[d]) / cell, static_cast<double>((1u << bits) - 1));
      const std::uint64_t q     = static_cast<std::uint64_t>(steps);
      for (int b = 0; b < bits; ++b)
        key |= ((q >> b) & 1) << (b * dim + d);
    }
    entries.push_back({key, id[i], static_cast<std::uint32_t>(i)});
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> order;
  for (const auto &e : entries)
    order.push_back(e.index);
  return order;
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void append_rows_of<d>(const std::array<std::span<const double>, d> &, std::size_t, std::size_t,  \
                                  std::span<const std::uint32_t>, double, std::uint32_t, NeighbourRows &);   \
  template void append_rows<d>(const std::array<std::span<const double>, d> &, std::size_t, std::size_t,     \
                               std::size_t, std::size_t, double, std::uint32_t, NeighbourRows &, bool);      \
  template std::vector<std::uint32_t> morton_order<d>(const std::array<std::span<const double>, d> &,        \
                                                      std::size_t, std::size_t, double,                      \
                                                      std::span<const std::int64_t>);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
