// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/input/scene.h"
#include "core/input/wave_field.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::input
{
/// v(x) of Body::velocity_field beyond translation and spin, m/s; zero where the
/// body has none. Its speed is in m/s (twist: rad/s; bending-mode: a share of
/// bulk_sound_speed). Throws InputError for an unknown name.
inline Vec3 velocity_field(const Body &body, const Vec3 &x, double bulk_sound_speed)
{
  if (body.velocity_field.empty())
    return Vec3::Zero();
  const auto  &s     = body.shape;
  const double speed = body.velocity_field_speed;
  const double inner = s.inner_radius > 0 ? s.inner_radius : s.radius;
  if (body.velocity_field == "radial-inverse")
  {
    const Vec3   e = s.axis.normalized(), d = x - s.base, radial = d - d.dot(e) * e;
    const double r = radial.norm();
    return speed * inner / (r * r) * radial;
  }
  if (body.velocity_field == "radial-inverse-square")
  {
    const Vec3   d = x - s.base;
    const double r = d.norm();
    return speed * inner * inner / (r * r * r) * d;
  }
  // What lies at y < 0 of a body that reaches beyond is in the clamp.
  const double root   = s.lower[1] < 0 && s.upper[1] > 0 ? 0 : s.lower[1];
  const double length = s.upper[1] - root, y = std::max(0., x[1] - root);
  if (body.velocity_field == "twist")
  {
    const Vec3 middle = .5 * (s.lower + s.upper);
    return speed * std::sin(std::numbers::pi * y / (2 * length)) * Vec3::UnitY().cross(x - middle);
  }
  if (body.velocity_field == "bend")
    return speed * y / length * Vec3::UnitX();
  if (body.velocity_field == "bending-mode")
  {
    // First mode of a clamped-free plate along x; speed is Vf, a share of the
    // shear-free sound speed sqrt(K/rho) (Gray, Monaghan and Swift, CMAME 190
    // (2001) 6641). What lies at x < 0 is in the clamp.
    const double root = std::max(s.lower[0], std::min(0., s.upper[0]));
    const double kl = 1.875, l = s.upper[0] - root, kx = kl * std::max(0., x[0] - root) / l;
    const double m = std::sin(kl) + std::sinh(kl), n = std::cos(kl) + std::cosh(kl);
    const double q = 2 * (std::cos(kl) * std::sinh(kl) - std::sin(kl) * std::cosh(kl));
    return speed * bulk_sound_speed *
           (m * (std::cos(kx) - std::cosh(kx)) - n * (std::sin(kx) - std::sinh(kx))) / q * Vec3::UnitY();
  }
  if (const WaveField *f = find_wave_field(body.velocity_field))
    return speed * f->shape(body, x);
  throw InputError({"", 0, "Bodies/" + body.name + "/velocity field"},
                   "unknown field \"" + body.velocity_field + "\"",
                   "radial-inverse, radial-inverse-square, twist, bend, bending-mode, closing, converging, "
                   "standing-wave, shear, saw-tooth, stretch or draw");
}
} // namespace ogive::input
