// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive::sph
{
/// What a step of one particle of the benchmark (bench.h) asks of the machine.
struct ParticleWork
{
  double bytes = 0; ///< to and from memory, at least: every array once each time that it is gone through
  double flops = 0; ///< of the pair sweeps, an estimate of a root as one, by hand from their source
};

/// `neighbours`: directed pairs a particle; half of the particles are compressed
/// and ask for the sums of the sensor.
ParticleWork count_work(double neighbours);
} // namespace ogive::sph
