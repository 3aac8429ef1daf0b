// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/seam_riders.h"

#include "core/base/error.h"
#include "coupling/contact_geometry.h"
#include "coupling/search.h"
#include "fem/embedding.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace ogive::coupling
{
namespace
{
template <int dim>
using Site = std::array<int, dim>;

template <int dim>
Foot<dim> foot(const Faces<dim> &faces, const Point<dim> &p, const typename Surface<dim>::Facet &facet)
{
  std::array<Point<dim>, Surface<dim>::Facet::n_nodes> corner;
  for (std::size_t k = 0; k < corner.size(); ++k)
    corner[k] = faces.position(mesh_party, facet.node[k]);
  return foot_on_facet<dim>(p, corner, facet.outward);
}

template <int dim>
std::vector<Box<dim>> boxes_of(const Faces<dim> &faces, const std::vector<typename Surface<dim>::Facet> &facets)
{
  std::vector<Box<dim>> boxes(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const std::uint32_t i : facets[f].node)
      boxes[f].include(faces.position(mesh_party, i));
  return boxes;
}

template <int dim>
std::vector<Box<dim>> boxes_around(const std::vector<Point<dim>> &points, double reach)
{
  std::vector<Box<dim>> boxes(points.size());
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    boxes[q].include(points[q]);
    boxes[q].inflate(reach);
  }
  return boxes;
}

template <int dim>
std::array<Point<dim>, (1 << dim)> corners_of(const Faces<dim> &faces, const std::array<std::uint32_t, (1 << dim)> &node)
{
  std::array<Point<dim>, (1 << dim)> corner;
  for (std::size_t a = 0; a < corner.size(); ++a)
    corner[a] = faces.position(mesh_party, node[a]);
  return corner;
}

template <int dim>
double shortest_edge(const std::array<Point<dim>, (1 << dim)> &corner)
{
  // VTK order: neighbours along the axes of the reference cell.
  static constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  constexpr int        n           = dim == 3 ? 12 : dim == 2 ? 4 : 1;
  double               least       = std::numeric_limits<double>::infinity();
  for (int k = 0; k < n; ++k)
    least = std::min(least, (corner[edge[k][1]] - corner[edge[k][0]]).norm());
  return least;
}

/// Particles along each axis of a cell, about `spacing` apart, at least one, as
/// its element would turn into.
template <int dim>
Site<dim> counts_in(const std::array<Point<dim>, (1 << dim)> &corner, double spacing)
{
  static constexpr int edges[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}},
                                         {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  constexpr int        n              = 1 << (dim - 1); // edges along each axis
  Site<dim>            count;
  for (int a = 0; a < dim; ++a)
  {
    double length = 0;
    for (int k = 0; k < n; ++k)
      length += (corner[edges[a][k][1]] - corner[edges[a][k][0]]).norm() / n;
    count[a] = std::max(1, static_cast<int>(std::lround(length / spacing)));
  }
  return count;
}

/// The lattice of a body of particles.
template <int dim>
struct Sites
{
  Point<dim>              origin;
  std::array<double, dim> cell;

  Site<dim> of(const Point<dim> &p) const
  {
    Site<dim> s;
    for (int a = 0; a < dim; ++a)
      s[a] = static_cast<int>(std::lround((p[a] - origin[a]) / cell[a]));
    return s;
  }
  Point<dim> place(const Site<dim> &s) const
  {
    Point<dim> p = origin;
    for (int a = 0; a < dim; ++a)
      p[a] += s[a] * cell[a];
    return p;
  }
};

template <int dim, class F>
void for_each_neighbour(const Site<dim> &site, F &&f)
{
  int count = 1;
  for (int a = 0; a < dim; ++a)
    count *= 3;
  for (int k = 0; k < count; ++k)
  {
    Site<dim> other = site;
    for (int a = 0, rest = k; a < dim; ++a, rest /= 3)
      other[a] += rest % 3 - 1;
    f(other);
  }
}

/// The cell that a point rides: one that it lies in, else one that it lies just
/// outside of, by less than `slack` (m).
template <int dim>
bool find_host(const SeamView<dim> &view, const MeshPort<dim> &mesh, const Point<dim> &p,
               std::span<const std::uint32_t> candidates, double slack, RiderPlace<dim> &place)
{
  std::array<double, dim> at;
  for (int a = 0; a < dim; ++a)
    at[a] = p[a];
  for (const bool outside : {false, true})
    for (const std::uint32_t c : candidates)
    {
      const double edge  = shortest_edge<dim>(corners_of<dim>(view.faces, view.cells.node[c]));
      const double reach = outside ? 2 * slack / edge : 1e-9;
      if (mesh.embed(view.cells.element[c], at, reach, place.host))
      {
        place.element = view.cells.element[c];
        place.where   = p;
        return true;
      }
    }
  return false;
}
} // namespace

template <int dim>
double place_in_cell(const std::array<Point<dim>, (1 << dim)> &corner, const Point<dim> &xi,
                     std::array<double, (1 << dim)> &weight)
{
  std::array<Point<dim>, (1 << dim)> slope;
  fem::shape_functions<dim>(xi, weight, slope);
  Eigen::Matrix<double, dim, dim> J = Eigen::Matrix<double, dim, dim>::Zero();
  for (std::size_t a = 0; a < corner.size(); ++a)
    J += corner[a] * slope[a].transpose();
  return std::abs(J.determinant());
}

template <int dim>
std::vector<typename Surface<dim>::Facet> seam_facets(const InterfaceSpec &spec, const Faces<dim> &faces,
                                                      double spacing)
{
  if (spec.per_edge > 0)
    return true_facets(faces[mesh_party], spec.mesh, spec.symmetry_axes, true);
  const auto                                facets = true_facets(faces[mesh_party], spec.mesh, spec.symmetry_axes);
  std::vector<typename Surface<dim>::Facet> seam;
  const auto             points = body_points(faces[particle_party], spec.particles);
  std::vector<Point<dim>> places;
  for (const std::uint32_t i : points)
    places.push_back(faces.position(particle_party, i));
  NeighbourList<dim> list;
  list.build(boxes_of<dim>(faces, facets), boxes_around<dim>(places, spacing));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const std::uint32_t q : list.of(f))
    {
      constexpr double  ahead = .8; // of the distance along the normal: not beside the facet
      const Foot<dim>   at    = foot<dim>(faces, places[q], facets[f]);
      const double      r     = std::sqrt(at.distance2);
      if (r < spacing && (places[q] - at.where).dot(at.normal) >= ahead * r)
      {
        seam.push_back(facets[f]);
        break;
      }
    }
  return seam;
}

template <int dim>
std::vector<RiderPlace<dim>> continue_lattice(const SeamView<dim> &view, const MeshPort<dim> &mesh)
{
  const auto  &faces  = view.faces;
  const auto   points = body_points(faces[particle_party], view.spec.particles);
  const double least  = *std::min_element(view.cell.begin(), view.cell.end());
  const double most   = *std::max_element(view.cell.begin(), view.cell.end());
  Sites<dim>   sites{faces.position(particle_party, points.front()), view.cell};

  std::set<Site<dim>>     taken;
  std::vector<Point<dim>> places;
  for (const std::uint32_t i : points)
  {
    places.push_back(faces.position(particle_party, i));
    taken.insert(sites.of(places.back()));
  }
  if (taken.size() < points.size())
    throw InputError({"", 0, "Interfaces/" + view.spec.name},
                     "the particles of body \"" + view.spec.particle_body + "\" stand on no lattice that could go on into the mesh",
                     "a body of particles without jitter, or method = tied");

  NeighbourList<dim> near;
  near.build(boxes_around<dim>(places, 1.5 * most), boxes_of<dim>(faces, view.seam));
  std::vector<Site<dim>> front;
  for (std::size_t q = 0; q < places.size(); ++q)
    if (!near.of(q).empty())
      front.push_back(sites.of(places[q]));

  std::vector<Box<dim>> boxes(view.cells.element.size());
  for (std::size_t c = 0; c < boxes.size(); ++c)
  {
    for (const std::uint32_t i : view.cells.node[c])
      boxes[c].include(faces.position(mesh_party, i));
    boxes[c].inflate(.5 * least);
  }
  double volume = 1; // of whole cells
  for (const double c : view.cell)
    volume *= c;
  std::vector<RiderPlace<dim>> riders;
  const int                    layers = static_cast<int>(std::ceil(view.depth / least));
  for (int layer = 0; layer < layers && !front.empty(); ++layer)
  {
    std::vector<Site<dim>> fresh;
    for (const auto &site : front)
      for_each_neighbour<dim>(site, [&](const Site<dim> &s) {
        if (!taken.contains(s))
          fresh.push_back(s);
      });
    std::sort(fresh.begin(), fresh.end());
    fresh.erase(std::unique(fresh.begin(), fresh.end()), fresh.end());
    std::vector<Point<dim>> at;
    for (const auto &s : fresh)
      at.push_back(sites.place(s));
    NeighbourList<dim> hosts;
    hosts.build(boxes_around<dim>(at, 0), boxes);
    front.clear();
    for (std::size_t k = 0; k < fresh.size(); ++k)
    {
      RiderPlace<dim> place;
      if (!find_host<dim>(view, mesh, at[k], hosts.of(k), .4 * least, place))
        continue;
      place.volume = volume * (view.spec.axisymmetric ? 2 * std::numbers::pi * at[k][0] : 1.);
      taken.insert(fresh[k]);
      front.push_back(fresh[k]);
      riders.push_back(place);
    }
  }
  return riders;
}

template <int dim>
std::vector<RiderPlace<dim>> places_in_cells(const SeamView<dim> &view)
{
  // Cells within the depth of a facet of the seam, by the boxes of both.
  std::vector<Box<dim>> boxes(view.cells.element.size());
  for (std::size_t c = 0; c < boxes.size(); ++c)
    for (const std::uint32_t i : view.cells.node[c])
      boxes[c].include(view.faces.position(mesh_party, i));
  auto seam = boxes_of<dim>(view.faces, view.seam);
  for (auto &box : seam)
    box.inflate(view.depth);
  NeighbourList<dim> near;
  near.build(boxes, seam);

  const double                 spacing = *std::max_element(view.cell.begin(), view.cell.end());
  std::vector<RiderPlace<dim>> riders;
  for (std::size_t c = 0; c < boxes.size(); ++c)
  {
    if (near.of(c).empty())
      continue;
    const auto corner = corners_of<dim>(view.faces, view.cells.node[c]);
    const auto n      = counts_in<dim>(corner, spacing);
    int        count  = 1;
    double     share  = 1; // of the reference cell
    for (const int along : n)
    {
      count *= along;
      share *= 2. / along;
    }
    for (int k = 0; k < count; ++k)
    {
      Point<dim> xi;
      for (int a = 0, rest = k; a < dim; rest /= n[a], ++a)
        xi[a] = (2 * (rest % n[a]) + 1.) / n[a] - 1;
      RiderPlace<dim> place;
      place.element   = view.cells.element[c];
      place.host.node = view.cells.node[c];
      place.volume    = place_in_cell<dim>(corner, xi, place.host.weight) * share;
      for (std::size_t a = 0; a < corner.size(); ++a)
        place.where += place.host.weight[a] * corner[a];
      if (view.spec.axisymmetric)
        place.volume *= 2 * std::numbers::pi * place.where[0];
      riders.push_back(place);
    }
  }
  return riders;
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template double place_in_cell<dim>(const std::array<Point<dim>, (1 << dim)> &, const Point<dim> &,         \
                                     std::array<double, (1 << dim)> &);                                      \
  template std::vector<typename Surface<dim>::Facet> seam_facets<dim>(const InterfaceSpec &,                 \
                                                                      const Faces<dim> &, double);           \
  template std::vector<RiderPlace<dim>> continue_lattice<dim>(const SeamView<dim> &, const MeshPort<dim> &); \
  template std::vector<RiderPlace<dim>> places_in_cells<dim>(const SeamView<dim> &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
