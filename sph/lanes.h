// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

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
  for (int f = 0; f < n_fields; f += simd_width)
  {
    detail::Register r[simd_width];
    for (int k = 0; k < simd_width; ++k)
      std::memcpy(&r[k], base + j[k] * stride + f, sizeof(detail::Register));
    detail::transpose<simd_width / 2>(r);
    for (int k = 0; k < simd_width; ++k)
      out[f + k] = std::bit_cast<VDouble>(r[k]);
  }
}

/// out[f] = sum over the lanes of sums[f], f in [0, n_fields); both hold
/// padded(n_fields) entries.
template <int n_fields>
inline void store_sums(const VDouble *sums, double *out)
{
  for (int f = 0; f < n_fields; f += simd_width)
  {
    detail::Register r[simd_width];
    for (int k = 0; k < simd_width; ++k)
      r[k] = std::bit_cast<detail::Register>(sums[f + k]);
    detail::sum_halves<simd_width / 2>(r);
    std::memcpy(out + f, &r[0], sizeof(detail::Register));
  }
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
