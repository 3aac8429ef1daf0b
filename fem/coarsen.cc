// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/coarsen.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace ogive::fem
{
namespace
{
using dealii::Point;
using dealii::Triangulation;
using input::ShapeKind;

constexpr dealii::types::manifold_id round_faces = 1;

/// Distance of a point from the impact, m.
double distance(const input::Body &body, const Vec3 &x)
{
  const Vec3 d = x - body.coarsen_from;
  if (body.coarsen_along.isZero(0))
    return d.norm();
  const Vec3 e = body.coarsen_along.normalized();
  return (d - d.dot(e) * e).norm();
}

/// Least distance over a lattice of points in the box around a cell.
template <int dim, class Cell>
double cell_distance(const input::Body &body, const Cell &cell)
{
  constexpr int n     = 5;
  const auto    box   = cell->bounding_box().get_boundary_points();
  double        least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < (dim > 2 ? n : 1); ++k)
    for (int j = 0; j < (dim > 1 ? n : 1); ++j)
      for (int i = 0; i < n; ++i)
      {
        const int at[3] = {i, j, k};
        Vec3      x     = Vec3::Zero();
        for (int d = 0; d < dim; ++d)
          x[d] = box.first[d] + at[d] * (box.second[d] - box.first[d]) / (n - 1);
        least = std::min(least, distance(body, x));
      }
  return least;
}

/// Doublings of the edge at a distance; the small share absorbs rounding of
/// cells that end at a multiple.
int doublings(const input::Body &body, double distance)
{
  return static_cast<int>(std::min(body.coarsen, std::floor(distance / body.coarsen_distance + 1e-9)));
}

/// New points of round faces lie on the shape; in rings and shells, which have
/// no middle, all new points turn with it.
template <int dim>
void set_manifold(const input::Body &body, const input::Scene &scene, const std::vector<std::string> &names,
                  Triangulation<dim> &triangulation)
{
  if constexpr (dim > 1)
  {
    const input::Shape &s    = body.shape;
    const bool          ball = s.kind == ShapeKind::sphere || s.kind == ShapeKind::shell;
    const bool          flat = s.kind == ShapeKind::box || s.kind == ShapeKind::mesh;
    if (flat || (scene.dimension == input::Dimension::axisymmetric && !ball))
      return;
    const bool hollow = s.kind == ShapeKind::ring || s.kind == ShapeKind::shell;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (hollow)
        cell->set_all_manifold_ids(round_faces);
      else
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            if (const std::string &name = names[cell->face(f)->boundary_id()];
                name == "side" || name == "outer")
              cell->face(f)->set_all_manifold_ids(round_faces);
    Point<dim> centre;
    for (int i = 0; i < dim; ++i)
      centre[i] = s.base[i];
    if constexpr (dim == 3)
      if (!ball)
      {
        dealii::Tensor<1, 3> axis;
        for (int i = 0; i < 3; ++i)
          axis[i] = s.axis[i];
        triangulation.set_manifold(round_faces, dealii::CylindricalManifold<3>(axis, centre));
        return;
      }
    triangulation.set_manifold(round_faces, dealii::SphericalManifold<dim>(centre));
  }
}

/// Gives each named boundary of the coarse mesh an id, which its children keep.
template <int dim>
std::vector<std::string> number_boundaries(const ShapeMesh<dim> &shape, Triangulation<dim> &triangulation)
{
  std::vector<std::string> names;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
      {
        std::vector<Point<dim>> corners;
        for (unsigned int k = 0; k < (dim == 3 ? 4 : dim); ++k)
          corners.push_back(cell->face(f)->vertex(k));
        const std::string name = shape.face_name(corners);
        const auto        at   = std::find(names.begin(), names.end(), name);
        cell->face(f)->set_boundary_id(static_cast<dealii::types::boundary_id>(at - names.begin()));
        if (at == names.end())
          names.push_back(name);
      }
  return names;
}

template <class Line>
HangingVertex middle_of_line(const Line &line)
{
  return {line->child(0)->vertex_index(1), 2, {line->vertex_index(0), line->vertex_index(1)}};
}
} // namespace

template <int dim>
std::vector<std::string> make_coarsened(const input::Body &body, const input::Scene &scene,
                                        Triangulation<dim> &triangulation)
{
  const int   levels         = static_cast<int>(body.coarsen);
  input::Body coarse         = body;
  coarse.spacing             = std::ldexp(body.spacing, levels);
  ShapeMesh<dim> shape = mesh_shape<dim>(coarse, scene);
  // Neighbours must agree about the direction of an edge before it can be parted.
  dealii::GridTools::consistently_order_cells(shape.raw.cells);
  triangulation.create_triangulation(shape.raw.vertices, shape.raw.cells, dealii::SubCellData());
  const std::vector<std::string> names = number_boundaries(shape, triangulation);
  set_manifold(body, scene, names, triangulation);
  for (int pass = 0; pass < levels; ++pass)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->level() < levels - doublings(body, cell_distance<dim>(body, cell)))
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
  }
  return names;
}

template <int dim>
void name_boundaries(const std::vector<std::string> &names, BodyMesh<dim> &mesh)
{
  for (std::string &name : mesh.boundary_names)
    if (std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); }))
      name = names.at(std::stoul(name));
}

template <int dim>
std::vector<HangingVertex> hanging_vertices(const Triangulation<dim> &triangulation)
{
  std::vector<HangingVertex> found;
  if constexpr (dim > 1)
  {
    std::set<unsigned int> seen;
    const auto             add = [&](const HangingVertex &h)
    {
      if (seen.insert(h.vertex).second)
        found.push_back(h);
    };
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      for (unsigned int l = 0; l < cell->n_lines(); ++l)
        if (cell->line(l)->has_children())
          add(middle_of_line(cell->line(l)));
      if constexpr (dim == 3)
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f); face->has_children())
            add({face->child(0)->vertex_index(3),
                 4,
                 {face->vertex_index(0), face->vertex_index(1), face->vertex_index(2),
                  face->vertex_index(3)}});
    }
  }
  return found;
}

template <int dim>
void straighten(BodyMesh<dim> &mesh)
{
  // A master may hang from a still coarser cell: once for each level.
  constexpr int most_levels = 6;
  for (int pass = 0; pass < most_levels && !mesh.hanging.empty(); ++pass)
    for (const auto &h : mesh.hanging)
      for (int i = 0; i < dim; ++i)
      {
        double sum = 0;
        for (std::size_t k = 0; k < h.n; ++k)
          sum += mesh.x[i][h.master[k]];
        mesh.x[i][h.node] = sum / static_cast<double>(h.n);
      }
}

#define OGIVE_INSTANTIATE(dim)                                                                                 \
  template std::vector<std::string>   make_coarsened<dim>(const input::Body &, const input::Scene &,           \
                                                        Triangulation<dim> &);                               \
  template void                       name_boundaries<dim>(const std::vector<std::string> &, BodyMesh<dim> &); \
  template std::vector<HangingVertex> hanging_vertices<dim>(const Triangulation<dim> &);                       \
  template void                       straighten<dim>(BodyMesh<dim> &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
