// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <functional>
#include <vector>

/// Mapped blocks from which the meshes of the shapes are put together. Lengths
/// in m. Cells are in deal.II's (lexicographic) corner order.
namespace ogive::fem::blocks
{
template <int dim>
struct Raw
{
  std::vector<dealii::Point<dim>>    vertices;
  std::vector<dealii::CellData<dim>> cells;

  /// One structured block: map takes the unit cube to space.
  void add(const std::array<unsigned int, dim>                                &n,
           const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &map);
  void append(const Raw &other);
  /// Copy with coordinate `axis` negated, still right-handed.
  Raw mirrored(int axis) const;
  /// Joins vertices closer than `tolerance`.
  void merge(double tolerance);
};

/// Which sign of each coordinate is kept: both or only the positive half.
struct Kept
{
  std::array<bool, 3> negative{true, true, true};
  std::array<bool, 3> positive{true, true, true};
};

/// A piece given in the all-positive octant (quadrant), mirrored into all kept ones.
template <int dim>
Raw<dim> mirror_all(const Raw<dim> &piece, const Kept &, double tolerance);

/// Nodes of [0, 1] such that the cells of a length `length` grow linearly with
/// position from `first` to `last`.
std::vector<double> graded(double length, double first, double last);

/// Quadrant of a disc: square core and rings.
Raw<2> disc_quadrant(double radius, double spacing, double spacing_far);
/// Quadrant of an annulus.
Raw<2> ring_quadrant(double inner, double outer, double spacing, double spacing_far);
/// Octant of a ball: cube core and three caps.
Raw<3> ball_octant(double radius, double spacing);
/// Octant of a spherical shell: three caps.
Raw<3> shell_octant(double inner, double outer, double spacing);

/// Section times levels along the third coordinate.
Raw<3> extrude(const Raw<2> &section, const std::vector<double> &levels);
} // namespace ogive::fem::blocks
