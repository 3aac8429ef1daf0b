// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"
#include "fem/departure.h"
#include "sph/newcomers.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// What some elements or particles hold, SI, as the books count it: in axial
/// symmetry the radial momenta of a ring cancel and there is no angular momentum.
struct ConversionSums
{
  double mass = 0;
  Vec3   momentum = Vec3::Zero(), angular_momentum = Vec3::Zero(); ///< about the origin
  double kinetic = 0, internal = 0, plastic_work = 0;              ///< J
  double damage = 0, temperature = 0;                              ///< means by mass: -, K
};

/// One connected cluster of elements that turned into particles at once: a row
/// of conversions.csv.
struct ConversionEvent
{
  double         step = 0, time = 0; ///< -, s
  double         body = 0;           ///< index into Scene::bodies
  double         elements = 0, particles = 0;
  ConversionSums before, after;
  double         hourglass = 0; ///< energy that the patterns of the elements held, J
  double         heat      = 0; ///< kinetic before - after, plus hourglass: J
  double         turn      = 0; ///< angular velocity that repairs the angular momentum, rad/s

  /// "mass_before [kg]" ..., and values in their order.
  static std::vector<std::string> columns();
  std::vector<double>             values() const;
};

/// Particles along each edge of an element, in the order of its local axes.
template <int dim>
using Lattice = std::array<int, dim>;

/// As many along each edge of the undeformed element that they stand about
/// `spacing` (m) apart, at least one.
template <int dim>
Lattice<dim> lattice_of(const fem::Departure<dim> &, double spacing);

/// Adds the particles of one element at xi_k = (2k - 1)/n - 1: positions and
/// velocities by the shape functions, the mass that left the nodes in shares of
/// det J (of r det J in axial symmetry), state of its material point `from[e]`.
template <int dim>
void add_particles(const fem::Departure<dim> &, const Lattice<dim> &, materials::Points &from, std::size_t e,
                   bool axisymmetric, sph::Newcomers<dim> &to);

/// Gives particles [first, last) the momentum of the nodes' shares by one
/// velocity and, but in axial symmetry, their angular momentum by one turn
/// about the centre of mass. Where they cannot turn (all on a line or at a
/// point) a part of the angular momentum stays lost. Returns the turn, rad/s.
template <int dim>
double repair_momenta(const ConversionSums &nodes, bool axisymmetric, sph::Newcomers<dim> &, std::size_t first);

/// Least ratio over all axes of the moments of inertia that the particles and
/// the corners of the elements have about the centre of mass; 1 in axial
/// symmetry and in one dimension.
template <int dim>
double inertia_ratio(std::span<const fem::Departure<dim>>, double spacing, bool axisymmetric);

template <int dim>
ConversionSums sums_of(std::span<const fem::Departure<dim>>, const materials::Points &, bool axisymmetric);
template <int dim>
ConversionSums sums_of(const sph::Newcomers<dim> &, std::size_t first, bool axisymmetric);
} // namespace ogive::coupling
