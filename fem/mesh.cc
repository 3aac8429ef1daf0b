// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh.h"

#include "core/base/error.h"
#include "fem/coarsen.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_axisymmetric.h"
#include "fem/embedding.h"
#include "fem/initial_velocity.h"
#include "fem/mesh_import.h"
#include "fem/mesh_shapes.h"
#include "fem/raise_degree.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace ogive::fem
{
namespace
{
using dealii::Point;
using dealii::Triangulation;

/// deal.II's corner that stands at corner a of the VTK order.
constexpr unsigned int from_vtk[8] = {0, 1, 3, 2, 4, 5, 7, 6};

template <int dim>
using FaceName = std::function<std::string(const std::vector<Point<dim>> &)>;

/// Ring order, outward: right-handed normal away from `inside`.
template <int dim>
void orient(typename BodyMesh<dim>::Facet &facet, const std::vector<Point<dim>> &corner, const Point<dim> &inside)
{
  if constexpr (dim == 1)
    facet.outward = corner[0][0] > inside[0] ? 1 : -1;
  else if constexpr (dim == 2)
  {
    const Point<2> t(corner[1] - corner[0]), away(corner[0] - inside);
    if (t[1] * away[0] - t[0] * away[1] < 0)
      std::swap(facet.node[0], facet.node[1]);
  }
  else
  {
    std::swap(facet.node[2], facet.node[3]);
    const auto d1 = corner[3] - corner[0], d2 = corner[2] - corner[1];
    const auto away = corner[0] + (corner[3] - corner[0]) / 2. - inside;
    if (dealii::cross_product_3d(d1, d2) * away < 0)
      std::swap(facet.node[1], facet.node[3]);
  }
}

template <int dim>
int boundary_index(BodyMesh<dim> &mesh, const std::string &name)
{
  const auto at = std::find(mesh.boundary_names.begin(), mesh.boundary_names.end(), name);
  if (at != mesh.boundary_names.end())
    return static_cast<int>(at - mesh.boundary_names.begin());
  mesh.boundary_names.push_back(name);
  return static_cast<int>(mesh.boundary_names.size() - 1);
}

template <int dim>
std::string symmetry_name(const std::vector<Point<dim>> &corners, const input::Scene &scene, double tolerance)
{
  const auto flat = [&](int axis) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const auto &p) { return std::abs(p[axis]) <= tolerance; });
  };
  for (const auto &plane : scene.symmetry)
    if (plane.axis < dim && flat(plane.axis))
      return std::string("symmetry-") + "xyz"[plane.axis];
  if (scene.dimension == input::Dimension::axisymmetric && flat(0))
    return "symmetry-axis";
  return {};
}

template <int dim>
void reduce(const Triangulation<dim> &triangulation, const input::Scene &scene, double tolerance,
            const FaceName<dim> &name, BodyMesh<dim> &mesh)
{
  std::vector<std::int64_t> index(triangulation.n_vertices(), -1);
  // Nodes are numbered as elements meet them, but for generated bodies, whose
  // generators run along rows: neighbours in a row stay neighbours in memory.
  const auto                node_of = [&](unsigned int vertex) {
    if (index[vertex] < 0)
    {
      index[vertex] = static_cast<std::int64_t>(mesh.n_nodes());
      for (int i = 0; i < dim; ++i)
      {
        const double x = triangulation.get_vertices()[vertex][i];
        mesh.x[i].push_back(std::abs(x) <= tolerance ? 0. : x);
      }
    }
    return static_cast<std::uint32_t>(index[vertex]);
  };
  if (name)
    for (unsigned int vertex = 0; vertex < triangulation.n_vertices(); ++vertex)
      if (triangulation.vertex_used(vertex))
        node_of(vertex);
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    const auto id = static_cast<std::uint32_t>(mesh.n_cells());
    for (int a = 0; a < BodyMesh<dim>::corners; ++a)
      mesh.cells.push_back(node_of(cell->vertex_index(from_vtk[a])));
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
      {
        typename BodyMesh<dim>::Facet facet;
        std::vector<Point<dim>>       corner;
        for (unsigned int k = 0; k < facet.node.size(); ++k)
        {
          corner.push_back(cell->face(f)->vertex(k));
          facet.node[k] = node_of(cell->face(f)->vertex_index(k));
        }
        facet.cell = id;
        orient<dim>(facet, corner, cell->center());
        std::string face = symmetry_name<dim>(corner, scene, tolerance);
        if (face.empty())
          face = name ? name(corner) : std::to_string(cell->face(f)->boundary_id());
        facet.boundary = boundary_index(mesh, face);
        mesh.facets.push_back(facet);
      }
  }
  for (const HangingVertex &h : hanging_vertices(triangulation))
  {
    typename BodyMesh<dim>::Hanging hanging{node_of(h.vertex), h.n, {}};
    for (std::size_t k = 0; k < h.n; ++k)
      hanging.master[k] = node_of(h.master[k]);
    mesh.hanging.push_back(hanging);
  }
  straighten(mesh);
}

template <int dim>
void check_symmetry(const BodyMesh<dim> &mesh, const input::Scene &scene, const std::string &body)
{
  for (int i = 0; i < dim; ++i)
  {
    const bool plane = std::any_of(scene.symmetry.begin(), scene.symmetry.end(),
                                   [i](const auto &p) { return p.axis == i; });
    const bool axis  = mesh.axisymmetric && i == 0;
    if ((plane || axis) && *std::min_element(mesh.x[i].begin(), mesh.x[i].end()) < 0)
      throw InputError({"", 0, body},
                       std::string("the mesh reaches beyond ") +
                         (axis ? "the axis of symmetry" : std::string("the symmetry plane ") + "xyz"[i] + " = 0"),
                       "a body whose centre lies on the plane, or one on its positive side");
  }
}

template <class Element>
double element_volume(const BodyMesh<Element::dim> &mesh, std::size_t cell)
{
  double x[Element::corners][Element::dim];
  for (int a = 0; a < Element::corners; ++a)
    for (int i = 0; i < Element::dim; ++i)
      x[a][i] = mesh.x[i][mesh.cells[cell * Element::corners + a]];
  Geometry<Element, double> g;
  Element::gradient(x, g);
  return g.volume;
}
} // namespace

template <int dim>
double BodyMesh<dim>::volume() const
{
  double sum = 0;
  for (std::size_t c = 0; c < n_cells(); ++c)
    if constexpr (dim == 1)
      sum += element_volume<Line2>(*this, c);
    else if constexpr (dim == 2)
      sum += axisymmetric ? element_volume<Quad4Axisymmetric>(*this, c) : element_volume<Quad4>(*this, c);
    else
      sum += element_volume<Hex8>(*this, c);
  return sum;
}

template <int dim>
bool BodyMesh<dim>::is_called(int b, const std::string &face) const
{
  if (face == "all" || boundary_names[b] == face)
    return true;
  if (boundary_aliases.empty())
    return false;
  const std::vector<std::string> &aliases = boundary_aliases[b];
  return std::find(aliases.begin(), aliases.end(), face) != aliases.end();
}

template <int dim>
void check_quality(const BodyMesh<dim> &mesh, const std::string &body_name)
{
  using Vector = Eigen::Matrix<double, dim, 1>;
  std::array<double, 1 << dim> weight;
  std::array<Vector, 1 << dim> slope;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    for (int corner = 0; corner < mesh.corners; ++corner)
    {
      Vector xi, centre = Vector::Zero();
      for (int i = 0; i < dim; ++i)
        xi[i] = corner_sign[corner][i];
      shape_functions<dim>(xi, weight, slope);
      Eigen::Matrix<double, dim, dim> J = Eigen::Matrix<double, dim, dim>::Zero();
      for (int a = 0; a < mesh.corners; ++a)
        for (int i = 0; i < dim; ++i)
        {
          const double x = mesh.x[i][mesh.cells[c * mesh.corners + a]];
          J.row(i) += x * slope[a].transpose();
          centre[i] += x / mesh.corners;
        }
      if (!(J.determinant() > 0))
      {
        std::string where;
        for (int i = 0; i < dim; ++i)
          where += (i ? ", " : "") + std::to_string(centre[i]);
        const std::size_t e      = c * mesh.n_elements() / mesh.n_cells();
        const std::string number = mesh.file_numbers.empty() ? std::to_string(e) + " of the mesh" :
                                                               std::to_string(mesh.file_numbers[e]) + " of the mesh file";
        throw InputError({"", 0, body_name}, "element " + number + " at (" + where +
                                               ") m is folded: its Jacobian is not positive at a corner");
      }
    }
}

template <int dim>
BodyMesh<dim> make_mesh(const input::Body &body, const input::Scene &scene, int body_index,
                        std::shared_ptr<const materials::Material> material)
{
  BodyMesh<dim> mesh;
  mesh.body         = body_index;
  mesh.material     = std::move(material);
  mesh.erosion      = body.erosion;
  mesh.converts     = body.method == input::Method::automatic;
  mesh.conversion   = body.conversion;
  mesh.axisymmetric = scene.dimension == input::Dimension::axisymmetric;

  Triangulation<dim> triangulation(Triangulation<dim>::limit_level_difference_at_vertices);
  FaceName<dim>      name;
  MeshImport         import;
  double             tolerance = 1e-7 * body.spacing;
  std::vector<std::string> ids; // names of boundary ids
  if (body.shape.kind == input::ShapeKind::mesh)
  {
    import    = import_mesh<dim>(body, triangulation);
    tolerance = 1e-9 * dealii::GridTools::diameter(triangulation);
  }
  else
  {
    if (!(body.spacing > 0))
      throw InputError({"", 0, body.name}, "a meshed body needs an element edge > 0");
    if (body.coarsen > 0)
      ids = make_coarsened<dim>(body, scene, triangulation);
    else
    {
      ShapeMesh<dim> shape = mesh_shape<dim>(body, scene);
      triangulation.create_triangulation(shape.raw.vertices, shape.raw.cells, dealii::SubCellData());
      name = shape.face_name;
    }
  }
  reduce<dim>(triangulation, scene, tolerance, name, mesh);
  if (body.coarsen > 0)
    name_boundaries(ids, mesh);
  if (body.shape.kind == input::ShapeKind::mesh)
  {
    name_boundaries(import, body.name, mesh);
    mesh.file_numbers = std::move(import.cell_numbers);
    mesh.notes        = std::move(import.notes);
  }
  mesh.element = body.element.empty() ? scene.fem.element : body.element;
  if (mesh.element == "spectral")
    raise_degree(mesh, scene.fem.degree);
  check_symmetry(mesh, scene, body.name);
  check_quality(mesh, body.name);
  set_initial_velocity(body, scene, mesh);
  return mesh;
}

template struct BodyMesh<1>;
template struct BodyMesh<2>;
template struct BodyMesh<3>;
#define OGIVE_INSTANTIATE(dim)                                                                       \
  template void          check_quality<dim>(const BodyMesh<dim> &, const std::string &);             \
  template BodyMesh<dim> make_mesh<dim>(const input::Body &, const input::Scene &, int,              \
                                        std::shared_ptr<const materials::Material>);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
