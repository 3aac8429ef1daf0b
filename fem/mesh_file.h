// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// What a mesh file holds, before a body takes its part of it.
namespace ogive::fem
{
struct MeshFile
{
  /// A line, quadrilateral or hexahedron; corners in the order that gmsh, Abaqus
  /// and VTK share.
  struct Element
  {
    std::int64_t                 number = 0; ///< as the file counts
    int                          dim    = 0;
    std::array<std::uint32_t, 8> node{};     ///< 2^dim of them, into x
  };
  /// A named set; a physical group of gmsh, an ELSET or SURFACE of Abaqus.
  struct Group
  {
    int                        dim = 0;
    std::string                name;   ///< its number where the file gives no name
    int                        number = 0; ///< of gmsh; 0 for none
    std::vector<std::uint32_t> elements;   ///< into the list of elements
  };

  std::string                               path, format; ///< "gmsh 4.1", "Abaqus"
  std::vector<std::array<double, 3>>        x; ///< m
  std::vector<Element>                      elements;
  std::vector<Group>                        groups;
  /// Elements that have no place in a body: kind ("tetrahedra") to their number.
  std::map<std::string, std::size_t>        others;

  /// Names of the groups of this dimension.
  std::vector<std::string> names(int dim) const;
};

/// Reads .msh (gmsh 2.2, 4.0, 4.1, as text) and .inp (Abaqus). `unit`: m of one
/// unit of the file. Throws InputError with file and line.
MeshFile read_mesh_file(const std::string &path, double unit);
/// Whether read_mesh_file knows the ending of this name.
bool     is_mesh_file(const std::string &path);

MeshFile read_gmsh(const std::string &path);
MeshFile read_abaqus(const std::string &path);

/// Corners of the faces of a hexahedron (6), quadrilateral (4) or line (2),
/// faces numbered as Abaqus does.
std::vector<std::vector<std::uint32_t>> faces_of(const MeshFile::Element &);
} // namespace ogive::fem
