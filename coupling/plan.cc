// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/run.h"
#include "coupling/run_report.h"
#include "coupling/run_support.h"

#include <chrono>
#include <cmath>

namespace ogive::coupling
{
namespace
{
template <int dim>
Plan make_plan(const input::Scene &scene)
{
  Model<dim> model(scene);
  Plan       plan;
  const RunReport report(scene); // refuses what it cannot observe
  plan.particles = model.particles();
  plan.elements  = model.elements();
  plan.limit     = model.stable_dt();
  plan.steps     = std::ceil(scene.end_time / plan.limit.dt);
  plan.mass      = model.ledger().mass;
  plan.ties      = model.ties();
  plan.overlaps  = model.initial_overlaps();
  const auto local   = model.local_plan();
  plan.local_classes = local.elements;
  plan.local_part    = local.part;
  plan.local_updates = local.updates;
  plan.who           = model.subcycling().who();
  plan.parts         = model.subcycling().most();
  plan.elements_dt   = model.elements_dt();
  plan.particles_dt  = model.particles_dt();
  plan.added_mass_fraction = added_mass<dim>(scene, model);
  plan.meshes    = model.mesh_qualities(scene);
  // an iteration costs about two steps, and it takes hundreds
  if (constexpr std::size_t affordable = 100000; plan.elements > 0 && plan.elements <= affordable)
    plan.critical = model.critical_dt();

  Clock          clock(scene.end_time, step_control(scene));
  constexpr int  trials = 5;
  const auto     start  = std::chrono::steady_clock::now();
  for (int k = 0; k < trials && !clock.done(); ++k)
  {
    if (!model.step(clock.plan(model.stable_dt())).ok)
      break;
    clock.advance();
  }
  plan.seconds_per_step = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / trials;
  plan.memory_bytes     = peak_memory();
  return plan;
}
} // namespace

Plan plan_scene(const input::Scene &scene)
{
  return with_dimension(scene, [&]<int dim>() { return make_plan<dim>(scene); });
}
} // namespace ogive::coupling
