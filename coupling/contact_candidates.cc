// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact_pair.h"

#include <algorithm>
#include <utility>

/// Which facets or particles of the other side a point may meet at all.
namespace ogive::coupling
{
namespace
{
// Share of a facet by which points may move before the candidates are sought
// anew: small enough for short lists, large enough for some ten steps.
constexpr double skin_share = .25;
} // namespace

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
  const auto            own = own_points(faces);
  for (std::size_t q = own.first; q < own.second; ++q)
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
  count_work(faces, own);
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

template class ContactPair<1>;
template class ContactPair<2>;
template class ContactPair<3>;
} // namespace ogive::coupling
