// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/fill.h"

#include "core/input/velocity_field.h"
#include "sph/shape_lattice.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace ogive::sph
{
template <int dim>
BodyParticles<dim> fill(const input::Body &body, const input::Scene &scene, int body_index,
                        std::shared_ptr<const materials::Material> material)
{
  const bool         turned  = scene.dimension == input::Dimension::axisymmetric;
  ShapeLattice       lattice = lattice_in(body.shape, body.spacing, dim, turned, scene.symmetry, body.name);
  BodyParticles<dim> out;
  out.body     = body_index;
  out.spacing  = lattice.spacing;
  out.shape    = body.shape;
  for (int a = 0; a < dim; ++a)
    out.cell[a] = lattice.cell[a];
  double shares = 0; // of equal volumes, or of rings of equal section
  for (const auto &x : lattice.points)
    shares += turned ? x[0] : 1.;
  for (const auto &x : lattice.points)
    out.mass.push_back(material->density() * lattice.volume * (turned ? x[0] : 1.) / shares);

  std::mt19937 random; // its sequence is in the standard, unlike that of the distributions
  for (auto &x : lattice.points)
    for (int a = 0; a < dim && body.jitter > 0; ++a)
      x[a] += body.jitter * out.spacing * (random() * 0x1p-31 - 1);

  Vec3 centre = Vec3::Zero();
  for (const auto &x : lattice.points)
    centre += x / lattice.points.size();
  for (int a = 0; a < 3; ++a)
    if (lattice.halved[a])
      centre[a] = 0; // of the whole body
  const double c = std::sqrt(material->bulk_modulus() / material->density());
  for (const auto &x : lattice.points)
  {
    const Vec3 v = body.velocity + body.spin.cross(x - centre) + input::velocity_field(body, x, c);
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
