// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <experimental/simd>

namespace ogive
{
/// The one place that names the vector type: as many doubles as a register
/// of the target machine holds.
namespace stdx = std::experimental;

using VDouble                 = stdx::native_simd<double>;
using VMask                   = VDouble::mask_type;
inline constexpr int simd_width = static_cast<int>(VDouble::size());

/// Smallest multiple of the register width that is >= n.
inline constexpr std::size_t padded(std::size_t n)
{
  constexpr std::size_t w = simd_width;
  return (n + w - 1) / w * w;
}
} // namespace ogive
