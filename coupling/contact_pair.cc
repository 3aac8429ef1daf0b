// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_pair.h"

#include <algorithm>
#include <utility>

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
// A node is not pressed in by this share of a facet within a step.
constexpr double far_side_share = .25;

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
  if (other_party_ == mesh_party)
  {
    const auto &surface = faces[other_party_];
    const auto  facets  = true_facets(surface, other_body_, symmetry_axes);
    Box<dim>    box;
    finest_     = std::numeric_limits<double>::infinity();
    facet_size_ = 0;
    for (const auto &facet : facets)
    {
      const double edge = facet_size(surface, facet);
      finest_           = std::min(finest_, edge);
      facet_size_ += edge / static_cast<double>(facets.size());
      for (const std::uint32_t i : facet.node)
        box.include(faces.position(other_party_, i));
    }
    if (facets.empty())
      finest_ = 0;
    // In one dimension a facet has no edge: the body's length serves. One end
    // alone (the other tied or on a symmetry plane) has nothing behind it.
    if (dim == 1)
      facet_size_ =
        facets.size() > 1 ? .25 * (box.upper - box.lower)[0] : std::numeric_limits<double>::infinity();
  }
  own_finest_ = 0;
  if (point_party_ == mesh_party)
    for (const auto &facet : true_facets(faces[point_party_], point_body_, symmetry_axes))
    {
      const double edge = facet_size(faces[point_party_], facet);
      own_finest_       = own_finest_ > 0 ? std::min(own_finest_, edge) : edge;
    }
  size_up(faces);
}

template <int dim>
void ContactPair<dim>::size_up(const Faces<dim> &faces)
{
  const auto size_of = [&](Party party, int body) {
    const double coming = body == spec_.first ? spec_.first_radius : spec_.second_radius;
    return 2 * std::max(largest_radius(faces, party, body_points(faces[party], body)), coming);
  };
  const double point_size = point_party_ == particle_party ? size_of(point_party_, point_body_) : 0;
  if (other_party_ == particle_party)
  {
    size_ = size_of(other_party_, other_body_);
    if (size_ > 0)
      field_ = ParticleField<dim>(.5 * (point_size + size_), size_);
  }
  else
    size_ = facet_size_;
  rim_ = dim > 1 && point_party_ == mesh_party && other_party_ == mesh_party && !spec_.meets_itself() ?
           rim_share * finest_ :
           0;
  if (dim > 1 || other_party_ == particle_party)
    size_ = std::max(size_, point_size);
  apart_        = point_party_ == particle_party ? point_size : own_finest_;
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
void ContactPair<dim>::update(const Faces<dim> &faces, const std::vector<int> &symmetry_axes,
                              const Fragments<dim> *pieces)
{
  symmetry_axes_.clear();
  std::copy_if(symmetry_axes.begin(), symmetry_axes.end(), std::back_inserter(symmetry_axes_),
               [](int axis) { return axis < dim; });
  const std::int64_t version = pieces ? pieces->version() : -1;
  bool stale = !built_ || topology_[0] != faces[0].topology || topology_[1] != faces[1].topology;
  if (stale)
    renew(faces, symmetry_axes);
  stale |= std::exchange(pieces_, version) != version;
  if (points_.empty() || others_.empty())
  {
    list_.build(std::vector<Box<dim>>(points_.size()), {});
    safe_.assign(points_.size(), 0);
    listed_.clear();
    return;
  }
  auto positions = all_positions(faces);
  // A closer approach than twice the skin leaves no pair out.
  if (!stale && watch_.approach(positions) <= 2 * skin_share * size_)
  {
    travel_ += last_step_.approach(positions);
    last_step_.set(std::move(positions), points_.size());
  }
  else
    search(faces, std::move(positions), pieces);
  refit(faces);
}

template <int dim>
void ContactPair<dim>::renew(const Faces<dim> &faces, const std::vector<int> &symmetry_axes)
{
  const std::size_t knew[2] = {points_.size(), others_.size()};
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
  // A body that turns into particles has its first ones now.
  if ((knew[0] == 0 && !points_.empty()) || (knew[1] == 0 && !others_.empty()))
    size_up(faces);
  list_own_facets(faces, symmetry_axes);
  facets_at_.clear();
  facets_of_.clear();
  for (std::uint32_t f = 0; spec_.meets_itself() && f < facets_.size(); ++f)
  {
    facets_of_.emplace_back(facets_[f].element, f);
    for (const std::uint32_t i : facets_[f].node)
      facets_at_.emplace_back(i, f);
  }
  std::sort(facets_at_.begin(), facets_at_.end());
  std::sort(facets_of_.begin(), facets_of_.end());
  topology_[0] = faces[0].topology;
  topology_[1] = faces[1].topology;
  built_       = true;
}

template <int dim>
void ContactPair<dim>::search(const Faces<dim> &faces, std::vector<Point<dim>> positions, const Fragments<dim> *pieces)
{
  travel_ = 0;
  safe_.assign(points_.size(), 0);

  // Both sides may have moved by the skin before the next search.
  const double          skin = skin_share * size_;
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
  if (spec_.meets_itself())
    drop_joined(faces, pieces);
  listed_.clear();
  if (other_party_ == mesh_party)
  {
    std::vector<bool> seen(facets_.size(), false);
    for (std::size_t q = 0; q < points_.size(); ++q)
      for (const std::uint32_t f : list_.of(q))
        if (!seen[f])
        {
          seen[f] = true;
          listed_.push_back(f);
        }
  }
  balls_.resize(facets_.size());
  last_step_.set(positions, points_.size());
  watch_.set(std::move(positions), points_.size());
}

template <int dim>
void ContactPair<dim>::drop_joined(const Faces<dim> &faces, const Fragments<dim> *pieces)
{
  if (other_party_ == particle_party)
  {
    const auto &id = faces[other_party_].id;
    list_.remove_if([&](std::size_t q, std::uint32_t t) {
      const std::int64_t i = id[points_[q]], j = id[others_[t]];
      // Two balls meet once.
      return i == j || (meeting_ == Meeting::balls && j < i) || !pieces || pieces->joined(i, j);
    });
    return;
  }
  std::vector<std::uint32_t> near;
  std::size_t                of = points_.size();
  list_.remove_if([&](std::size_t q, std::uint32_t f) {
    if (std::exchange(of, q) != q)
      near = own_neighbours(q);
    return std::binary_search(near.begin(), near.end(), f);
  });
}

template <int dim>
std::vector<std::uint32_t> ContactPair<dim>::own_neighbours(std::size_t query) const
{
  const auto unique = [](std::vector<std::uint32_t> &all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  const auto for_each_at = [](const Meetings &meetings, std::uint32_t where, const auto &f) {
    for (auto m = std::lower_bound(meetings.begin(), meetings.end(), std::pair(where, 0u));
         m != meetings.end() && m->first == where; ++m)
      f(m->second);
  };
  // Corners of the sides of its own elements, and every facet that has one.
  std::vector<std::uint32_t> corners, facets;
  for_each_at(facets_at_, points_[query], [&](std::uint32_t own) {
    for_each_at(facets_of_, facets_[own].element, [&](std::uint32_t side) {
      corners.insert(corners.end(), facets_[side].node.begin(), facets_[side].node.end());
    });
  });
  corners.push_back(points_[query]);
  unique(corners);
  for (const std::uint32_t i : corners)
    for_each_at(facets_at_, i, [&](std::uint32_t f) { facets.push_back(f); });
  unique(facets);
  return facets;
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
double ContactPair<dim>::crowded_inverse_mass(const Faces<dim> &faces, const List &list, const Record &record) const
{
  const auto &masses  = faces[other_party_].mass;
  const auto  carried = list.of(record);
  const auto  crowd   = [&](double size) {
    return apart_ > 0 ? std::max(1., std::pow(size / apart_, dim - 1)) : 1.;
  };
  if (meeting_ == Meeting::balls)
    return 0;
  if (other_party_ == particle_party)
  {
    const double sum = field_.sum_of_slopes();
    return .5 * (1 + sum) * sum * crowd(size_) / masses[carried.front().index];
  }
  double     sum = 0, edge = 0;
  const auto place = [&](std::size_t k) { return faces.position(mesh_party, carried[k].index); };
  const auto first = carried.size() - Facet::n_nodes; // before it: the side, if past a rim
  for (std::size_t k = first; k < carried.size(); ++k)
  {
    sum += std::abs(carried[k].weight) / masses[carried[k].index];
    edge = std::max(edge, (place(k) - place(k + 1 < carried.size() ? k + 1 : first)).norm());
  }
  return crowd(edge) * sum;
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
    if (!lasts && spec_.meets_itself())
    {
      if (const Stand<dim> stand = entering_itself(faces, q, last_drift); stand.found)
        add_facet(faces, q, stand, found);
      continue;
    }
    const Stand<dim> stand = lasts ? lasting(faces, q, old[o].normal) : entering(faces, q, last_drift);
    // What a node of the same body had come through may have died: what is behind
    // that is the far side.
    const bool far_side = spec_.meets_itself() &&
                          -stand.distance > old[o].depth + old[o].offset + far_side_share * size_;
    if (!stand.found || stand.distance >= r || far_side)
    {
      if (spec_.meets_itself())
      {
        safe_[q] = 0;
        continue;
      }
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
  // Every node is behind facets of its own body, and nothing tells a fold.
  if (spec_.meets_itself() && other_party_ == mesh_party)
    return;
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
