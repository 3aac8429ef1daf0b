// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"

#include <cstddef>

namespace ogive::fem
{
/// What one step of one element costs.
struct ElementWork
{
  double flops = 0; ///< additions, multiplications, divisions and roots in double, one each
  double bytes = 0; ///< to and from memory if the caches keep nothing from step to step
};

/// Of a one-point hexahedron that flows, in a block of n^3. Operations: the
/// templates of the kernel (shape, strain, hourglass rates and rotation, Gram
/// matrix, corner forces, rotation of the stress, Mie-Grueneisen, Johnson-Cook)
/// run once with a number that counts; the lines between them are counted by
/// hand. Bytes: every array of the state read once and written once, what is
/// constant read once.
ElementWork count_work(std::size_t n, const materials::Parameters &);
} // namespace ogive::fem
