// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/interface.h"

#include <vector>

namespace ogive::coupling
{
/// A place in a mesh where a particle rides, see sph::Solver::set_riders.
template <int dim>
struct RiderPlace
{
  std::uint32_t  element = 0;
  Embedding<dim> host;
  Point<dim>     where  = Point<dim>::Zero(); ///< m
  double         volume = 0;                  ///< m^dim; of the whole ring in axial symmetry, m^3
};

/// What the search for riders knows.
template <int dim>
struct SeamView
{
  using Facet = typename Surface<dim>::Facet;

  const InterfaceSpec         &spec;
  const Faces<dim>            &faces;
  typename MeshPort<dim>::Cells cells; ///< of the mesh body
  std::vector<Facet>            seam;  ///< its facets at the seam
  std::array<double, dim>       cell{}; ///< of the particles' lattice, m
  double                        depth = 0; ///< how far riders go into the mesh, m
};

/// Facets of the mesh body at the seam: those with a particle of the other body
/// in front of them, not aside, within its spacing; of one converting body those
/// that came to light as elements left.
template <int dim>
std::vector<typename Surface<dim>::Facet> seam_facets(const InterfaceSpec &, const Faces<dim> &, double spacing);

/// Goes on with the lattice of the particles into the mesh: whole cells at its
/// free sites. InputError where the particles stand on no lattice.
template <int dim>
std::vector<RiderPlace<dim>> continue_lattice(const SeamView<dim> &, const MeshPort<dim> &);

/// The places where the elements near the seam would put their particles when
/// they convert: xi_k = (2k - 1)/n - 1, `per_edge` an edge, each with the volume
/// that the map of the element gives it.
template <int dim>
std::vector<RiderPlace<dim>> places_in_cells(const SeamView<dim> &);

/// Corner weights of a cell at xi, and volume of the reference cell there.
template <int dim>
double place_in_cell(const std::array<Point<dim>, (1 << dim)> &corner, const Point<dim> &xi,
                     std::array<double, (1 << dim)> &weight);
} // namespace ogive::coupling
