// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <memory>

namespace ogive::materials
{
class Material;
}

namespace ogive::sph
{
/// What one core does on a 3-D block: whole steps, neighbour rebuilds included, by processor time.
struct BenchResult
{
  double particle_steps_per_s = 0;
  double neighbours           = 0; ///< directed pairs a particle in the lists, skin and surface included
  double rebuild_interval     = 0; ///< steps between rebuilds of the lists
  double rebuild_share        = 0; ///< of the processor time
  double bytes_per_particle   = 0; ///< held, lists included
};

/// A free cube of edge^3 particles, cubic kernel, h = 1.3 spacings, pairwise
/// correction, that spins and vibrates plastically; `steps` steps after a short
/// warm-up.
BenchResult bench(int edge, int steps, std::shared_ptr<const materials::Material>);
} // namespace ogive::sph
