// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/fill.h"

#include "core/base/error.h"
#include "sph/shape_lattice.h"

#include <Eigen/Geometry>

#include <cmath>

namespace ogive::sph
{
namespace
{
/// v(x) of Body::velocity_field; `speed` is its velocity (twist: rad/s).
Vec3 field_velocity(const input::Body &body, const Vec3 &x, double bending_sound_speed)
{
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
  const double length = s.upper[1] - s.lower[1], y = x[1] - s.lower[1];
  if (body.velocity_field == "twist")
  {
    const Vec3 middle = .5 * (s.lower + s.upper);
    return speed * std::sin(M_PI * y / (2 * length)) * Vec3::UnitY().cross(x - middle);
  }
  if (body.velocity_field == "bend")
    return speed * y / length * Vec3::UnitX();
  if (body.velocity_field == "bending-mode")
  {
    // First mode of a clamped-free plate along x; speed is Vf, a share of the
    // shear-free sound speed sqrt(K/rho) (Gray, Monaghan and Swift, CMAME 190
    // (2001) 6641).
    const double kl = 1.875, l = s.upper[0] - s.lower[0], kx = kl * (x[0] - s.lower[0]) / l;
    const double m = std::sin(kl) + std::sinh(kl), n = std::cos(kl) + std::cosh(kl);
    const double q = 2 * (std::cos(kl) * std::sinh(kl) - std::sin(kl) * std::cosh(kl));
    return speed * bending_sound_speed *
           (m * (std::cos(kx) - std::cosh(kx)) - n * (std::sin(kx) - std::sinh(kx))) / q * Vec3::UnitY();
  }
  throw InputError({"", 0, "Bodies/" + body.name + "/velocity field"},
                   "unknown field \"" + body.velocity_field + "\"",
                   "radial-inverse, radial-inverse-square, twist, bend or bending-mode");
}
} // namespace

template <int dim>
BodyParticles<dim> fill(const input::Body &body, const input::Scene &scene, int body_index,
                        std::shared_ptr<const materials::Material> material)
{
  const ShapeLattice lattice = lattice_in(body.shape, body.spacing, dim, scene.symmetry, body.name);
  BodyParticles<dim> out;
  out.body     = body_index;
  out.spacing  = lattice.spacing;
  out.shape    = body.shape;
  out.mass.assign(lattice.points.size(), material->density() * lattice.volume / lattice.points.size());

  Vec3 centre = Vec3::Zero();
  for (const auto &x : lattice.points)
    centre += x / lattice.points.size();
  for (int a = 0; a < 3; ++a)
    if (lattice.halved[a])
      centre[a] = 0; // of the whole body
  const double c = std::sqrt(material->bulk_modulus() / material->density());
  for (const auto &x : lattice.points)
  {
    Vec3 v = body.velocity + body.spin.cross(x - centre);
    if (!body.velocity_field.empty())
      v += field_velocity(body, x, c);
    std::array<double, dim> xi, vi;
    for (int a = 0; a < dim; ++a)
    {
      xi[a] = x[a];
      vi[a] = v[a];
    }
    out.x.push_back(xi);
    out.v.push_back(vi);
  }
  out.material = std::move(material);
  return out;
}

template BodyParticles<1> fill<1>(const input::Body &, const input::Scene &, int,
                                  std::shared_ptr<const materials::Material>);
template BodyParticles<2> fill<2>(const input::Body &, const input::Scene &, int,
                                  std::shared_ptr<const materials::Material>);
template BodyParticles<3> fill<3>(const input::Body &, const input::Scene &, int,
                                  std::shared_ptr<const materials::Material>);
} // namespace ogive::sph
