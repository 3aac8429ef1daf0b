// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_pair.h"

#include <algorithm>

/// Where a node or particle stands against the facets of the other body.
namespace ogive::coupling
{
namespace
{
// Facets turned by more than about 115 degrees from a contact's last normal
// belong to the far side of the body.
constexpr double same_side = -.43;
// A point keeps to the facets within 60 degrees of its last normal ...
constexpr double same_face = .5;
// ... while it is straight behind them, within 26 degrees.
constexpr double straight = .9;
// A face that looks the same way as a node's own surface, within about 70
// degrees, is none that the node can have come through: the side of a body
// drawn flush, the far side of a thin one.
constexpr double alike = .3;
} // namespace

template <int dim>
auto ContactPair<dim>::corners(const Faces<dim> &faces, std::uint32_t facet) const
  -> std::array<Point<dim>, Facet::n_nodes>
{
  std::array<Point<dim>, Facet::n_nodes> corner;
  for (int k = 0; k < Facet::n_nodes; ++k)
    corner[k] = faces.position(other_party_, facets_[facet].node[k]);
  return corner;
}

template <int dim>
template <class Accept>
Stand<dim> ContactPair<dim>::nearest(const Faces<dim> &faces, std::size_t query, const Accept &accept) const
{
  const Point<dim> p   = faces.position(point_party_, points_[query]);
  const auto       row = list_.of(query);
  Stand<dim>       stand;
  // The likeliest one first: the others are then mostly too far for a closer look.
  std::size_t first = 0;
  double      least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < row.size(); ++k)
    if (const double square = (p - balls_[row[k]].middle).squaredNorm(); square < least)
    {
      least = square;
      first = k;
    }
  double reach = std::numeric_limits<double>::infinity(); // of the best, with room for equally near ones
  for (std::size_t n = 0; n < row.size(); ++n)
  {
    const std::uint32_t f    = row[n == 0 ? first : n <= first ? n - 1 : n];
    const double        most = reach + balls_[f].reach;
    if ((p - balls_[f].middle).squaredNorm() > most * most)
      continue;
    const Foot<dim> foot = foot_on_facet<dim>(p, corners(faces, f), facets_[f].outward);
    if (accept(foot, facets_[f]) && (!stand.found || better_foot<dim>(p, foot, stand.foot)))
    {
      stand.found = true;
      stand.facet = f;
      stand.foot  = foot;
      reach       = 1.0001 * std::sqrt(foot.distance2);
    }
  }
  if (stand.found && facets_[stand.facet].bared)
    return {}; // a seam: on its other side are particles of the body
  if (stand.found)
    finish_stand(p, half_spacing_, stand);
  return stand;
}

// The tree of boxes stands until points may have left its margins. Its leaves
// follow them: a ball about each facet that is anyone's candidate.
template <int dim>
void ContactPair<dim>::refit(const Faces<dim> &faces)
{
  for (const std::uint32_t f : listed_)
  {
    const auto corner = corners(faces, f);
    Ball       ball;
    for (const auto &c : corner)
      ball.middle += c / Facet::n_nodes;
    for (const auto &c : corner)
      ball.reach = std::max(ball.reach, (c - ball.middle).squaredNorm());
    ball.reach = std::sqrt(ball.reach);
    balls_[f]  = ball;
  }
}

template <int dim>
double ContactPair<dim>::approach(const Faces<dim> &faces, std::size_t query, const Foot<dim> &foot,
                                  const Facet &facet) const
{
  Point<dim> velocity = faces.velocity(point_party_, points_[query]);
  for (int k = 0; k < Facet::n_nodes; ++k)
    velocity -= foot.weight[k] * faces.velocity(other_party_, facet.node[k]);
  return -velocity.dot(foot.normal);
}

template <int dim>
Point<dim> ContactPair<dim>::own_normal(const Faces<dim> &faces, std::size_t query) const
{
  Point<dim> sum = Point<dim>::Zero();
  for (std::size_t k = own_first_[query]; k < own_first_[query + 1]; ++k)
    sum += facet_area<dim>(faces, point_party_, own_facets_[own_[k]]);
  const double length = sum.norm();
  return length > 0 ? Point<dim>(sum / length) : sum;
}

// Two equal bodies that meet rim on rim bulge alike, and their rim nodes would
// fall in and out of each other at full depth. So a face goes on past its rim,
// as its plane: with d the depth behind it and s how far the node is outside of
// the side, the spring is stretched by d (1 - s^2/rim^2), which is continuous
// wherever the node comes in or goes out, and a potential.
template <int dim>
Stand<dim> ContactPair<dim>::facing(const Faces<dim> &faces, std::size_t query, const Stand<dim> &nearest_one,
                                    const Point<dim> &own, const Point<dim> *last_normal) const
{
  const bool inside = nearest_one.distance < flush_share * half_spacing_;
  if (nearest_one.foot.normal.dot(own) <= alike || (!inside && nearest_one.distance >= rim_))
    return nearest_one;
  Stand<dim> face = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &) {
    return foot.normal.dot(own) <= alike && (!last_normal || foot.normal.dot(*last_normal) >= same_side);
  });
  if (!face.found)
    return nearest_one;
  const auto &a = facets_[face.facet].node, &b = facets_[nearest_one.facet].node;
  const bool  rim = rim_ > 0 && face.foot.normal.dot(own) < -alike &&
                   std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  if (!rim)
    return inside ? face : nearest_one;
  const Point<dim> p = faces.position(point_party_, points_[query]);
  draw_on<dim>(p, corners(faces, face.facet), face.foot);
  face.direction = face.foot.normal;
  face.distance  = (p - face.foot.where).dot(face.foot.normal);
  if (!inside)
  {
    face.overhang   = nearest_one.distance;
    face.side_facet = nearest_one.facet;
    face.side       = nearest_one.foot;
    face.aside      = nearest_one.direction;
  }
  return face;
}

template <int dim>
Stand<dim> ContactPair<dim>::anywhere(const Faces<dim> &faces, std::size_t query) const
{
  const Stand<dim> stand = nearest(faces, query, [](const Foot<dim> &, const Facet &) { return true; });
  return stand.found && rim_ > 0 ? facing(faces, query, stand, own_normal(faces, query), nullptr) : stand;
}

template <int dim>
Stand<dim> ContactPair<dim>::lasting(const Faces<dim> &faces, std::size_t query,
                                     const Point<dim> &last_normal) const
{
  const Stand<dim> stand = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &) {
    return foot.normal.dot(last_normal) >= same_side;
  });
  if (!stand.found || stand.distance >= std::max(rim_, flush_share * half_spacing_))
    return stand;
  const Point<dim> own = own_normal(faces, query);
  if (!own.isZero() && !spec_.meets_itself())
    return facing(faces, query, stand, own, &last_normal);
  if (stand.distance >= flush_share * half_spacing_)
    return stand;
  // A lone point has no side of its own. Inside, near an edge, it keeps to the
  // face that it came through.
  const Point<dim> p    = faces.position(point_party_, points_[query]);
  const Stand<dim> same = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &) {
    return foot.normal.dot(last_normal) >= same_face &&
           (foot.where - p).dot(foot.normal) >= straight * std::sqrt(foot.distance2);
  });
  return same.found ? same : stand;
}

template <int dim>
Stand<dim> ContactPair<dim>::entering(const Faces<dim> &faces, std::size_t query, double last_drift) const
{
  const double     tolerance = flush_share * half_spacing_;
  const double     r         = faces.radius(point_party_, points_[query]);
  const Stand<dim> stand = nearest(faces, query, [](const Foot<dim> &, const Facet &) { return true; });
  if (!stand.found || stand.distance >= std::max({r, rim_, tolerance}) || (stand.distance >= 0 && r > 0))
    return stand;
  const Point<dim> own = own_normal(faces, query);
  if (!own.isZero())
    return facing(faces, query, stand, own, nullptr);
  if (stand.distance >= tolerance)
    return stand;

  // A lone point that is suddenly inside came through a facet during the last
  // step; near an edge, or in a thin body, that need not be the nearest one.
  const Stand<dim> through = crossed(faces, query, last_drift, [](const Foot<dim> &) { return true; });
  if (through.found || stand.distance >= 0)
    return through;
  return nearest(faces, query, [&](const Foot<dim> &foot, const Facet &facet) {
    return approach(faces, query, foot, facet) > 0;
  });
}

template <int dim>
template <class Accept>
Stand<dim> ContactPair<dim>::crossed(const Faces<dim> &faces, std::size_t query, double last_drift,
                                     const Accept &accept) const
{
  const double     tolerance = flush_share * half_spacing_;
  const Point<dim> p         = faces.position(point_party_, points_[query]);
  return nearest(faces, query, [&](const Foot<dim> &foot, const Facet &facet) {
    const double depth = (foot.where - p).dot(foot.normal);
    return depth > 0 && depth >= straight * std::sqrt(foot.distance2) && accept(foot) &&
           depth <= 1.001 * last_drift * approach(faces, query, foot, facet) + tolerance;
  });
}

// A node is behind facets of its own body all the time, those of the far side:
// it touches only what it came through in the last step.
template <int dim>
Stand<dim> ContactPair<dim>::entering_itself(const Faces<dim> &faces, std::size_t query, double last_drift) const
{
  const double     tolerance = flush_share * half_spacing_;
  const Point<dim> p         = faces.position(point_party_, points_[query]);
  double           clear     = std::numeric_limits<double>::infinity();
  for (const std::uint32_t f : list_.of(query))
    clear = std::min(clear, (p - balls_[f].middle).norm() - balls_[f].reach);
  if (clear > 2 * tolerance) // most nodes: outside of all balls
  {
    safe_[query] = travel_ + clear - 2 * tolerance;
    return {};
  }
  const Stand<dim> stand = nearest(faces, query, [](const Foot<dim> &, const Facet &) { return true; });
  safe_[query] = stand.found ? travel_ + std::abs(stand.distance) - 2 * tolerance : 0;
  if (!stand.found)
    return stand;
  const Point<dim> own = own_normal(faces, query);
  return crossed(faces, query, last_drift, [&](const Foot<dim> &foot) { return foot.normal.dot(own) <= alike; });
}

template class ContactPair<1>;
template class ContactPair<2>;
template class ContactPair<3>;
} // namespace ogive::coupling
