// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/initial_velocity.h"

#include "core/input/velocity_field.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_axisymmetric.h"

#include <cmath>
#include <type_traits>

namespace ogive::fem
{
namespace
{
template <class Element>
Vec3 centre_of_mass(const BodyMesh<Element::dim> &mesh)
{
  Vec3   moment = Vec3::Zero();
  double volume = 0;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
  {
    double x[Element::corners][Element::dim];
    Vec3   centre = Vec3::Zero();
    for (int a = 0; a < Element::corners; ++a)
      for (int i = 0; i < Element::dim; ++i)
      {
        x[a][i] = mesh.x[i][mesh.cells[c * Element::corners + a]];
        centre[i] += x[a][i] / Element::corners;
      }
    Geometry<Element, double> g;
    Element::gradient(x, g);
    moment += g.volume * centre;
    volume += g.volume;
  }
  return moment / volume;
}
} // namespace

template <int dim>
void set_initial_velocity(const input::Body &body, const input::Scene &scene, BodyMesh<dim> &mesh)
{
  using Element = std::conditional_t<dim == 1, Line2, std::conditional_t<dim == 2, Quad4, Hex8>>;
  Vec3 centre   = mesh.axisymmetric ? centre_of_mass<std::conditional_t<dim == 2, Quad4Axisymmetric, Element>>(mesh)
                                    : centre_of_mass<Element>(mesh);
  for (const auto &plane : scene.symmetry)
    centre[plane.axis] = 0;
  const double c = std::sqrt(mesh.material->bulk_modulus() / mesh.material->density());
  for (auto &component : mesh.v)
    component.resize(mesh.n_nodes());
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    Vec3 x = Vec3::Zero();
    for (int i = 0; i < dim; ++i)
      x[i] = mesh.x[i][a];
    const Vec3 v = body.velocity + body.spin.cross(x - centre) + input::velocity_field(body, x, c);
    for (int i = 0; i < dim; ++i)
      mesh.v[i][a] = v[i];
  }
}

template void set_initial_velocity<1>(const input::Body &, const input::Scene &, BodyMesh<1> &);
template void set_initial_velocity<2>(const input::Body &, const input::Scene &, BodyMesh<2> &);
template void set_initial_velocity<3>(const input::Body &, const input::Scene &, BodyMesh<3> &);
} // namespace ogive::fem
