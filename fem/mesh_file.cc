// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_file.h"

#include <algorithm>
#include <filesystem>

namespace ogive::fem
{
std::vector<std::string> MeshFile::names(int dim) const
{
  std::vector<std::string> all;
  for (const Group &g : groups)
    if (g.dim == dim)
      all.push_back(g.name);
  return all;
}

bool is_mesh_file(const std::string &path)
{
  return path.ends_with(".msh") || path.ends_with(".inp");
}

MeshFile read_mesh_file(const std::string &path, double unit)
{
  MeshFile mesh = path.ends_with(".inp") ? read_abaqus(path) : read_gmsh(path);
  mesh.path     = path;
  for (auto &x : mesh.x)
    for (double &component : x)
      component *= unit;
  return mesh;
}

std::vector<std::vector<std::uint32_t>> faces_of(const MeshFile::Element &e)
{
  static const std::vector<std::vector<int>> corners[4] = {
    {},
    {{0}, {1}},
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
    {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto &face : corners[e.dim])
  {
    faces.emplace_back();
    for (const int corner : face)
      faces.back().push_back(e.node[corner]);
  }
  return faces;
}
} // namespace ogive::fem
