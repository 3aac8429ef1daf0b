// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

/// Neighbours as SIMD lanes. What a pair needs of its neighbour lies in one
/// packed record; a register's worth of records is loaded by whole lines and
/// transposed, which costs a fraction of as many gathers.
namespace ogive::sph
{
namespace detail
{
typedef double Register __attribute__((vector_size(sizeof(double) * simd_width)));
using Lanes = std::make_index_sequence<simd_width>;

// Lanes without bit `s` from a, the others from the matching half of b.
template <int s, std::size_t... l>
inline Register lower(Register a, Register b, std::index_sequence<l...>)
{
  return __builtin_shufflevector(a, b, ((l & s) ? simd_width + int(l) - s : int(l))...);
}
template <int s, std::size_t... l>
inline Register upper(Register a, Register b, std::index_sequence<l...>)
{
  return __builtin_shufflevector(a, b, ((l & s) ? simd_width + int(l) : int(l) + s)...);
}

template <int s>
inline void transpose(Register *r)
{
  if constexpr (s > 0)
  {
#pragma GCC unroll 32
    for (int k = 0; k < simd_width; ++k)
      if ((k & s) == 0)
      {
        const Register a = r[k], b = r[k + s];
        r[k]     = lower<s>(a, b, Lanes{});
        r[k + s] = upper<s>(a, b, Lanes{});
      }
    transpose<s / 2>(r);
  }
}

template <int s>
inline void sum_halves(Register *r)
{
  if constexpr (s > 0)
  {
#pragma GCC unroll 32
    for (int k = 0; k < s; ++k)
      r[k] = lower<s>(r[k], r[k + s], Lanes{}) + upper<s>(r[k], r[k + s], Lanes{});
    sum_halves<s / 2>(r);
  }
}
} // namespace detail

/// Fields [0, n_fields) of the records j[0 .. simd_width) of `base`, one record
/// a lane: out[f][lane] = base[j[lane] * stride + f]. `out` holds
/// padded(n_fields) entries and `stride` is a multiple of the register width.
template <int n_fields>
inline void load_records(const double *base, std::size_t stride, const std::uint32_t *j, VDouble *out)
{
#pragma GCC unroll 32
  for (int f = 0; f < n_fields; f += simd_width)
  {
    detail::Register r[simd_width];
#pragma GCC unroll 32
    for (int k = 0; k < simd_width; ++k)
      std::memcpy(&r[k], base + j[k] * stride + f, sizeof(detail::Register));
    detail::transpose<simd_width / 2>(r);
#pragma GCC unroll 32
    for (int k = 0; k < simd_width; ++k)
      out[f + k] = std::bit_cast<VDouble>(r[k]);
  }
}

/// out[lane] = base[j[lane]].
inline VDouble load_numbers(const double *base, const std::uint32_t *j)
{
  return VDouble([&](auto k) { return base[j[k]]; });
}

/// out[f] = sum over the lanes of sums[f], f in [0, n_fields); both hold
/// padded(n_fields) entries.
template <int n_fields>
inline void store_sums(const VDouble *sums, double *out)
{
#pragma GCC unroll 32
  for (int f = 0; f < n_fields; f += simd_width)
  {
    detail::Register r[simd_width];
#pragma GCC unroll 32
    for (int k = 0; k < simd_width; ++k)
      r[k] = std::bit_cast<detail::Register>(sums[f + k]);
    detail::sum_halves<simd_width / 2>(r);
    std::memcpy(out + f, &r[0], sizeof(detail::Register));
  }
}

namespace detail
{
/// Adds one line a lane to the records j[0 .. simd_width): all are read before any is
/// written, or the machine, warned by the filling of rows, would wait for each
/// store before the next load. Lanes that name one record: the last one's sum stays.
template <class Line, class LineOf>
inline void add_lines(double *to, std::size_t stride, const std::uint32_t *j, LineOf &&line_of)
{
  double *at[simd_width];
  Line    line[simd_width];
#pragma GCC unroll 32
  for (int k = 0; k < simd_width; ++k)
  {
    at[k] = to + j[k] * stride;
    std::memcpy(&line[k], at[k], sizeof(Line));
  }
#pragma GCC unroll 32
  for (int k = 0; k < simd_width; ++k)
    line[k] += line_of(k);
#pragma GCC unroll 32
  for (int k = 0; k < simd_width; ++k)
    std::memcpy(at[k], &line[k], sizeof(Line));
}

/// Four fields of eight lanes: half a line each.
inline void add_half_lines(const Register *r, double *to, std::size_t stride, const std::uint32_t *j)
{
  if constexpr (simd_width == 8)
  {
    typedef double Half __attribute__((vector_size(4 * sizeof(double))));
    const Register a[4] = {lower<1>(r[0], r[1], Lanes{}), upper<1>(r[0], r[1], Lanes{}),
                           lower<1>(r[2], r[3], Lanes{}), upper<1>(r[2], r[3], Lanes{})};
    const Register b[4] = {lower<2>(a[0], a[2], Lanes{}), lower<2>(a[1], a[3], Lanes{}),
                           upper<2>(a[0], a[2], Lanes{}), upper<2>(a[1], a[3], Lanes{})};
    add_lines<Half>(to, stride, j, [&](int k) -> Half {
      return k < 4 ? __builtin_shufflevector(b[k], b[k], 0, 1, 2, 3) : __builtin_shufflevector(b[k - 4], b[k - 4], 4, 5, 6, 7);
    });
  }
}
} // namespace detail

/// to[j[lane] * stride + f] += sums[f][lane], f in [0, n_fields), for lanes that name
/// different records; of those that do not, one is added. `sums` holds
/// padded(n_fields) entries, zeros from n_fields on.
template <int n_fields>
inline void add_records(const VDouble *sums, double *to, std::size_t stride, const std::uint32_t *j)
{
#pragma GCC unroll 32
  for (int f = 0; f < n_fields; f += simd_width)
  {
    detail::Register r[simd_width];
#pragma GCC unroll 32
    for (int k = 0; k < simd_width; ++k)
      r[k] = std::bit_cast<detail::Register>(sums[f + k]);
    if (simd_width == 8 && n_fields - f <= 4)
      detail::add_half_lines(r, to + f, stride, j);
    else
    {
      detail::transpose<simd_width / 2>(r);
      detail::add_lines<detail::Register>(to + f, stride, j, [&](int k) { return r[k]; });
    }
  }
}

/// out[f] += sum over the lanes of sums[f].
template <int n_fields>
inline void add_sums(const VDouble *sums, double *out)
{
  double total[padded(n_fields)];
  store_sums<n_fields>(sums, total);
#pragma GCC unroll 32
  for (int f = 0; f < static_cast<int>(padded(n_fields)); ++f)
    out[f] += total[f];
}

/// 0, 1, 2, ... by lane.
inline VDouble lane_numbers()
{
  return VDouble([](auto k) { return static_cast<double>(k); });
}

/// 1/a and 1/sqrt(a) within two units in the last place, for normal positive a;
/// without the divider where the machine has estimates of 14 bits.
inline VDouble reciprocal(const VDouble &a)
{
#ifdef __AVX512F__
  if constexpr (simd_width == 8)
  {
    const VDouble y = std::bit_cast<VDouble>(_mm512_rcp14_pd(std::bit_cast<__m512d>(a)));
    const VDouble e = 1. - a * y, p = e + e * e;
    return y + y * (e + e * p);
  }
#endif
  return 1. / a;
}
inline VDouble reciprocal_root(const VDouble &a)
{
#ifdef __AVX512F__
  if constexpr (simd_width == 8)
  {
    const VDouble y = std::bit_cast<VDouble>(_mm512_rsqrt14_pd(std::bit_cast<__m512d>(a)));
    const VDouble e = 1. - a * y * y;
    return y + y * e * (.5 + e * (.375 + .3125 * e));
  }
#endif
  return 1. / stdx::sqrt(a);
}
inline double reciprocal_root(double a)
{
  return 1. / std::sqrt(a);
}

/// a where the condition holds, b elsewhere; for numbers and registers alike.
inline double select(bool condition, double a, double b)
{
  return condition ? a : b;
}
inline VDouble select(const VMask &condition, const VDouble &a, VDouble b)
{
  stdx::where(condition, b) = a;
  return b;
}
inline double positive_part(double a)
{
  return a > 0 ? a : 0.;
}
inline VDouble positive_part(const VDouble &a)
{
  return stdx::max(a, VDouble(0.));
}
} // namespace ogive::sph
