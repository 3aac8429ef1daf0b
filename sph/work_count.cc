// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/work_count.h"

#include "sph/sweep.h"

namespace ogive::sph
{
namespace
{
// Operations a pair in space, cubic kernel. A multiply-add counts two.
constexpr int distance = 3 + 6;                 // x_ij, r^2
constexpr int root     = 1 + 9 + 1;             // 1/r by an estimate and one step, r
constexpr int slope    = 10, value = 9;         // of the kernel
constexpr int quotient = 7;                     // by an estimate and one step

constexpr int gradient = distance + 3 + root + slope + value + 3 /* weights */ + 3 * (1 + 1 + 4 + 6) + 3;
constexpr int sensor   = distance + root + slope + value + 8 + 3 * 4;
constexpr int force    = distance + 6 + root + slope + 2 /* weights */ + 2 * 6 /* stress */ + 9 + 6 * (2 + 4) /* limiter */ +
                      9 /* hourglass control */ + 3 * quotient + 6 + 25 /* viscosity */ + 8 /* damping */ + 3 * 4 + 2 * 7;
constexpr int correction = distance + root + value + 3 + 3 * 3;
constexpr int energy     = distance + 9 + root + slope + 2 * (18 + 6) + value + 3 + 9 + 3 + 3 + 6;
} // namespace

ParticleWork count_work(double neighbours)
{
  using L            = Layout<3>;
  using S            = SensorLayout<3>;
  const double half  = .5 * neighbours;
  ParticleWork w;
  w.flops = neighbours * (gradient + correction + .5 * sensor) + half * (force + energy);

  constexpr double number = sizeof(double), entry = sizeof(std::uint32_t);
  // Lists: directed three times (sensor by half of the rows), halves twice.
  const double lists = entry * (neighbours * 2.5 + half * 2);
  // Pair numbers: two written and read a pair.
  const double pairs = number * half * 2 * 2;
  // Records packed once and read in each sweep, sums written and read.
  const double records = number * (2. * L::n_motion + 2. * L::force_stride + L::n_motion + (L::n_force - L::n_motion) + 2. * S::stride +
                                   3. * L::correction_stride + 2. * L::energy_stride);
  const double sums = number * (2. * L::gradient_stride + 2. * S::sums_stride + 3. * L::forces_stride + 2. * L::powers_stride);
  // State: x, v, x at the last list, mass, density twice, heats, external force, the material's own.
  const double state = number * 2. * (3 + 3 + 3 + 1 + 2 + 2 + 3 + 9 + 6 + 6);
  w.bytes            = lists + pairs + records + sums + state;
  return w;
}
} // namespace ogive::sph
