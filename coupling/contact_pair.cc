// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_pair.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
// Share of a facet by which points may move before the candidates are sought
// anew: small enough for short lists, large enough for some ten steps.
constexpr double skin_share = .25;
// Depth, in facets, at which a contact is given up.
constexpr double deepest = 2;
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
// Bodies drawn flush differ by rounding of their coordinates.
constexpr double flush = 1e-6;

template <int dim>
double largest_radius(const Faces<dim> &faces, int party, const std::vector<std::uint32_t> &points)
{
  double r = 0;
  for (const std::uint32_t i : points)
    r = std::max(r, faces.radius(party, i));
  return r;
}
} // namespace

template <int dim>
ContactPair<dim>::ContactPair(const ContactSpec &spec, bool swapped, Meeting meeting, std::int64_t index)
  : spec_(spec)
  , meeting_(meeting)
  , index_(index)
  , point_body_(swapped ? spec.second : spec.first)
  , other_body_(swapped ? spec.first : spec.second)
  , point_party_(swapped ? spec.second_party : spec.first_party)
  , other_party_(swapped ? spec.first_party : spec.second_party)
  , share_(spec.stiffness)
{
  if (point_party_ == other_party_ && meeting == Meeting::surface)
    share_ *= .5;
}

template <int dim>
void ContactPair<dim>::measure(const Faces<dim> &faces, const std::vector<int> &symmetry_axes)
{
  const double point_size =
    2 * largest_radius(faces, point_party_, contact_points(faces[point_party_], point_body_));
  if (other_party_ == particle_party)
  {
    size_ = 2 * largest_radius(faces, other_party_, contact_points(faces[other_party_], other_body_));
    if (size_ > 0)
      field_ = ParticleField<dim>(.5 * (point_size + size_), size_);
  }
  else
  {
    const auto &surface = faces[other_party_];
    const auto  facets  = true_facets(surface, other_body_, symmetry_axes);
    Box<dim>    box;
    for (const auto &facet : facets)
    {
      size_ += facet_size(surface, facet) / static_cast<double>(facets.size());
      for (const std::uint32_t i : facet.node)
        box.include(faces.position(other_party_, i));
    }
    // In one dimension a facet has no edge: the body's length serves. One end
    // alone (the other tied or on a symmetry plane) has nothing behind it.
    if (dim == 1)
      size_ = facets.size() > 1 ? .25 * (box.upper - box.lower)[0] : std::numeric_limits<double>::infinity();
  }
  if (dim > 1 || other_party_ == particle_party)
    size_ = std::max(size_, point_size);
  max_depth_    = deepest * size_;
  half_spacing_ = .5 * (point_size > 0 ? std::min(point_size, size_) : size_);
  // Nothing to measure by: a lone end point, met by nodes. It has one side.
  if (!std::isfinite(half_spacing_))
    half_spacing_ = 0;
}

template <int dim>
std::vector<Point<dim>> ContactPair<dim>::all_positions(const Faces<dim> &faces) const
{
  std::vector<Point<dim>> positions;
  positions.reserve(points_.size() + others_.size());
  for (const std::uint32_t i : points_)
    positions.push_back(faces.position(point_party_, i));
  for (const std::uint32_t i : others_)
    positions.push_back(faces.position(other_party_, i));
  return positions;
}

template <int dim>
void ContactPair<dim>::update(const Faces<dim> &faces, const std::vector<int> &symmetry_axes)
{
  symmetry_axes_.clear();
  std::copy_if(symmetry_axes.begin(), symmetry_axes.end(), std::back_inserter(symmetry_axes_),
               [](int axis) { return axis < dim; });
  const bool moved_house = !built_ || topology_[0] != faces[0].topology || topology_[1] != faces[1].topology;
  if (moved_house)
  {
    points_ = contact_points(faces[point_party_], point_body_);
    if (other_party_ == particle_party)
      others_ = body_points(faces[other_party_], other_body_);
    else
    {
      facets_ = true_facets(faces[other_party_], other_body_, symmetry_axes);
      others_.clear();
      for (const auto &facet : facets_)
        others_.insert(others_.end(), facet.node.begin(), facet.node.end());
      std::sort(others_.begin(), others_.end());
      others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    }
    list_own_facets(faces, symmetry_axes);
    topology_[0] = faces[0].topology;
    topology_[1] = faces[1].topology;
    built_       = true;
  }
  auto         positions = all_positions(faces);
  const double skin      = skin_share * size_;
  if (!moved_house && !watch_.exceeded(positions, skin))
  {
    travel_ += motion(positions);
    last_positions_ = std::move(positions);
    return;
  }
  travel_ = 0;
  safe_.assign(points_.size(), 0);

  // Both sides may have moved by the skin before the next search.
  std::vector<Box<dim>> queries(points_.size()), targets;
  for (std::size_t q = 0; q < points_.size(); ++q)
  {
    const double reach = other_party_ == mesh_party     ? faces.radius(point_party_, points_[q]) + max_depth_ :
                         meeting_ == Meeting::balls ? ball_share * size_ :
                                                      field_.reach();
    queries[q].include(positions[q]);
    queries[q].inflate(reach + 2 * skin);
  }
  if (other_party_ == particle_party)
    for (const std::uint32_t i : others_)
      targets.emplace_back().include(faces.position(other_party_, i));
  else
    for (const auto &facet : facets_)
    {
      targets.emplace_back();
      for (const std::uint32_t i : facet.node)
        targets.back().include(faces.position(other_party_, i));
    }
  list_.build(queries, targets);
  last_positions_ = positions;
  watch_.set(std::move(positions));
}

template <int dim>
void ContactPair<dim>::list_own_facets(const Faces<dim> &faces, const std::vector<int> &symmetry_axes)
{
  own_facets_.clear();
  if (point_party_ == mesh_party)
    own_facets_ = true_facets(faces[point_party_], point_body_, symmetry_axes);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings; // node, facet
  for (std::size_t f = 0; f < own_facets_.size(); ++f)
    for (const std::uint32_t i : own_facets_[f].node)
      meetings.emplace_back(i, static_cast<std::uint32_t>(f));
  std::sort(meetings.begin(), meetings.end());
  own_.clear();
  own_first_.assign(1, 0);
  for (const std::uint32_t i : points_)
  {
    auto meeting = std::lower_bound(meetings.begin(), meetings.end(), std::pair(i, 0u));
    for (; meeting != meetings.end() && meeting->first == i; ++meeting)
      own_.push_back(meeting->second);
    own_first_.push_back(own_.size());
  }
}

template <int dim>
double ContactPair<dim>::motion(std::span<const Point<dim>> positions) const
{
  double farthest[2] = {0, 0};
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    double &side = farthest[i >= points_.size()];
    side         = std::max(side, (positions[i] - last_positions_[i]).squaredNorm());
  }
  return std::sqrt(farthest[0]) + std::sqrt(farthest[1]);
}

template <int dim>
template <class Accept>
Stand<dim> ContactPair<dim>::nearest(const Faces<dim> &faces, std::size_t query, const Accept &accept) const
{
  const Point<dim> p = faces.position(point_party_, points_[query]);
  Stand<dim>       stand;
  for (const std::uint32_t f : list_.of(query))
  {
    std::array<Point<dim>, Facet::n_nodes> corner;
    Point<dim>                             middle = Point<dim>::Zero();
    for (int k = 0; k < Facet::n_nodes; ++k)
    {
      corner[k] = faces.position(other_party_, facets_[f].node[k]);
      middle += corner[k] / Facet::n_nodes;
    }
    // A facet that lies wholly farther than the best one needs no closer look.
    if (stand.found)
    {
      double reach = 0;
      for (const auto &c : corner)
        reach = std::max(reach, (c - middle).squaredNorm());
      const double least = (p - middle).norm() - std::sqrt(reach);
      if (least > 0 && least * least > 1.0001 * stand.foot.distance2)
        continue;
    }
    const Foot<dim> foot = foot_on_facet<dim>(p, corner, facets_[f].outward);
    if (accept(foot, facets_[f]) && (!stand.found || better_foot<dim>(p, foot, stand.foot)))
    {
      stand.found = true;
      stand.facet = f;
      stand.foot  = foot;
    }
  }
  if (stand.found)
    finish_stand(p, half_spacing_, stand);
  return stand;
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

template <int dim>
Stand<dim> ContactPair<dim>::came_through(const Faces<dim> &faces, std::size_t query, const Stand<dim> &nearest_one,
                                          const Point<dim> &own, const Point<dim> *last_normal) const
{
  const Stand<dim> found = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &) {
    return foot.normal.dot(own) <= alike && (!last_normal || foot.normal.dot(*last_normal) >= same_side);
  });
  return found.found ? found : nearest_one;
}

template <int dim>
Stand<dim> ContactPair<dim>::lasting(const Faces<dim> &faces, std::size_t query,
                                     const Point<dim> &last_normal) const
{
  const Stand<dim> stand = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &) {
    return foot.normal.dot(last_normal) >= same_side;
  });
  if (!stand.found || stand.distance >= flush * half_spacing_)
    return stand;
  const Point<dim> own = own_normal(faces, query);
  if (!own.isZero())
    return came_through(faces, query, stand, own, &last_normal);
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
  const double     tolerance = flush * half_spacing_;
  const double     r         = faces.radius(point_party_, points_[query]);
  const Stand<dim> stand = nearest(faces, query, [](const Foot<dim> &, const Facet &) { return true; });
  if (!stand.found || stand.distance >= std::max(r, tolerance) || (stand.distance >= 0 && r > 0))
    return stand;
  const Point<dim> own = own_normal(faces, query);
  if (!own.isZero())
    return came_through(faces, query, stand, own, nullptr);

  // A lone point that is suddenly inside came through a facet during the last
  // step; near an edge, or in a thin body, that need not be the nearest one.
  const Point<dim> p       = faces.position(point_party_, points_[query]);
  const Stand<dim> crossed = nearest(faces, query, [&](const Foot<dim> &foot, const Facet &facet) {
    const double depth = (foot.where - p).dot(foot.normal);
    return depth > 0 && depth >= straight * std::sqrt(foot.distance2) &&
           depth <= 1.001 * last_drift * approach(faces, query, foot, facet) + tolerance;
  });
  if (crossed.found || stand.distance >= 0)
    return crossed;
  return nearest(faces, query, [&](const Foot<dim> &foot, const Facet &facet) {
    return approach(faces, query, foot, facet) > 0;
  });
}

template <int dim>
void ContactPair<dim>::detect_balls(const Faces<dim> &faces, std::size_t query, List &found) const
{
  const std::uint32_t i  = points_[query];
  const Point<dim>    xi = faces.position(point_party_, i);
  for (const std::uint32_t t : list_.of(query))
  {
    const std::uint32_t j     = others_[t];
    const Point<dim>    line  = xi - faces.position(other_party_, j);
    const double        far   = line.norm();
    const double        touch = ball_share * (faces.radius(point_party_, i) + faces.radius(other_party_, j));
    if (far >= touch || far == 0)
      continue;
    Record record;
    record.key   = {index_, faces[point_party_].id[i], faces[other_party_].id[j]};
    record.slope = record.normal = line / far;
    record.depth = touch - far;
    record.point = i;
    record.first = static_cast<std::uint32_t>(found.carriers.size());
    found.carriers.push_back({j, record.key.other, 1, record.slope, Point<dim>::Ones()});
    record.last = record.first + 1;
    found.records.push_back(record);
  }
}

template <int dim>
void ContactPair<dim>::detect_particles(const Faces<dim> &faces, std::size_t query, List &found) const
{
  const std::uint32_t i  = points_[query];
  const Point<dim>    xi = faces.position(point_party_, i);
  Record              record;
  double              psi = 0;
  record.first            = static_cast<std::uint32_t>(found.carriers.size());
  const unsigned images   = 1u << symmetry_axes_.size();
  for (const std::uint32_t t : list_.of(query))
    for (unsigned image = 0; image < images; ++image)
    {
      Carrier<dim> carrier;
      for (std::size_t k = 0; k < symmetry_axes_.size(); ++k)
        if (image >> k & 1)
          carrier.sign[symmetry_axes_[k]] = -1;
      carrier.index         = others_[t];
      const Point<dim> line = xi - carrier.sign.cwiseProduct(faces.position(other_party_, carrier.index));
      const double     r    = line.norm();
      if (r >= field_.reach())
        continue;
      carrier.id     = faces[other_party_].id[carrier.index];
      carrier.weight = field_.weight(r);
      psi += carrier.weight;
      if (r > 0)
        carrier.slope = field_.slope(r) / r * line;
      record.slope += carrier.slope;
      found.carriers.push_back(carrier);
    }
  record.depth        = field_.depth(psi);
  const double length = record.slope.norm();
  if (!(record.depth > 0) || length == 0)
  {
    found.carriers.resize(record.first);
    return;
  }
  record.normal = record.slope / length;
  record.last   = static_cast<std::uint32_t>(found.carriers.size());
  for (std::size_t k = record.first; k < record.last; ++k)
    found.carriers[k].weight /= psi;
  record.key   = {index_, faces[point_party_].id[i], -1};
  record.point = i;
  found.records.push_back(record);
}

template <int dim>
void ContactPair<dim>::add_facet(const Faces<dim> &faces, std::size_t query, const Stand<dim> &stand,
                                 List &found) const
{
  const std::uint32_t i = points_[query];
  Record              record;
  record.key    = {index_, faces[point_party_].id[i], -1};
  record.slope = record.normal = stand.direction;
  record.depth  = faces.radius(point_party_, i) - stand.distance;
  record.point  = i;
  record.first  = static_cast<std::uint32_t>(found.carriers.size());
  for (int k = 0; k < Facet::n_nodes; ++k)
  {
    Carrier<dim> &carrier = found.carriers.emplace_back();
    carrier.index         = facets_[stand.facet].node[k];
    carrier.id            = faces[other_party_].id[carrier.index];
    carrier.weight        = stand.foot.weight[k];
    carrier.slope         = carrier.weight * record.slope;
  }
  record.last = static_cast<std::uint32_t>(found.carriers.size());
  found.records.push_back(record);
}

template <int dim>
double ContactPair<dim>::inverse_mass(const Faces<dim> &faces, const List &list, const Record &record) const
{
  const double own     = 1 / faces[point_party_].mass[record.point];
  const auto  &masses  = faces[other_party_].mass;
  const auto   carried = list.of(record);
  // The field's stiffness must not depend on where the contact began, or the
  // force would have no potential: that of the point over a lattice.
  if (other_party_ == particle_party && meeting_ == Meeting::surface)
    return own + field_.sum_of_squares() / masses[carried.front().index];
  double sum = own;
  for (const auto &carrier : carried)
    sum += carrier.weight * carrier.weight / masses[carrier.index];
  return sum;
}

template <int dim>
void ContactPair<dim>::detect(const Faces<dim> &faces, std::span<const Record> old, double last_drift,
                              List &found, std::int64_t &lost) const
{
  std::size_t o = 0;
  for (std::size_t q = 0; q < points_.size(); ++q)
  {
    if (list_.of(q).empty())
      continue;
    if (other_party_ == particle_party)
    {
      meeting_ == Meeting::balls ? detect_balls(faces, q, found) : detect_particles(faces, q, found);
      continue;
    }
    const std::int64_t id = faces[point_party_].id[points_[q]];
    while (o < old.size() && old[o].key.point < id)
      ++o;
    const bool lasts = o < old.size() && old[o].key.point == id;
    if (!lasts && travel_ < safe_[q])
      continue;
    const double     r     = faces.radius(point_party_, points_[q]);
    const Stand<dim> stand = lasts ? lasting(faces, q, old[o].normal) : entering(faces, q, last_drift);
    if (!stand.found || stand.distance >= r)
    {
      safe_[q] = stand.found ? travel_ + stand.distance - std::max(r, 2 * flush * half_spacing_) : 0;
      continue;
    }
    if (-stand.distance > max_depth_)
      lost += lasts;
    else
      add_facet(faces, q, stand, found);
  }
}

template <int dim>
void ContactPair<dim>::detect_overlaps(const Faces<dim> &faces, List &found) const
{
  for (std::size_t q = 0; q < points_.size(); ++q)
    if (other_party_ == particle_party)
      meeting_ == Meeting::balls ? detect_balls(faces, q, found) : detect_particles(faces, q, found);
    else
    {
      const auto stand = nearest(faces, q, [](const Foot<dim> &, const Facet &) { return true; });
      if (stand.found && stand.distance < faces.radius(point_party_, points_[q]))
        add_facet(faces, q, stand, found);
    }
}

template class ContactPair<1>;
template class ContactPair<2>;
template class ContactPair<3>;
} // namespace ogive::coupling
