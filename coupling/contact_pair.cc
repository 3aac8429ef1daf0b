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
// A node stands for half a facet to either side, so a face carries nodes that
// are up to half a facet (the finest of the body) past its rim, the less the farther.
constexpr double rim_share = .5;

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
  const auto   coming     = [&](int body) { return body == spec_.first ? spec_.first_radius : spec_.second_radius; };
  const auto   size_of    = [&](int party, int body) {
    const double now = largest_radius(faces, party, contact_points(faces[party], body));
    return 2 * (party == particle_party ? std::max(now, coming(body)) : now);
  };
  const double point_size = size_of(point_party_, point_body_);
  if (other_party_ == particle_party)
  {
    size_ = size_of(other_party_, other_body_);
    if (size_ > 0)
      field_ = ParticleField<dim>(.5 * (point_size + size_), size_);
  }
  else
  {
    const auto &surface = faces[other_party_];
    const auto  facets  = true_facets(surface, other_body_, symmetry_axes);
    Box<dim>    box;
    double      finest = std::numeric_limits<double>::infinity();
    for (const auto &facet : facets)
    {
      const double edge = facet_size(surface, facet);
      finest            = std::min(finest, edge);
      size_ += edge / static_cast<double>(facets.size());
      for (const std::uint32_t i : facet.node)
        box.include(faces.position(other_party_, i));
    }
    rim_ = dim > 1 && point_party_ == mesh_party && !facets.empty() ? rim_share * finest : 0;
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
      // Seams close the surface, so that a point beside one is not behind the
      // face next to it; nothing touches them (nearest()).
      const auto seams = true_facets(faces[other_party_], other_body_, symmetry_axes, true);
      facets_.insert(facets_.end(), seams.begin(), seams.end());
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
  record.depth  = faces.radius(point_party_, i) - stand.distance;
  record.point  = i;
  record.first  = static_cast<std::uint32_t>(found.carriers.size());
  const auto carry = [&](std::uint32_t facet, const Foot<dim> &foot, double weight, const Point<dim> &slope) {
    record.slope += slope;
    for (int k = 0; k < Facet::n_nodes; ++k)
    {
      const std::uint32_t node = facets_[facet].node[k];
      found.carriers.push_back({node, faces[other_party_].id[node], weight * foot.weight[k],
                                foot.weight[k] * slope, Point<dim>::Ones()});
    }
  };
  if (stand.overhang > 0)
  {
    const double past = stand.overhang / rim_, left = 1 - past * past;
    carry(stand.side_facet, stand.side, 0, 2 * record.depth * past / rim_ * stand.aside);
    carry(stand.facet, stand.foot, 1, left * stand.direction);
    record.depth *= left;
    record.normal = record.slope.normalized();
  }
  else
  {
    carry(stand.facet, stand.foot, 1, stand.direction);
    record.normal = stand.direction;
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
      safe_[q] = stand.found ? travel_ + stand.distance - std::max({r, rim_, 2 * flush_share * half_spacing_}) : 0;
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
      const Stand<dim> stand = anywhere(faces, q);
      if (stand.found && stand.distance < faces.radius(point_party_, points_[q]))
        add_facet(faces, q, stand, found);
    }
}

template class ContactPair<1>;
template class ContactPair<2>;
template class ContactPair<3>;
} // namespace ogive::coupling
