// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

/// What a law needs to be written once for one point (`double`) and for a
/// register of points (`VDouble`).
namespace ogive::materials
{
template <class T>
T load(const double *p)
{
  if constexpr (std::is_same_v<T, double>)
    return *p;
  else
    return T(p, stdx::element_aligned);
}

inline void store(double *p, double v)
{
  *p = v;
}
inline void store(double *p, const VDouble &v)
{
  v.copy_to(p, stdx::element_aligned);
}

inline double select(bool condition, double yes, double no)
{
  return condition ? yes : no;
}
inline VDouble select(const VMask &condition, const VDouble &yes, VDouble no)
{
  stdx::where(condition, no) = yes;
  return no;
}

inline bool all(bool condition)
{
  return condition;
}
inline bool all(const VMask &condition)
{
  return stdx::all_of(condition);
}

inline bool any(bool condition)
{
  return condition;
}
inline bool any(const VMask &condition)
{
  return stdx::any_of(condition);
}

/// Calls f.template operator()<T>(i) over [0, n): registers first, then what is left.
template <class F>
void for_lanes(std::size_t n, F &&f)
{
  std::size_t i = 0;
  for (; i + simd_width <= n; i += simd_width)
    f.template operator()<VDouble>(i);
  for (; i < n; ++i)
    f.template operator()<double>(i);
}
} // namespace ogive::materials
