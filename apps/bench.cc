// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "core/input/reader.h"
#include "core/io/files.h"
#include "fem/bench.h"
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

  if (!a.json.empty())
  {
    const nlohmann::ordered_json figures = {{"sph_particle_steps_per_core_s", particles.particle_steps_per_s},
                                            {"sph_neighbours", particles.neighbours},
                                            {"sph_rebuild_interval", particles.rebuild_interval},
                                            {"fem_element_steps_per_core_s", elements.element_steps_per_second}};
    io::write_whole(a.json, figures.dump(2) + "\n");
  }
}
} // namespace ogive::apps
