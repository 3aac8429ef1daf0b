// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/reflection.h"
#include "tests/verification/coupling/support.h"

#include <cmath>
#include <random>

/// Blocks of steel, the part x < 0 (axisymmetric: y < 0) particles, the other
/// elements, and strips that measure such seams.
namespace ogive::coupling::seams
{
constexpr double dx = 1e-3; ///< spacing of the particles, m

struct Blocks
{
  input::Dimension dimension = input::Dimension::plane_strain;
  std::string      method    = "pair-flux"; ///< "": one body, by `alone`
  input::Method    alone     = input::Method::sph;
  double           ratio     = 1; ///< edge of the elements over dx
  Vec3             half      = Vec3(12 * dx, 8 * dx, 0); ///< of one part, m
  std::string      element   = "one-point";
};

inline input::Scene scene_of(const Blocks &b)
{
  auto scene        = scenes::steel_scene(b.dimension);
  scene.fem.element = b.element;
  const int  across = b.dimension == input::Dimension::axisymmetric ? 1 : 0;
  Vec3       down = Vec3::Zero(), up = b.half;
  down[across]    = -b.half[across];
  up[across]      = 0;
  if (b.method.empty())
  {
    scenes::add_box(scene, "all", b.alone, down, b.half, b.alone == input::Method::sph ? dx : b.ratio * dx, Vec3::Zero());
    return scene;
  }
  if (b.method == "blended") // two supports, two elements
    up[across] = dx * std::ceil(std::max(4 * scene.sph.h_over_dx, 2 * b.ratio));
  scenes::add_box(scene, "zone", input::Method::sph, down, up, dx, Vec3::Zero());
  scenes::add_box(scene, "rest", input::Method::fem, Vec3::Zero(), b.half, b.ratio * dx, Vec3::Zero());
  scene.interfaces.push_back({"seam", b.method, "zone", "rest"});
  return scene;
}

/// Steps a scene that begins with v(x).
template <int dim>
struct Start
{
  Model<dim> model;
  double     time = 0, last = 0;

  Start(const input::Scene &scene, std::function<Vec3(const Vec3 &)> v, std::vector<sph::Mirror> mirrors = {})
    : model(scene, {std::move(mirrors), [v = std::move(v)](int, const Vec3 &x) { return v(x); }})
  {}
  bool step()
  {
    const double dt = model.stable_dt().dt;
    if (!model.step({time, .5 * (last + dt), dt}).ok)
      return false;
    time += dt;
    last = dt;
    return true;
  }
};

/// The strip of reflection.h.
inline SeamSpec strip(const std::string &method, double ratio, bool line = false)
{
  SeamSpec seam;
  seam.material    = scenes::steel_scene(input::Dimension::plane_strain).materials.front();
  seam.join.name   = "seam";
  seam.join.method = method;
  seam.side        = {SeamSide{"zone", input::Method::sph, dx, ""}, SeamSide{"rest", input::Method::fem, ratio * dx, ""}};
  seam.line        = line;
  return seam;
}

/// Random velocities of up to 1e-4 of the sound speed along each axis.
template <int dim>
std::function<Vec3(const Vec3 &)> noise()
{
  return [random = std::mt19937(7)](const Vec3 &) mutable {
    Vec3 v = Vec3::Zero();
    for (int a = 0; a < dim; ++a)
      v[a] = .5786 * (random() * 0x1p-31 - 1);
    return v;
  };
}
} // namespace ogive::coupling::seams
