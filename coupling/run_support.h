// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "core/time/clock.h"
#include "coupling/model.h"

#include <sys/resource.h>

#include <map>
#include <string>

/// What a run and the plan of one have in common.
namespace ogive::coupling
{
inline StepControl step_control(const input::Scene &scene)
{
  StepControl control{.smallest_step_ratio = scene.limits.smallest_step_ratio};
  for (const input::Body &body : scene.bodies)
    control.bodies.push_back(body.name);
  return control;
}

/// The most memory that this process ever held, bytes.
inline double peak_memory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

/// By mass scaling, by the name of the body.
template <int dim>
std::map<std::string, double> added_mass(const input::Scene &scene, const Model<dim> &model)
{
  std::map<std::string, double> all;
  for (const auto &added : model.added_masses())
    all[scene.bodies[static_cast<std::size_t>(added.body)].name] = added.fraction;
  return all;
}

/// Calls f.template operator()<dim>() for the dimension of the scene.
template <class F>
auto with_dimension(const input::Scene &scene, F &&f)
{
  switch (input::space_dimension(scene.dimension))
  {
    case 1:
      return f.template operator()<1>();
    case 2:
      return f.template operator()<2>();
    default:
      return f.template operator()<3>();
  }
}
} // namespace ogive::coupling
