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
  std::int64_t point = 0; ///< id of the node or particle

  auto operator<=>(const ContactKey &) const = default;
};

/// A contact that lasts, and what it did in the present step.
template <int dim>
struct ContactRecord
{
  /// Points that can carry the other side: corners of a facet, or the
  /// particles of a surface around the place.
  static constexpr int n_others = dim == 3 ? 16 : dim == 2 ? 6 : 2;

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
  std::array<std::uint32_t, n_others>  other{};   ///< indices at the gather
  std::array<std::int64_t, n_others>   other_id{};
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
  /// `last_drift`: length of the step that led here, s.
  void detect(const Faces<dim> &, std::span<const Record> old, double last_drift,
              std::vector<Record> &found, std::int64_t &lost) const;
  /// Every overlap as it stands, for the start.
  void detect_overlaps(const Faces<dim> &, std::vector<Record> &found) const;

private:
  /// The nearest of the candidate facets whose feet `accept` lets pass.
  template <class Accept>
  Stand<dim> nearest(const Faces<dim> &, std::size_t query, const Accept &accept) const;
  Stand<dim> lasting(const Faces<dim> &, std::size_t query, const Point<dim> &last_normal) const;
  Stand<dim> entering(const Faces<dim> &, std::size_t query, double last_drift) const;
  /// Speed at which the point goes through the facet, inwards, m/s.
  double approach(const Faces<dim> &, std::size_t query, const Foot<dim> &, const Facet &) const;
  Record facet_record(const Faces<dim> &, std::size_t query, const Stand<dim> &) const;
  /// The point against the surface that the other side's particles span.
  void detect_particles(const Faces<dim> &, std::size_t query, std::vector<Record> &found) const;
  /// Outward unit normal of the points' own surface at a node; zero for a particle.
  Point<dim> own_normal(const Faces<dim> &, std::size_t query) const;
  void list_own_facets(const Faces<dim> &, const std::vector<int> &symmetry_axes);
  std::vector<Point<dim>> all_positions(const Faces<dim> &) const;
  /// Farthest that a point and a place of the other side came together since
  /// `last_positions_`, m.
  double motion(std::span<const Point<dim>> positions) const;

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
  std::vector<Facet>         own_facets_; ///< of the points' side, where they are nodes
  std::vector<std::size_t>   own_first_;  ///< point q: own_[own_first_[q] .. own_first_[q + 1])
  std::vector<std::uint32_t> own_;        ///< into own_facets_
  NeighbourList<dim>         list_;
  DisplacementWatch<dim>     watch_;
  // A point farther than it and the other side can have moved since needs no
  // look: safe_ is the travel at which it does.
  std::vector<Point<dim>>    last_positions_;
  mutable std::vector<double> safe_;
  double                     travel_      = 0;
  std::uint64_t              topology_[2] = {0, 0};
  bool                       built_       = false;
};
} // namespace ogive::coupling
