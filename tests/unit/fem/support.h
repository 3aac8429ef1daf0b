// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"
#include "fem/mesh.h"
#include "fem/solver.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <memory>

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
  return b.kinetic + b.internal() + b.wall_loss + b.friction_heat + b.absorbed - b.external_work;
}
} // namespace ogive::fem::test
