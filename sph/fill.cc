// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/fill.h"

#include "core/input/velocity_field.h"
#include "sph/shape_lattice.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>

namespace ogive::sph
{
namespace
{
/// A number in [-1, 1) for each (point, axis), the same on every machine: the
/// finaliser of SplitMix64 (Steele, Lea and Flood 2014).
double scatter(std::size_t point, int axis)
{
  std::uint64_t z = 0x9e3779b97f4a7c15u * (3 * static_cast<std::uint64_t>(point) + static_cast<std::uint64_t>(axis) + 1);
  z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1;
}
} // namespace

template <int dim>
BodyParticles<dim> fill(const input::Body &body, const input::Scene &scene, int body_index,
                        std::shared_ptr<const materials::Material> material)
{
  ShapeLattice lattice = lattice_in(body.shape, body.spacing, dim, scene.symmetry, body.name);
  BodyParticles<dim> out;
  out.body     = body_index;
  out.spacing  = lattice.spacing;
  out.shape    = body.shape;
  out.mass.assign(lattice.points.size(), material->density() * lattice.volume / lattice.points.size());

  for (std::size_t i = 0; i < lattice.points.size(); ++i)
    for (int a = 0; a < dim; ++a)
      lattice.points[i][a] += body.jitter * lattice.spacing * scatter(i, a);

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
