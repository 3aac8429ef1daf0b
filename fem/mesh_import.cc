// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_import.h"

#include "core/base/error.h"
#include "fem/mesh_file.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

namespace ogive::fem
{
namespace
{
using dealii::Point;
using dealii::Triangulation;

constexpr const char *cells_of[4]      = {"points", "lines", "quadrilaterals", "hexahedra"};
constexpr unsigned int lexicographic[8] = {0, 1, 3, 2, 4, 5, 7, 6}; // its own inverse

InputError wrong(const input::Body &body, const char *entry, const std::string &what, const std::string &expected = {},
                 const std::string &suggestion = {})
{
  return {{"", 0, "Bodies/" + body.name + "/" + entry}, what, expected, suggestion};
}

std::string listed(const std::vector<std::string> &names)
{
  std::set<std::string> sorted(names.begin(), names.end());
  std::string           all;
  for (const std::string &name : sorted)
    all += (all.empty() ? "\"" : ", \"") + name + "\"";
  return all.empty() ? "none" : all;
}

void refuse_others(const MeshFile &file, const input::Body &body)
{
  if (file.others.empty())
    return;
  std::string found;
  for (const auto &[kind, n] : file.others)
    found += (found.empty() ? "" : ", ") + std::to_string(n) + " " + kind;
  throw wrong(body, "mesh file", "\"" + file.path + "\" holds " + found, "quadrilaterals or hexahedra of first order",
              "in gmsh: Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 2; Mesh.ElementOrder = 1");
}

using Element = MeshFile::Element;
using Key     = std::array<std::uint32_t, 8>;

Key sorted_nodes(const Element &e)
{
  Key key = e.node;
  std::fill(key.begin() + (1 << e.dim), key.end(), 0xffffffff);
  std::sort(key.begin(), key.end());
  return key;
}

/// The cells that the body takes, each once.
std::vector<Element> cells_of_part(const MeshFile &file, const input::Body &body, int dim)
{
  std::vector<char>  chosen(file.elements.size(), body.shape.mesh_part.empty());
  const std::string &part = body.shape.mesh_part;
  if (!part.empty())
  {
    const std::vector<std::string> names = file.names(dim);
    if (std::find(names.begin(), names.end(), part) == names.end())
      throw wrong(body, "mesh part", "\"" + file.path + "\" has no group \"" + part + "\" of " + cells_of[dim],
                  "one of " + listed(names));
    for (const auto &group : file.groups)
      if (group.dim == dim && group.name == part)
        for (const std::uint32_t e : group.elements)
          chosen[e] = true;
  }
  std::vector<Element> cells;
  std::set<Key>        seen;
  for (std::size_t e = 0; e < file.elements.size(); ++e)
    if (const Element &element = file.elements[e]; chosen[e] && element.dim == dim)
    {
      const Key key = sorted_nodes(element);
      if (std::adjacent_find(key.begin(), key.begin() + (1 << dim)) != key.begin() + (1 << dim))
        throw wrong(body, "mesh file", "element " + std::to_string(element.number) + " of \"" + file.path +
                                         "\" names a node twice", "cells with a node of its own at each corner");
      if (seen.insert(key).second) // gmsh 2.2 writes it once for each of its groups
        cells.push_back(element);
    }
  if (cells.empty())
  {
    std::string has;
    for (int d = 1; d <= 3; ++d)
      if (const auto n = std::count_if(file.elements.begin(), file.elements.end(), [d](const Element &e) { return e.dim == d; }))
        has += (has.empty() ? " (it holds " : ", ") + std::to_string(n) + " " + cells_of[d];
    throw wrong(body, "mesh file", "\"" + file.path + "\" holds no " + cells_of[dim] + has + (has.empty() ? "" : ")"),
                std::string(cells_of[dim]) + " for this dimension of the scene");
  }
  return cells;
}

/// Twice the area, or six times the volume of the middle tetrahedra: its sign is
/// the hand of the cell.
double hand(const MeshFile &file, const Element &e)
{
  const auto edge = [&](int a, int b) {
    Eigen::Vector3d d;
    for (int i = 0; i < 3; ++i)
      d[i] = file.x[e.node[b]][i] - file.x[e.node[a]][i];
    return d;
  };
  if (e.dim == 1)
    return edge(0, 1)[0];
  if (e.dim == 2)
    return edge(0, 2).cross(edge(1, 3))[2];
  const Eigen::Vector3d along  = edge(0, 1) + edge(3, 2) + edge(4, 5) + edge(7, 6);
  const Eigen::Vector3d across = edge(0, 3) + edge(1, 2) + edge(4, 7) + edge(5, 6);
  const Eigen::Vector3d up     = edge(0, 4) + edge(1, 5) + edge(2, 6) + edge(3, 7);
  return along.cross(across).dot(up);
}

/// The same cell in a mirror.
void turn(Element &e)
{
  if (e.dim == 1)
    std::swap(e.node[0], e.node[1]);
  else if (e.dim == 2)
    std::swap(e.node[1], e.node[3]);
  else
    std::swap_ranges(e.node.begin(), e.node.begin() + 4, e.node.begin() + 4);
}

void make_right_handed(const MeshFile &file, const input::Body &body, std::vector<Element> &cells,
                       std::vector<std::string> &notes)
{
  std::size_t    left = 0;
  const Element *odd[2]{}; // the first of each hand
  for (const Element &e : cells)
  {
    const bool is_left = !(hand(file, e) > 0);
    left += is_left;
    if (!odd[is_left])
      odd[is_left] = &e;
  }
  if (left == 0)
    return;
  if (left < cells.size())
  {
    const bool few_left = 2 * left <= cells.size();
    throw wrong(body, "mesh file", "element " + std::to_string(odd[few_left]->number) + " of \"" + file.path +
                                     "\" is numbered the other way round than most or turned inside out (" +
                                     std::to_string(few_left ? left : cells.size() - left) + " of " +
                                     std::to_string(cells.size()) + " are)",
                "all cells numbered in one sense");
  }
  for (Element &e : cells)
    turn(e);
  notes.push_back("all " + std::to_string(left) + " cells of the mesh file were numbered left-handed; turned");
}

template <int dim>
void check_flat(const MeshFile &file, const input::Body &body, const std::vector<Element> &cells)
{
  double low[3], high[3];
  for (int i = 0; i < 3; ++i)
    low[i] = high[i] = file.x[cells.front().node[0]][i];
  for (const Element &e : cells)
    for (int a = 0; a < 1 << dim; ++a)
      for (int i = 0; i < 3; ++i)
      {
        low[i]  = std::min(low[i], file.x[e.node[a]][i]);
        high[i] = std::max(high[i], file.x[e.node[a]][i]);
      }
  for (int i = dim; i < 3; ++i)
    if (high[i] - low[i] > 1e-9 * (high[0] - low[0]))
      throw wrong(body, "mesh file", "\"" + file.path + "\" is no plane mesh: its " + "xyz"[i] + " varies",
                  dim == 2 ? "quadrilaterals in a plane z = const" : "lines along x");
}

/// Each face of a cell belongs to it alone or to it and one neighbour.
void check_neighbours(const MeshFile &file, const input::Body &body, const std::vector<Element> &cells)
{
  std::vector<std::pair<std::vector<std::uint32_t>, std::int64_t>> faces;
  for (const Element &e : cells)
    for (auto &face : faces_of(e))
    {
      std::sort(face.begin(), face.end());
      faces.emplace_back(std::move(face), e.number);
    }
  std::sort(faces.begin(), faces.end());
  for (std::size_t k = 2; k < faces.size(); ++k)
    if (faces[k].first == faces[k - 2].first)
      throw wrong(body, "mesh file", "the elements " + std::to_string(faces[k - 2].second) + ", " +
                                       std::to_string(faces[k - 1].second) + " and " + std::to_string(faces[k].second) +
                                       " of \"" + file.path + "\" share one face",
                  "at most two cells at a face");
}

template <int dim>
void triangulate(const MeshFile &file, const std::vector<Element> &cells, Triangulation<dim> &triangulation,
                 std::vector<std::int64_t> &vertex_of)
{
  std::vector<Point<dim>>            vertices;
  std::vector<dealii::CellData<dim>> data;
  vertex_of.assign(file.x.size(), -1);
  for (const Element &e : cells)
  {
    data.emplace_back();
    for (int a = 0; a < 1 << dim; ++a)
    {
      const std::uint32_t node = e.node[a];
      if (vertex_of[node] < 0)
      {
        vertex_of[node] = static_cast<std::int64_t>(vertices.size());
        vertices.emplace_back();
        for (int i = 0; i < dim; ++i)
          vertices.back()[i] = file.x[node][i];
      }
      data.back().vertices[lexicographic[a]] = static_cast<unsigned int>(vertex_of[node]);
    }
  }
  dealii::GridTools::consistently_order_cells(data);
  triangulation.create_triangulation(vertices, data, dealii::SubCellData());
}

/// Gives the facets ids, one for each set of groups that holds some.
template <int dim>
void mark_boundaries(const MeshFile &file, const std::vector<std::int64_t> &vertex_of,
                     Triangulation<dim> &triangulation, std::vector<std::vector<std::string>> &faces)
{
  std::map<Key, std::set<std::size_t>> groups_at; // by vertices
  for (std::size_t g = 0; g < file.groups.size(); ++g)
    if (file.groups[g].dim == dim - 1)
      for (const std::uint32_t index : file.groups[g].elements)
      {
        Element facet = file.elements[index];
        bool    here  = true;
        for (int a = 0; a < 1 << (dim - 1); ++a)
        {
          here          = here && vertex_of[facet.node[a]] >= 0;
          facet.node[a] = static_cast<std::uint32_t>(vertex_of[facet.node[a]]);
        }
        if (here)
          groups_at[sorted_nodes(facet)].insert(g);
      }
  std::map<std::set<std::size_t>, unsigned int> id_of;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (dim > 1 && cell->face(f)->at_boundary())
      {
        Element facet;
        facet.dim = dim - 1;
        for (const unsigned int v : cell->face(f)->vertex_indices())
          facet.node[v] = cell->face(f)->vertex_index(v);
        const auto at = groups_at.find(sorted_nodes(facet));
        if (at == groups_at.end())
          continue;
        const auto [id, fresh] = id_of.try_emplace(at->second, static_cast<unsigned int>(faces.size()));
        if (fresh)
        {
          faces.emplace_back(1); // one word for all its groups, then each
          for (const std::size_t g : at->second)
          {
            faces.back()[0] += (faces.back()[0].empty() ? "" : "+") + file.groups[g].name;
            faces.back().push_back(file.groups[g].name);
          }
          for (const std::size_t g : at->second)
            if (file.groups[g].number > 0)
              faces.back().push_back(std::to_string(file.groups[g].number));
        }
        cell->face(f)->set_boundary_id(id->second);
      }
}

/// How many pieces without a node in common.
std::size_t count_pieces(const std::vector<Element> &cells, std::size_t n_nodes)
{
  std::vector<std::uint32_t> root(n_nodes);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t a) {
    while (root[a] != a)
      a = root[a] = root[root[a]];
    return a;
  };
  for (const Element &e : cells)
    for (int a = 1; a < 1 << e.dim; ++a)
      root[find(e.node[a])] = find(e.node[0]);
  std::set<std::uint32_t> pieces;
  for (const Element &e : cells)
    pieces.insert(find(e.node[0]));
  return pieces.size();
}

/// Formats that only deal.II knows: names are lost, ids stay.
template <int dim>
void read_by_dealii(const std::string &path, const input::Body &body, Triangulation<dim> &triangulation,
                    MeshImport &import)
{
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending.size() < 2)
    throw wrong(body, "mesh file", "\"" + path + "\" has no ending that names its format", "such as .msh or .inp");
  if (!body.shape.mesh_part.empty())
    throw wrong(body, "mesh part", "a file *" + ending + " has no parts with names", "a file .msh or .inp");
  std::ifstream       in(path);
  dealii::GridIn<dim> reader;
  reader.attach_triangulation(triangulation);
  try
  {
    reader.read(in, dealii::GridIn<dim>::parse_format(ending.substr(1)));
  }
  catch (const dealii::ExceptionBase &e)
  {
    std::ostringstream why;
    e.print_info(why);
    throw wrong(body, "mesh file", "\"" + path + "\" cannot be read: " + e.get_exc_name() + " " + why.str(),
                "a format that deal.II reads: " + dealii::GridIn<dim>::get_format_names());
  }
  dealii::GridTools::scale(body.shape.mesh_unit, triangulation);
  for (const dealii::types::boundary_id id : triangulation.get_boundary_ids())
  {
    import.faces.resize(std::max<std::size_t>(import.faces.size(), id + 1));
    if (id > 0)
      import.faces[id] = {std::to_string(id)};
  }
}
} // namespace

template <int dim>
MeshImport import_mesh(const input::Body &body, Triangulation<dim> &triangulation)
{
  const std::string &path = body.shape.mesh_file;
  MeshImport         import;
  import.faces.push_back({"rest", "0"});
  if (!std::filesystem::is_regular_file(path))
    throw wrong(body, "mesh file", "there is no file \"" + path + "\"", "a mesh file");
  if (!is_mesh_file(path))
  {
    read_by_dealii<dim>(path, body, triangulation, import);
    return import;
  }
  const MeshFile file = read_mesh_file(path, body.shape.mesh_unit);
  refuse_others(file, body);
  std::vector<Element> cells = cells_of_part(file, body, dim);
  check_flat<dim>(file, body, cells);
  make_right_handed(file, body, cells, import.notes);
  check_neighbours(file, body, cells);
  std::vector<std::int64_t> vertex_of;
  triangulate<dim>(file, cells, triangulation, vertex_of);
  mark_boundaries<dim>(file, vertex_of, triangulation, import.faces);
  for (const Element &e : cells)
    import.cell_numbers.push_back(e.number);
  if (const std::size_t n = count_pieces(cells, file.x.size()); n > 1)
    import.notes.push_back("the mesh falls into " + std::to_string(n) +
                           " pieces that share no node (in gmsh, Coherence joins surfaces that touch)");
  return import;
}

template <int dim>
void name_boundaries(const MeshImport &import, const std::string &body, BodyMesh<dim> &mesh)
{
  mesh.boundary_aliases.assign(mesh.boundary_names.size(), {});
  for (std::size_t b = 0; b < mesh.boundary_names.size(); ++b)
  {
    std::string &name = mesh.boundary_names[b];
    if (name.starts_with("symmetry")) // a plane of the scene goes before a group
      continue;
    const std::size_t id     = std::stoul(name);
    mesh.boundary_aliases[b] = import.faces.at(id);
    name                     = mesh.boundary_aliases[b].front();
    for (const std::string &alias : mesh.boundary_aliases[b])
      if (id > 0 && (alias == "all" || alias == "rest" || alias.starts_with("symmetry")))
        throw InputError({"", 0, "Bodies/" + body + "/mesh file"},
                         "a group of facets is called \"" + alias + "\", which has a meaning of its own",
                         "another name; planes of symmetry lie at a coordinate 0 and are named in \"symmetry planes\"");
  }
}

#define OGIVE_INSTANTIATE(dim)                                                                 \
  template MeshImport import_mesh<dim>(const input::Body &, dealii::Triangulation<dim> &);     \
  template void name_boundaries<dim>(const MeshImport &, const std::string &, BodyMesh<dim> &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
