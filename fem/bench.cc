// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/bench.h"

#include "core/base/error.h"
#include "core/base/machine_limits.h"
#include "fem/mesh.h"
#include "fem/solver.h"

#include <ctime>

namespace ogive::fem
{
BenchResult bench(unsigned int n, std::size_t steps, std::shared_ptr<const materials::Material> material,
                  const std::string &element)
{
  input::Scene scene;
  input::Body  body;
  body.name        = "block";
  body.spacing     = 1e-3;
  body.shape.upper = Vec3::Constant(n * body.spacing);
  const std::size_t before = bytes_in_use();
  auto              mesh   = make_mesh<3>(body, scene, 0, std::move(material));
  mesh.element             = element;
  // Strain rates of some 1e4 /s: plastic within microseconds.
  const double rate = 1e4, middle = .5 * n * body.spacing;
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const double x = mesh.x[0][a] - middle, y = mesh.x[1][a] - middle, z = mesh.x[2][a];
    mesh.v[0][a] = -rate * y * z / (2 * middle) - .5 * rate * x;
    mesh.v[1][a] = rate * x * z / (2 * middle) - .5 * rate * y;
    mesh.v[2][a] = rate * (z - middle);
  }
  std::vector<BodyMesh<3>> meshes;
  meshes.push_back(std::move(mesh));
  Solver<3> solver(Parameters{}, std::move(meshes));

  BenchResult result;
  double      time = 0, last = 0;
  const auto  start = std::clock(); // processor time: other work on the machine does not count
  for (result.steps = 0; result.steps < steps; ++result.steps)
  {
    const double     dt     = solver.stable_dt().dt;
    const StepStatus status = solver.step({time, .5 * (last + dt), dt});
    if (!status.ok)
      throw RunError(std::string("bench: element ") + std::to_string(status.culprit.id) + ": " +
                     status.culprit.why);
    time += dt;
    last = dt;
  }
  result.seconds  = double(std::clock() - start) / CLOCKS_PER_SEC;
  result.elements = solver.size();
  result.bytes_per_element = static_cast<double>(bytes_in_use() - before) / static_cast<double>(solver.size());
  result.element_steps_per_second = double(solver.updates()) / result.seconds;
  return result;
}
} // namespace ogive::fem
