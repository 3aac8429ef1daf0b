// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fragments.h"

#include "coupling/search.h"

#include <algorithm>
#include <numeric>

namespace ogive::coupling
{
namespace
{
// Gathers between two looks for fragments: pieces part by far less than a
// spacing in the meantime.
constexpr std::int64_t every = 16;
} // namespace

template <int dim>
Fragments<dim>::Fragments(int body, double reach, bool of_start)
  : body_(body)
  , reach_(reach)
  , of_start_(of_start)
{}

template <int dim>
void Fragments<dim>::start(const Faces<dim> &faces)
{
  const auto &surface = faces[particle_party];
  const auto  points  = body_points(surface, body_);
  if (of_start_)
  {
    start_.clear();
    for (const std::uint32_t i : points)
    {
      start_.resize(std::max<std::size_t>(start_.size(), surface.id[i] + 1), Point<dim>::Zero());
      start_[surface.id[i]] = faces.position(particle_party, i);
    }
    return;
  }
  // As it is drawn it is one piece, even where it is in several.
  state_ = {0, 0};
  for (const std::uint32_t i : points)
  {
    state_.resize(std::max<std::size_t>(state_.size(), header + surface.id[i] + 1), unknown);
    state_[header + surface.id[i]] = surface.id[points.front()];
  }
}

template <int dim>
bool Fragments<dim>::joined(std::int64_t i, std::int64_t j) const
{
  if (of_start_)
  {
    const auto n = static_cast<std::int64_t>(start_.size());
    return i >= n || j >= n || (start_[i] - start_[j]).norm() < reach_;
  }
  const auto label = this->label();
  const auto n     = static_cast<std::int64_t>(label.size());
  return i >= n || j >= n || label[i] < 0 || label[j] < 0 || label[i] == label[j];
}

template <int dim>
std::vector<std::array<std::uint32_t, 2>> Fragments<dim>::near_pairs(const Faces<dim>                 &faces,
                                                                  const std::vector<std::uint32_t> &points) const
{
  std::vector<Box<dim>> targets(points.size()), queries;
  for (std::size_t k = 0; k < points.size(); ++k)
    targets[k].include(faces.position(particle_party, points[k]));
  queries = targets;
  for (auto &query : queries)
    query.inflate(reach_);
  NeighbourList<dim> list;
  list.build(queries, targets);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t k = 0; k < points.size(); ++k)
    for (const std::uint32_t l : list.of(k))
      if (l > k && (targets[k].lower - targets[l].lower).norm() < reach_)
        pairs.push_back({points[k], points[l]});
  return pairs;
}

// A particle that came in is of the piece of a neighbour.
template <int dim>
void Fragments<dim>::take_in(const Faces<dim> &faces, const std::vector<std::uint32_t> &points,
                          const std::vector<std::array<std::uint32_t, 2>> &pairs)
{
  const auto &id = faces[particle_party].id;
  for (const std::uint32_t i : points)
    state_.resize(std::max<std::size_t>(state_.size(), header + id[i] + 1), unknown);
  for (const auto &[i, j] : pairs)
  {
    std::int64_t &a = state_[header + id[i]], &b = state_[header + id[j]];
    if (a == unknown && b >= 0)
      a = b;
    else if (b == unknown && a >= 0)
      b = a;
  }
  for (const std::uint32_t i : points)
    if (std::int64_t &label = state_[header + id[i]]; label == unknown)
      label = id[i];
}

template <int dim>
bool Fragments<dim>::update(const Faces<dim> &faces)
{
  if (of_start_ || ++state_[1] % every != 0)
    return false;
  const auto &surface = faces[particle_party];
  const auto  points  = body_points(surface, body_);
  const auto  pairs   = near_pairs(faces, points);
  const auto  before  = state_;
  take_in(faces, points, pairs);

  const auto failed = [&](std::uint32_t i) { return !faces.damage.empty() && faces.damage[i] >= 1; };
  std::vector<std::uint32_t> root(surface.n);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i)
      i = root[i] = root[root[i]];
    return i;
  };
  const auto label = [&](std::uint32_t i) -> std::int64_t & { return state_[header + surface.id[i]]; };
  for (const std::uint32_t i : points)
    if (failed(i))
      label(i) = nobody;
  for (const auto &[i, j] : pairs)
    if (label(i) >= 0 && label(i) == label(j))
    {
      // The root of a piece is its least id, whatever the order of the particles.
      const std::uint32_t a = find(i), b = find(j);
      surface.id[a] < surface.id[b] ? root[b] = a : root[a] = b;
    }
  std::vector<std::int64_t> fresh;
  for (const std::uint32_t i : points)
    fresh.push_back(label(i) < 0 ? label(i) : surface.id[find(i)]);
  for (std::size_t k = 0; k < points.size(); ++k)
    label(points[k]) = fresh[k];
  const bool changed = !std::equal(state_.begin() + header, state_.end(), before.begin() + header, before.end());
  state_[0] += changed;
  return changed;
}

template class Fragments<1>;
template class Fragments<2>;
template class Fragments<3>;
} // namespace ogive::coupling
