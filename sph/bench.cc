// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/bench.h"

#include "core/base/error.h"
#include "sph/fill.h"

#include <cmath>
#include <ctime>

namespace ogive::sph
{
BenchResult bench(int edge, int steps, std::shared_ptr<const materials::Material> material)
{
  constexpr double spacing = 1e-3;
  input::Scene     scene;
  input::Body      body;
  body.name        = "block";
  body.spacing     = spacing;
  body.shape.upper = Vec3::Constant(edge * spacing);
  body.spin        = Vec3(100., 200., 300.);
  auto         particles = fill<3>(body, scene, 0, material);
  const double length    = edge * spacing;
  for (std::size_t i = 0; i < particles.x.size(); ++i)
    for (int a = 0; a < 3; ++a)
      particles.v[i][a] += 30 * std::cos(2 * M_PI * particles.x[i][(a + 1) % 3] / length) +
                           20 * std::sin(M_PI * particles.x[i][a] / length);

  Solver<3> solver({}, {std::move(particles)});
  double    time = 0, last = 0;
  const auto run = [&](int count) {
    for (int k = 0; k < count; ++k)
    {
      const double     dt     = solver.stable_dt().dt;
      const StepStatus status = solver.step({time, .5 * (last + dt), dt});
      if (!status.ok)
        throw RunError(std::string("bench: ") + status.culprit.why);
      time += dt;
      last = dt;
    }
  };
  run(5);
  const auto before   = solver.diagnostics();
  const auto start    = std::clock();
  run(steps);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  BenchResult r;
  r.particle_steps_per_s = solver.size() * static_cast<double>(steps) / seconds;
  r.neighbours           = solver.diagnostics().pairs / static_cast<double>(solver.size());
  const auto after       = solver.diagnostics();
  const auto built       = after.rebuilds - before.rebuilds;
  r.rebuild_share        = (after.rebuild_s - before.rebuild_s) / seconds;
  r.bytes_per_particle   = static_cast<double>(after.bytes) / static_cast<double>(solver.size());
  r.rebuild_interval     = built > 0 ? static_cast<double>(steps) / built : steps;
  return r;
}
} // namespace ogive::sph
