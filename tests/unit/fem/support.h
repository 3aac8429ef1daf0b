// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"
#include "fem/mesh.h"
#include "fem/raise_degree.h"
#include "fem/solver.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

/// Scenes by hand for the tests of the elements.
namespace ogive::fem::test
{
/// Elastic solid with the given law of strength; E, nu, rho in SI.
inline materials::Parameters elastic(double young, double nu, double density)
{
  materials::Parameters p;
  p.name             = "solid";
  p.density          = density;
  p.young_modulus    = young;
  p.poisson_ratio    = nu;
  p.shear_modulus    = young / (2 * (1 + nu));
  p.eos.law          = "linear";
  p.eos.bulk_modulus = young / (3 * (1 - 2 * nu));
  p.strength.law     = "elastic";
  return p;
}

inline std::shared_ptr<const materials::Material> make(const materials::Parameters &p)
{
  return materials::make_material(p);
}

/// Copper of validation.md, table A1.
inline materials::Parameters copper() { return elastic(117e9, .35, 8930); }
inline materials::Parameters copper_linear_hardening()
{
  auto p                       = copper();
  p.strength.law               = "linear-hardening";
  p.strength.yield_stress      = 400e6;
  p.strength.hardening_modulus = 100e6;
  return p;
}

inline input::Body box(const Vec3 &lower, const Vec3 &upper, double spacing, const Vec3 &velocity = Vec3::Zero())
{
  input::Body body;
  body.name        = "block";
  body.shape.lower = lower;
  body.shape.upper = upper;
  body.spacing     = spacing;
  body.velocity    = velocity;
  return body;
}

/// Steps at the solver's own bound (or a fixed dt) until `end`.
template <int dim>
struct Driver
{
  Solver<dim> &solver;
  double       time = 0, last = 0, fixed_dt = 0;
  std::size_t  steps = 0;

  StepStatus once(double end = 1e300)
  {
    double dt = fixed_dt > 0 ? fixed_dt : solver.stable_dt().dt;
    if (time + dt > end)
      dt = end - time;
    const StepStatus status = solver.step({time, .5 * (last + dt), dt});
    time += dt;
    last = dt;
    ++steps;
    return status;
  }
  StepStatus until(double end, const std::function<void()> &each = {})
  {
    while (time < end * (1 - 1e-12))
    {
      const StepStatus status = once(end);
      if (!status.ok)
        return status;
      if (each)
        each();
    }
    return {};
  }
};

/// What must stay constant: kinetic + internal + losses - work of the outside.
inline double closed(const Balance &b)
{
  return b.kinetic + b.internal() + b.wall_loss + b.friction_heat - b.external_work;
}
/// Distorted block in violent elastic motion, off the axes.
template <int dim>
BodyMesh<dim> wild_block(std::shared_ptr<const materials::Material> material, bool axisymmetric = false,
                         double speed = 40, double distortion = .2, const std::string &element = "one-point",
                         int degree = 1)
{
  const double h = .8e-3;
  input::Scene scene;
  scene.dimension = axisymmetric ? input::Dimension::axisymmetric : input::Dimension::three_d;
  const double               offset = axisymmetric ? 0 : 1e-3;
  auto mesh = make_mesh<dim>(box({offset, 2e-3, -1e-3}, {offset + 4 * h, 2e-3 + 5 * h, -1e-3 + 3 * h}, h), scene, 0,
                             material);
  std::mt19937                           random(42);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto shake = [&](bool places, bool velocities) {
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
      for (int i = 0; i < dim; ++i)
      {
        // A ring has no rigid motion along its radius.
        if (velocities)
          mesh.v[i][a] = 3. * (i + !axisymmetric) + speed * u(random);
        if (places && !(axisymmetric && mesh.x[0][a] == 0 && i == 0))
          mesh.x[i][a] += distortion * h * u(random);
      }
  };
  mesh.element = element;
  shake(true, degree == 1);
  if (degree > 1)
  {
    raise_degree(mesh, degree);
    for (auto &v : mesh.v)
      v.assign(mesh.n_nodes(), 0.);
    shake(false, true);
  }
  return mesh;
}

template <int dim>
std::unique_ptr<Solver<dim>> solver_of(BodyMesh<dim> mesh, Parameters p = {})
{
  p.axisymmetric = mesh.axisymmetric;
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(std::move(mesh));
  return std::make_unique<Solver<dim>>(p, std::move(meshes));
}
} // namespace ogive::fem::test
