// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/bench_report.h"
#include "apps/commands.h"
#include "commit.h"
#include "core/input/reader.h"
#include "core/io/files.h"
#include "fem/bench.h"
#include "fem/work_count.h"
#include "sph/bench.h"
#include "sph/work_count.h"

#include <cstdio>

namespace ogive::apps
{
namespace
{
using Copper = std::shared_ptr<const materials::Material>;

std::string cube(int edge)
{
  return std::to_string(edge) + "^3";
}

void bench_particles(BenchReport &report, const BenchArguments &a, const Copper &copper)
{
  const sph::BenchResult  r    = sph::bench(a.sph_edge, a.steps, copper);
  const sph::ParticleWork work = sph::count_work(r.neighbours);
  report.kernels.push_back({"sph_step", "particle-steps",
                            cube(a.sph_edge) + ", cubic kernel, h = 1.3 dx, defaults of a scene, Johnson-Cook copper",
                            r.particle_steps_per_s, work.bytes, work.flops});
  if (r.rebuild_share > 0) // none within a few steps
    report.kernels.push_back({"sph_rebuild", "particles", "neighbour lists built anew, sorting included",
                              r.particle_steps_per_s / (r.rebuild_share * r.rebuild_interval)});
  report.figures.insert(report.figures.end(), {{"sph_neighbours", r.neighbours},
                                               {"sph_rebuild_interval", r.rebuild_interval},
                                               {"sph_rebuild_share", r.rebuild_share},
                                               {"sph_bytes_per_particle", r.bytes_per_particle}});
}

void bench_elements(BenchReport &report, const BenchArguments &a, const Copper &copper)
{
  const fem::BenchResult one  = fem::bench(a.fem_edge, a.steps, copper);
  const fem::ElementWork work = fem::count_work(a.fem_edge, copper->parameters());
  report.kernels.push_back({"fem_one_point_step", "element-steps",
                            cube(a.fem_edge) + " hexahedra, one point, hourglass stiffness, Johnson-Cook copper that flows",
                            one.element_steps_per_second, work.bytes, work.flops});
  const fem::BenchResult bar = fem::bench(a.fem_edge, a.steps, copper, "b-bar");
  report.kernels.push_back({"fem_b_bar_step", "element-steps",
                            cube(a.fem_edge) + " hexahedra, eight points, the same copper",
                            bar.element_steps_per_second});
  report.figures.insert(report.figures.end(), {{"fem_one_point_bytes_per_element", one.bytes_per_element},
                                               {"fem_b_bar_bytes_per_element", bar.bytes_per_element}});
}
} // namespace

void bench(const BenchArguments &a)
{
  const std::vector<BenchReport> kept   = read_kept(a.kept); // before the work, if it is not such a file
  const Copper                   copper = materials::make_material(input::read_material("copper-ofhc"));

  BenchReport report;
  report.commit    = OGIVE_COMMIT;
  report.processor = processor_name();
  bench_particles(report, a, copper);
  bench_elements(report, a, copper);
  report.limits = measure_limits(); // of the same machine, at the same moment

  std::fputs(describe(report, kept).c_str(), stdout);
  if (!a.json.empty())
    io::write_whole(a.json, to_json(report));
  if (a.keep)
    keep(a.kept, report);
}
} // namespace ogive::apps
