// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/ledger.h"
#include "coupling/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

/// Scenes of steel boxes and a driver that steps them.
namespace ogive::coupling::scenes
{
/// Steel that stays elastic: c_L = sqrt((K + 4G/3)/rho) = 5786 m/s.
inline input::Scene steel_scene(input::Dimension dimension)
{
  input::Scene          scene;
  materials::Parameters steel;
  steel.name             = "steel";
  steel.density          = 7850;
  steel.shear_modulus    = 77e9;
  steel.eos.law          = "linear";
  steel.eos.bulk_modulus = 160.1e9;
  steel.strength.law     = "elastic";
  scene.materials.push_back(steel);
  scene.dimension = dimension;
  scene.end_time  = 1;
  return scene;
}

inline void add_box(input::Scene &scene, const std::string &name, input::Method method, const Vec3 &lower,
             const Vec3 &upper, double spacing, const Vec3 &velocity)
{
  input::Body body;
  body.name        = name;
  body.material    = "steel";
  body.method      = method;
  body.shape.lower = lower;
  body.shape.upper = upper;
  body.spacing     = spacing;
  body.velocity    = velocity;
  scene.bodies.push_back(body);
}

template <int dim>
struct Driver
{
  Model<dim> model;
  double     time = 0, last = 0;

  explicit Driver(const input::Scene &scene, const Ranks &ranks = {}) : model(scene, {}, ranks) {}
  void step() { step(model.stable_dt().dt); }
  void step(double dt)
  {
    ASSERT_TRUE(model.step({time, .5 * (last + dt), dt}).ok);
    time += dt;
    last = dt;
  }
};

struct Slide
{
  double ratio = 0; ///< tangential over normal impulse on the first body
  double drift = 0, momentum = 0;
};

/// Worst drift of the books, and change of momentum over the momenta there were
/// (of body by body, in magnitude).
template <int dim>
Slide run(const input::Scene &scene, double time)
{
  Driver<dim> run(scene);
  Ledger      ledger;
  auto        row = run.model.ledger();
  ledger.enter(row);
  const Vec3 before = row.momentum;
  double     touch = 0, scale = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const double m : run.model.sample(static_cast<int>(b)).mass)
      scale += m * scene.bodies[b].velocity.norm();
  while (run.time < time)
  {
    run.step();
    touch = std::max(touch, run.model.contact_force());
    row   = run.model.ledger();
    ledger.enter(row);
  }
  EXPECT_GT(touch, 0);
  const auto sample  = run.model.sample(0);
  Vec3       impulse = Vec3::Zero();
  for (std::size_t i = 0; i < sample.mass.size(); ++i)
    for (int a = 0; a < dim; ++a)
      impulse[a] += sample.mass[i] * sample.v[a][i];
  return {-impulse[0] / impulse[dim - 1], ledger.worst_drift(), (row.momentum - before).norm() / scale};
}
} // namespace ogive::coupling::scenes
