// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "core/base/machine_limits.h"
#include "core/input/reader.h"
#include "core/io/files.h"
#include "fem/bench.h"
#include "fem/work_count.h"
#include "sph/bench.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace ogive::apps
{
void bench(const BenchArguments &a)
{
  const std::shared_ptr<const materials::Material> copper =
    materials::make_material(input::read_material("copper-ofhc"));

  const sph::BenchResult particles = sph::bench(a.sph_edge, a.steps, copper);
  std::printf("particles: %.3g particle-steps/s, %d^3 in 3-D, %.1f neighbours listed, lists rebuilt every %.0f steps\n"
              "           (cubic kernel, h = 1.3 dx, corrected form, pairwise correction, Johnson-Cook copper)\n",
              particles.particle_steps_per_s, a.sph_edge, particles.neighbours, particles.rebuild_interval);

  const fem::BenchResult elements = fem::bench(a.fem_edge, a.steps, copper);
  std::printf("elements:  %.3g element-steps/s, %d^3 one-point hexahedra, hourglass stiffness, Johnson-Cook copper\n",
              elements.element_steps_per_second, a.fem_edge);

  // One core of the same machine, at the same moment.
  const MachineLimits    limits = measure_limits();
  const fem::ElementWork work   = fem::count_work(a.fem_edge, copper->parameters());
  const double by_memory = limits.bytes_per_s / work.bytes, by_arithmetic = limits.flops / work.flops;
  std::printf("limits:    %.3g GB/s of memory (triad), %.3g Gflop/s (multiply-adds)\n"
              "           an element-step: %.0f bytes at least, %.0f operations: at most %.3g M/s and %.3g M/s\n"
              "           elements reach %.0f %% and %.0f %% of these\n",
              1e-9 * limits.bytes_per_s, 1e-9 * limits.flops, work.bytes, work.flops, 1e-6 * by_memory,
              1e-6 * by_arithmetic, 100 * elements.element_steps_per_second / by_memory,
              100 * elements.element_steps_per_second / by_arithmetic);

  if (!a.json.empty())
  {
    const nlohmann::ordered_json figures = {{"sph_particle_steps_per_core_s", particles.particle_steps_per_s},
                                            {"sph_neighbours", particles.neighbours},
                                            {"sph_rebuild_interval", particles.rebuild_interval},
                                            {"fem_element_steps_per_core_s", elements.element_steps_per_second},
                                            {"memory_bytes_per_s", limits.bytes_per_s},
                                            {"multiply_add_flops_per_s", limits.flops},
                                            {"fem_bytes_per_element_step", work.bytes},
                                            {"fem_flops_per_element_step", work.flops}};
    io::write_whole(a.json, figures.dump(2) + "\n");
  }
}
} // namespace ogive::apps
