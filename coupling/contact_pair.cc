// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_pair.h"

#include <algorithm>
#include <utility>

namespace ogive::coupling
{
namespace
{
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
    return 2 * std::max({largest_radius(faces, party, body_points(faces[party], body)), coming, faces.widest_of(body)});
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
