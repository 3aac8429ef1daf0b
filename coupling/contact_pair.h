// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"
#include "coupling/contact_geometry.h"
#include "coupling/particle_field.h"
#include "coupling/fragments.h"
#include "coupling/search.h"
#include "coupling/surfaces.h"

#include <compare>
#include <string>
#include <utility>
#include <vector>

namespace ogive::coupling
{
/// Two bodies that may touch, of either kind; the same body twice: its pieces,
/// and folds of it, touch each other.
struct ContactSpec
{
  std::string name;
  int         first = 0, second = 0; ///< index into Scene::bodies
  Party       first_party  = mesh_party;
  Party       second_party = mesh_party;
  double      friction  = 0;  ///< Coulomb coefficient
  double      stiffness = .1; ///< share of m_eff/dt^2, <= .1
  std::string overlap   = "rest"; ///< at the start, as in a scene: rest, heal or refuse
  /// Of a body of particles that meets itself: below this distance the particle
  /// solver joins them, m, by their places of t = 0 or of now.
  double      joined_within   = 0;
  bool        joined_at_start = false;
  double      first_radius = 0, second_radius = 0; ///< of particles that may come later, m

  bool meets_itself() const { return first == second && first_party == second_party; }
};

/// Stable name of a contact: survives reordering of particles and sliding from
/// facet to facet.
struct ContactKey
{
  std::int64_t pair  = 0;
  std::int64_t point = 0;  ///< id of the node or particle
  std::int64_t other = -1; ///< id of the other particle where two meet as balls

  auto operator<=>(const ContactKey &) const = default;
};

/// A point of the other side that carries a share of a contact.
template <int dim>
struct Carrier
{
  std::uint32_t index = 0;  ///< at the gather
  std::int64_t  id    = 0;
  double        weight = 0; ///< of its velocity and of friction, sum 1
  /// How fast the depth grows as the point comes nearer to this carrier: force
  /// on the point k depth slope, on the carrier minus that.
  Point<dim> slope = Point<dim>::Zero();
  Point<dim> sign  = Point<dim>::Ones(); ///< -1: seen as its image in a symmetry plane
};

/// A contact that lasts, and what it did in the present step.
template <int dim>
struct ContactRecord
{
  ContactKey key;
  double     stiffness = 0;                  ///< N/m
  double     offset    = 0;                  ///< penetration that counts as none, m
  Point<dim> slope     = Point<dim>::Zero(); ///< sum of the carriers', 1 over facets
  Point<dim> normal    = Point<dim>::Zero(); ///< its direction, pushes the point
  Point<dim> spring    = Point<dim>::Zero(); ///< tangential, m
  Point<dim> slide     = Point<dim>::Zero(); ///< relative motion over the last drift, m
  double     depth     = 0;                  ///< penetration less offset, m, at t_n
  double     next      = 0;                  ///< what it should be at t_{n+1}, m
  double     tangential_stiffness = 0;       ///< 0 without friction

  std::uint32_t point = 0;
  std::uint32_t first = 0, last = 0;         ///< carriers of it in ContactList
  Point<dim>    force = Point<dim>::Zero();  ///< on the point, N
  Point<dim>    point_velocity = Point<dim>::Zero(); ///< at t_{n-1/2}, m/s
  double        carrier_power  = 0;          ///< of the forces on the carriers then, W
};

/// Contacts by ascending key, and what carries them.
template <int dim>
struct ContactList
{
  std::vector<ContactRecord<dim>> records;
  std::vector<Carrier<dim>>       carriers;

  std::span<const Carrier<dim>> of(const ContactRecord<dim> &r) const
  {
    return {carriers.data() + r.first, r.last - r.first};
  }
  void clear()
  {
    records.clear();
    carriers.clear();
  }
};

/// How the points of one body meet another body.
enum class Meeting
{
  surface, ///< its facets, or the field of its particles
  balls    ///< its particles one by one, as balls of ball_share their radius
};

/// Lone particles and thin jets hardly show in the field of their body: what
/// comes closer than this share of the sum of radii meets them as balls. Less
/// than 1, so that a lattice pressed by less than .3 of its spacing has no
/// cobbles.
inline constexpr double ball_share = .7;

/// Bodies drawn flush differ by rounding of their coordinates: by less than this
/// share of half a spacing.
inline constexpr double flush_share = 1e-6;

/// Geometry of one direction of one contact: points of one body against the
/// facets or particles of another. Holds nothing that a restart would miss.
template <int dim>
class ContactPair
{
public:
  using Facet  = typename Surface<dim>::Facet;
  using Record = ContactRecord<dim>;
  using List   = ContactList<dim>;

  /// `swapped`: the second body's points against the first body's surface.
  ContactPair(const ContactSpec &spec, bool swapped, Meeting, std::int64_t index);

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

  /// Brings the candidates up to date; cheap while nothing moved far. `pieces`:
  /// of a body of particles that meets itself.
  void update(const Faces<dim> &, const std::vector<int> &symmetry_axes, const Fragments<dim> *pieces = nullptr);

  /// Lets the ranks share the points: each seeks and detects for its own, a run of
  /// ids cut so that all have as many candidates to look at, counted in the search
  /// before. All ranks see the same faces.
  void share_points(const Ranks &ranks) { ranks_ = ranks; }
  /// Which particles this pair asks for, of a side that is particles.
  std::vector<Attention> attention() const;

  /// Drops the candidates: after a solver went back or was loaded, its numbers
  /// of topology may name another order.
  void forget() { built_ = false; }

  /// Overlapping points by ascending key, with geometry, weights and depth.
  /// `old` (this pair's records, ascending) tell from which side a point came.
  /// `last_drift`: length of the step that led here, s.
  void detect(const Faces<dim> &, std::span<const Record> old, double last_drift,
              List &found, std::int64_t &lost) const;
  /// Every overlap as it stands, for the start.
  void detect_overlaps(const Faces<dim> &, List &found) const;
  /// 1/m_eff of a contact found now, 1/kg.
  double inverse_mass(const Faces<dim> &, const List &, const Record &) const;

  /// The same by the crowd: with every point of a closed layer in contact, the row
  /// of a carrier in M^-1 K is at most 2 k times this, 1/kg.
  double crowded_inverse_mass(const Faces<dim> &, const List &, const Record &) const;

private:
  /// The nearest of the candidate facets whose feet `accept` lets pass.
  template <class Accept>
  Stand<dim> nearest(const Faces<dim> &, std::size_t query, const Accept &accept) const;
  /// As the bodies stand, without a past.
  Stand<dim> anywhere(const Faces<dim> &, std::size_t query) const;
  Stand<dim> lasting(const Faces<dim> &, std::size_t query, const Point<dim> &last_normal) const;
  /// For a node: the nearest facet that does not look the same way as the node's
  /// own surface, also a little past the rim of that facet's face.
  Stand<dim> facing(const Faces<dim> &, std::size_t query, const Stand<dim> &nearest_one, const Point<dim> &own,
                    const Point<dim> *last_normal) const;
  /// Corners of a facet of the other side.
  std::array<Point<dim>, Facet::n_nodes> corners(const Faces<dim> &, std::uint32_t facet) const;
  Stand<dim> entering(const Faces<dim> &, std::size_t query, double last_drift) const;
  /// Speed at which the point goes through the facet, inwards, m/s.
  double approach(const Faces<dim> &, std::size_t query, const Foot<dim> &, const Facet &) const;
  void add_facet(const Faces<dim> &, std::size_t query, const Stand<dim> &, List &found) const;
  void detect_balls(const Faces<dim> &, std::size_t query, List &found) const;
  /// The point in the field of the other side's particles.
  void detect_particles(const Faces<dim> &, std::size_t query, List &found) const;
  /// Outward unit normal of the points' own surface at a node; zero for particles
  /// and for nodes without facets.
  Point<dim> own_normal(const Faces<dim> &, std::size_t query) const;
  /// The body's own facets that a node cannot meet: those of its own elements and
  /// of their neighbours, as far as the surface tells.
  std::vector<std::uint32_t> own_neighbours(std::size_t query) const;
  void drop_joined(const Faces<dim> &, const Fragments<dim> *);
  Stand<dim> entering_itself(const Faces<dim> &, std::size_t query, double last_drift) const;
  /// The facets that a lone point can have come through in the last step.
  template <class Accept>
  Stand<dim> crossed(const Faces<dim> &, std::size_t query, double last_drift, const Accept &) const;
  /// What depends on the radii, which come with the first particles of a body.
  void size_up(const Faces<dim> &);
  /// The balls about the candidate facets as they are now.
  void refit(const Faces<dim> &);
  void renew(const Faces<dim> &, const std::vector<int> &symmetry_axes);
  void search(const Faces<dim> &, std::vector<Point<dim>> positions, const Fragments<dim> *);
  void list_own_facets(const Faces<dim> &, const std::vector<int> &symmetry_axes);
  std::vector<Point<dim>> all_positions(const Faces<dim> &) const;
  /// How far from a point of `points_` something may touch it, m.
  double search_reach() const;
  /// First and past the last of the points that are this rank's.
  std::pair<std::size_t, std::size_t> own_points(const Faces<dim> &) const;
  void                                count_work(const Faces<dim> &, std::pair<std::size_t, std::size_t> own);

  ContactSpec   spec_;
  Meeting       meeting_;
  std::int64_t  index_;
  int           point_body_, other_body_;
  Party         point_party_, other_party_;
  double        share_;
  double        facet_size_   = 0; ///< mean edge of the other side's facets, m
  double        finest_       = 0; ///< least of them, m
  double        own_finest_   = 0; ///< of the points' side where they are nodes, m
  double        apart_        = 0; ///< least distance of the points in a closed layer, m; 0: a lone one
  double        size_         = 0; ///< typical facet edge or particle spacing of the other side, m
  double        max_depth_    = 0;
  double        half_spacing_ = 0;
  double        rim_          = 0; ///< how far past its rim a face still carries a node, m
  ParticleField<dim> field_; ///< where the other side is particles

  std::vector<std::uint32_t> points_, others_; ///< others_: particles, or facet nodes to watch
  std::vector<Facet>         facets_;
  std::vector<int>           symmetry_axes_;
  std::vector<Facet>         own_facets_; ///< of the points' side, where they are nodes
  std::vector<std::size_t>   own_first_;  ///< point q: own_[own_first_[q] .. own_first_[q + 1])
  std::vector<std::uint32_t> own_;        ///< into own_facets_
  /// Of a body that meets itself: node and facet, element and facet, ascending.
  using Meetings = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Meetings                   facets_at_, facets_of_;
  struct Ball
  {
    Point<dim> middle = Point<dim>::Zero();
    double     reach  = 0;
  };
  NeighbourList<dim>         list_;
  std::vector<std::uint32_t> listed_; ///< facets in it
  std::vector<Ball>          balls_;  ///< about the listed facets
  DisplacementWatch<dim>     watch_;
  // A point farther than it and the other side can have moved since needs no
  // look: safe_ is the travel at which it does.
  DisplacementWatch<dim>     last_step_;
  mutable std::vector<double> safe_;
  double                     travel_      = 0;
  std::uint64_t              topology_[2] = {0, 0};
  std::int64_t               pieces_      = -1; ///< their version
  Ranks                      ranks_;
  std::vector<std::pair<std::int64_t, double>> work_; ///< id of a point, its candidates in the last search
  bool                       built_       = false;
};
} // namespace ogive::coupling
