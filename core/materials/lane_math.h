// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

/// Logarithm, exponential and power of whole registers: the standard library
/// takes the lanes one by one. Their own series, since the range is known.
namespace ogive::materials
{
inline constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;

inline double lane_log(double x)
{
  return std::log(x);
}
inline double lane_exp(double x)
{
  return std::exp(x);
}

/// sum c_k u^k over [first, first + n), halves side by side: a register waits for
/// log2 n products instead of n. power = {u, u^2, u^4, u^8}.
template <std::size_t first, std::size_t n, class T>
[[gnu::always_inline]] inline T sum_series(const double *c, const T (&power)[4])
{
  if constexpr (n == 1)
    return T(c[first]);
  else
  {
    constexpr std::size_t half = std::bit_floor(n - 1);
    return sum_series<first, half>(c, power) +
           power[std::bit_width(half) - 1] * sum_series<first + half, n - half>(c, power);
  }
}
template <std::size_t n, class T>
[[gnu::always_inline]] inline T sum_series(const double (&c)[n], const T &u)
{
  const T u2 = u * u, u4 = u2 * u2;
  const T power[4] = {u, u2, u4, T(u4 * u4)};
  return sum_series<0, n>(c, power);
}

/// ln x, finite normal x > 0, within 2e-16 (1 + |ln x|). x = 2^k m with m in
/// [sqrt(1/2), sqrt 2], ln m = 2 artanh s with s = (m - 1)/(m + 1).
inline VDouble lane_log(const VDouble &x)
{
  using Bits                   = stdx::rebind_simd_t<std::int64_t, VDouble>;
  constexpr std::int64_t half  = std::bit_cast<std::int64_t>(M_SQRT1_2);
  constexpr std::int64_t whole = std::int64_t(1) << 52;
  const Bits    bits = std::bit_cast<Bits>(x);
  const Bits    k    = (bits - half) >> 52;
  const VDouble m    = std::bit_cast<VDouble>(bits - k * whole);
  const VDouble s = (m - 1.) / (m + 1.), z = s * s;
  // The next term is under 2e-17 of the first.
  static constexpr double c[] = {1. / 3,  1. / 5,  1. / 7,  1. / 9,  1. / 11, 1. / 13,
                                 1. / 15, 1. / 17, 1. / 19, 1. / 21, 1. / 23};
  const VDouble sum = sum_series(c, z);
  const VDouble e = stdx::static_simd_cast<VDouble>(k);
  return e * ln2_high + (2. * s + (2. * s * z * sum + e * ln2_low));
}

constexpr double factorial(int n)
{
  return n < 2 ? 1. : n * factorial(n - 1);
}

/// exp x within 4e-16 of its value; x is held in [-700, 700].
/// x = k ln 2 + r with |r| <= ln 2/2.
inline VDouble lane_exp(VDouble x)
{
  using Bits = stdx::rebind_simd_t<std::int64_t, VDouble>;
  // Adding it rounds to an integer, which then stands in the last bits.
  constexpr double shift = 0x1.8p52;
  x                      = stdx::min(stdx::max(x, VDouble(-700.)), VDouble(700.));
  const VDouble shifted  = x * M_LOG2E + shift;
  const VDouble k        = shifted - shift;
  const VDouble r        = (x - k * ln2_high) - k * ln2_low;
  VDouble       sum      = 1. / factorial(13); // the next term is under 1e-17
  for (int n = 12; n >= 0; --n)
    sum = sum * r + 1. / factorial(n);
  const Bits scale = (std::bit_cast<Bits>(shifted) - std::bit_cast<std::int64_t>(shift) + 1023) << 52;
  return sum * std::bit_cast<VDouble>(scale);
}

/// x^n for x > 0.
template <class T>
T lane_power(const T &x, double n)
{
  return lane_exp(n * lane_log(x));
}
} // namespace ogive::materials
