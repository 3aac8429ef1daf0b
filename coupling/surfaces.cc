// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/surfaces.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
namespace
{
template <int dim>
Faces<dim> seen(MeshPort<dim> *mesh, ParticlePort<dim> *particles, bool again)
{
  Faces<dim> faces;
  if (mesh)
    faces.of[mesh_party] = mesh->surface();
  if (particles)
  {
    again ? particles->meet_again() : particles->meet(faces.of[mesh_party]);
    faces.of[particle_party] = particles->surface();
    faces.particle_index     = particles->index_of_id();
    faces.damage             = particles->damage();
    faces.widest             = particles->widest();
    faces.particle_lists     = particles->lists_met();
  }
  return faces;
}
} // namespace

template <int dim>
Faces<dim> Faces<dim>::look(MeshPort<dim> *mesh, ParticlePort<dim> *particles)
{
  return seen<dim>(mesh, particles, false);
}

template <int dim>
Faces<dim> Faces<dim>::look_again(MeshPort<dim> *mesh, ParticlePort<dim> *particles)
{
  return seen<dim>(mesh, particles, true);
}

template <int dim>
void Faces<dim>::clear_forces()
{
  for (auto &surface : of)
    for (auto &component : surface.force)
      std::fill(component.begin(), component.end(), 0.);
}

template <int dim>
std::vector<std::uint32_t> contact_points(const Surface<dim> &surface, int body)
{
  std::vector<std::uint32_t> points;
  for (const std::uint32_t i : surface.contact_points)
    if (surface.body[i] == body)
      points.push_back(i);
  std::sort(points.begin(), points.end(), [&](auto i, auto j) { return surface.id[i] < surface.id[j]; });
  return points;
}

template <int dim>
std::vector<std::uint32_t> body_points(const Surface<dim> &surface, int body)
{
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < surface.n; ++i)
    if (surface.body[i] == body)
      points.push_back(i);
  std::sort(points.begin(), points.end(), [&](auto i, auto j) { return surface.id[i] < surface.id[j]; });
  return points;
}

namespace
{
template <int dim>
bool lies_on_plane(const Surface<dim> &surface, const typename Surface<dim>::Facet &facet, int axis,
                   double tolerance)
{
  return std::all_of(facet.node.begin(), facet.node.end(),
                     [&](auto i) { return std::abs(surface.x[axis][i]) <= tolerance; });
}
} // namespace

template <int dim>
std::vector<typename Surface<dim>::Facet> true_facets(const Surface<dim> &surface, int body,
                                                      const std::vector<int> &symmetry_axes, bool seams)
{
  double extent = 0;
  for (const auto &facet : surface.facets)
    for (const std::uint32_t i : facet.node)
      for (int a = 0; a < dim; ++a)
        extent = std::max(extent, std::abs(surface.x[a][i]));

  std::vector<typename Surface<dim>::Facet> facets;
  for (const auto &facet : surface.facets)
    if (facet.body == body && facet.bared == seams &&
        std::none_of(symmetry_axes.begin(), symmetry_axes.end(), [&](int axis) {
          return axis < dim && lies_on_plane(surface, facet, axis, 1e-9 * extent);
        }))
      facets.push_back(facet);
  return facets;
}

template <int dim>
Point<dim> facet_area(const Faces<dim> &faces, int party, const typename Surface<dim>::Facet &facet)
{
  if constexpr (dim == 1)
    return Point<1>(facet.outward);
  else if constexpr (dim == 2)
  {
    const Point<2> edge = faces.position(party, facet.node[1]) - faces.position(party, facet.node[0]);
    return {edge[1], -edge[0]};
  }
  else
  {
    const auto x = [&](int k) { return faces.position(party, facet.node[k]); };
    return .5 * (x(2) - x(0)).cross(x(3) - x(1));
  }
}

template <int dim>
double facet_size(const Surface<dim> &surface, const typename Surface<dim>::Facet &facet)
{
  double longest = 0;
  for (std::size_t k = 0; k < facet.node.size(); ++k)
  {
    const std::uint32_t i = facet.node[k], j = facet.node[(k + 1) % facet.node.size()];
    double              square = 0;
    for (int a = 0; a < dim; ++a)
      square += (surface.x[a][i] - surface.x[a][j]) * (surface.x[a][i] - surface.x[a][j]);
    longest = std::max(longest, std::sqrt(square));
  }
  return longest;
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template struct Faces<dim>;                                                                                \
  template std::vector<std::uint32_t>                contact_points(const Surface<dim> &, int);              \
  template std::vector<std::uint32_t>                body_points(const Surface<dim> &, int);                 \
  template std::vector<typename Surface<dim>::Facet> true_facets(const Surface<dim> &, int,                  \
                                                                 const std::vector<int> &, bool);            \
  template Point<dim> facet_area(const Faces<dim> &, int, const Surface<dim>::Facet &);                      \
  template double facet_size(const Surface<dim> &, const Surface<dim>::Facet &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
