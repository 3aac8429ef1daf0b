// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/contact_geometry.h"
#include "coupling/search.h"
#include "coupling/surfaces.h"

#include <compare>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// Two bodies that may touch, of either kind.
struct ContactSpec
{
  std::string name;
  int         first = 0, second = 0; ///< index into Scene::bodies
  Party       first_party  = mesh_party;
  Party       second_party = mesh_party;
  double      friction  = 0;  ///< Coulomb coefficient
  double      stiffness = .1; ///< share of m_eff/dt^2, <= .1
};

/// Stable name of a contact: survives reordering of particles and sliding from
/// facet to facet.
struct ContactKey
{
  std::int64_t pair  = 0;
  std::int64_t point = 0;  ///< id of the node or particle
  std::int64_t other = -1; ///< id of the other particle, -1: a body's facets

  auto operator<=>(const ContactKey &) const = default;
};

/// A contact that lasts, and what it did in the present step.
template <int dim>
struct ContactRecord
{
  static constexpr int n_others = Surface<dim>::Facet::n_nodes;

  ContactKey key;
  double     stiffness = 0;                  ///< N/m
  double     offset    = 0;                  ///< penetration that counts as none, m
  Point<dim> normal    = Point<dim>::Zero(); ///< unit, pushes the point
  Point<dim> spring    = Point<dim>::Zero(); ///< tangential, m
  Point<dim> slide     = Point<dim>::Zero(); ///< relative motion over the last drift, m
  double     depth     = 0;                  ///< penetration less offset, m, at t_n
  double     tangential_stiffness = 0;       ///< 0 without friction

  std::uint32_t                        point = 0;
  int                                  n     = 0; ///< points that carry the other side
  std::array<std::uint32_t, n_others>  other{};
  std::array<double, n_others>         weight{};
  Point<dim> force          = Point<dim>::Zero(); ///< on the point, N
  Point<dim> point_velocity = Point<dim>::Zero(); ///< at t_{n-1/2}, m/s
  Point<dim> other_velocity = Point<dim>::Zero();
};

/// Geometry of one direction of one contact: points of one body against the
/// facets or particles of another. Holds nothing that a restart would miss.
template <int dim>
class ContactPair
{
public:
  using Facet  = typename Surface<dim>::Facet;
  using Record = ContactRecord<dim>;

  /// `swapped`: the second body's points against the first body's surface.
  ContactPair(const ContactSpec &spec, bool swapped, std::int64_t index);

  const ContactSpec &spec() const { return spec_; }
  std::int64_t       index() const { return index_; }
  int                point_body() const { return point_body_; }
  int                other_body() const { return other_body_; }
  Party              point_party() const { return point_party_; }
  Party              other_party() const { return other_party_; }
  double             share() const { return share_; }
  double             half_spacing() const { return half_spacing_; }

  /// Lengths of the search, from the undeformed bodies.
  void measure(const Faces<dim> &, const std::vector<int> &symmetry_axes);

  /// Brings the candidates up to date; cheap while nothing moved far.
  void update(const Faces<dim> &, const std::vector<int> &symmetry_axes);

  /// Drops the candidates: after a solver went back or was loaded, its numbers
  /// of topology may name another order.
  void forget() { built_ = false; }

  /// Overlapping points by ascending key, with geometry, weights and depth.
  /// `old` (this pair's records, ascending) tell from which side a point came.
  /// `any_side`: take every overlap as it stands, for the start.
  void detect(const Faces<dim> &, std::span<const Record> old, bool any_side,
              std::vector<Record> &found, std::int64_t &lost) const;

private:
  bool stands(const Faces<dim> &, std::size_t query, const Record *old, bool any_side,
              Stand<dim> &) const;
  void nearest(const Faces<dim> &, std::size_t query, const Point<dim> *facing, const Point<dim> *against,
               Stand<dim> &) const;
  void detect_particles(const Faces<dim> &, std::size_t query, std::vector<Record> &found) const;
  std::vector<Point<dim>> all_positions(const Faces<dim> &) const;

  ContactSpec   spec_;
  std::int64_t  index_;
  int           point_body_, other_body_;
  Party         point_party_, other_party_;
  double        share_;
  double        size_         = 0; ///< typical facet edge or particle spacing of the other side, m
  double        max_depth_    = 0;
  double        half_spacing_ = 0;

  std::vector<std::uint32_t> points_, others_; ///< others_: particles, or facet nodes to watch
  std::vector<Facet>         facets_;
  NeighbourList<dim>         list_;
  DisplacementWatch<dim>     watch_;
  std::uint64_t              topology_[2] = {0, 0};
  bool                       built_       = false;
};
} // namespace ogive::coupling
