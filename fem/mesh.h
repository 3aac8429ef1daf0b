// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "core/materials/material.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ogive::fem
{
/// A body's mesh reduced to arrays, SI. Cells and facets name nodes of this
/// mesh, counted from 0.
template <int dim>
struct BodyMesh
{
  static constexpr int corners = 1 << dim;

  struct Facet
  {
    static constexpr int                 n_nodes = dim == 3 ? 4 : dim;
    std::array<std::uint32_t, n_nodes>   node{};     ///< outward, as in core/base/surface.h
    std::uint32_t                        cell     = 0;
    int                                  boundary = 0; ///< index into boundary_names
    double                               outward  = 1; ///< 1-D: sign of the outward normal
    /// What a uniform load gives each corner, over an even share: the weights of
    /// the points of a spectral face.
    std::array<double, n_nodes>          weight   = even();

    static constexpr std::array<double, n_nodes> even()
    {
      std::array<double, n_nodes> w{};
      for (double &one : w)
        one = 1;
      return w;
    }
  };

  /// A node that stays in the middle of `n` others of this mesh: of an edge (2)
  /// or a face (4) of a coarser neighbour.
  struct Hanging
  {
    std::uint32_t                node = 0;
    std::size_t                  n    = 0;
    std::array<std::uint32_t, 4> master{};
  };

  int                                        body = -1; ///< index into the scene's bodies
  std::shared_ptr<const materials::Material> material;
  input::Erosion                             erosion;
  bool                                       converts = false; ///< its elements may turn into particles,
  input::Conversion                          conversion;       ///< by this
  bool                                       axisymmetric = false; ///< dim 2: x = r, y = axis
  std::array<std::vector<double>, dim>       x;  ///< m
  std::array<std::vector<double>, dim>       v;  ///< initial velocity, m/s
  std::vector<std::uint32_t>                 cells;  ///< corners per cell, VTK order
  std::string                                element = "one-point"; ///< formulation, as in a scene
  int                                        degree  = 1; ///< > 1: spectral, its cells lie between its nodes
  std::vector<std::uint32_t>                 elements; ///< degree > 1: nodes of each, x fastest
  std::vector<Facet>                         facets; ///< all of the boundary
  std::vector<Hanging>                       hanging;
  std::vector<std::string>                   boundary_names; ///< "x-" .. "z+"; "bottom", "top", "side", "inner", "outer"; groups of a mesh file
  /// All words for the facets of a boundary: facets of a mesh file may be in
  /// several groups, and a group has a name and a number. Empty: the name alone.
  std::vector<std::vector<std::string>>      boundary_aliases;
  std::vector<std::int64_t>                  file_numbers; ///< of the elements, as their mesh file counts; else empty
  std::vector<std::string>                   notes;        ///< what the reader of a mesh file has to say

  /// Whether the facets of boundary b are what a scene calls `face`.
  bool is_called(int b, const std::string &face) const;

  bool loses_elements() const { return erosion.on || converts; }
  std::size_t n_nodes() const { return x[0].size(); }
  std::size_t n_cells() const { return cells.size() / corners; }
  std::size_t n_elements() const
  {
    std::size_t cells_of = 1;
    for (int i = 0; i < dim; ++i)
      cells_of *= degree;
    return n_cells() / cells_of;
  }
  /// Of the mesh, which is inscribed in a round body: m^3, m^2 (per metre), m,
  /// or the m^3 of the whole ring.
  double volume() const;
};

/// Builds the mesh of one body of the scene: the shape in the scene's dimension
/// and symmetry (only the kept side of symmetry planes), element edges near
/// Body::spacing, boundary names, initial velocities. Throws InputError for a
/// shape that the dimension lacks, a mesh file that cannot be read, elements
/// cut by a symmetry plane, or a Jacobian <= 0.
template <int dim>
BodyMesh<dim> make_mesh(const input::Body &, const input::Scene &, int body_index,
                        std::shared_ptr<const materials::Material>);

/// Moves hanging nodes to the middle of their masters.
template <int dim>
void straighten(BodyMesh<dim> &);

/// Throws InputError naming the first cell whose map is not invertible at a
/// corner (or, in axial symmetry, that reaches r < 0).
template <int dim>
void check_quality(const BodyMesh<dim> &, const std::string &body_name);
} // namespace ogive::fem
