// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

/// How ranks share the work of contact. What takes time is the search and the gap
/// functions: each rank does them for a share of the points and tells all others
/// what touches. All that follows - stiffness, friction, forces, books - is a
/// matter of the points that touch and done alike by all ranks, from the same
/// numbers in the same order: so the state of contact is whole on every rank, and
/// what comes out does not depend on their number.
namespace ogive::coupling
{
namespace
{
/// Numbers of one record before its carriers, and of each carrier.
template <int dim>
constexpr std::size_t head = 6 + 2 * dim;
template <int dim>
constexpr std::size_t each = 3 + dim;

template <int dim>
void pack(const ContactList<dim> &list, const ContactRecord<dim> &record, std::vector<double> &out)
{
  out.insert(out.end(), {static_cast<double>(record.key.pair), static_cast<double>(record.key.point),
                         static_cast<double>(record.key.other), static_cast<double>(record.point), record.depth,
                         static_cast<double>(record.last - record.first)});
  out.insert(out.end(), record.slope.data(), record.slope.data() + dim);
  out.insert(out.end(), record.normal.data(), record.normal.data() + dim);
  for (const auto &carrier : list.of(record))
  {
    int mirrored = 0;
    for (int a = 0; a < dim; ++a)
      mirrored |= (carrier.sign[a] < 0) << a;
    out.insert(out.end(), {static_cast<double>(carrier.index), static_cast<double>(mirrored), carrier.weight});
    out.insert(out.end(), carrier.slope.data(), carrier.slope.data() + dim);
  }
}

/// Adds the record that begins at `in`; returns where the next one does.
template <int dim>
const double *unpack(const double *in, const Surface<dim> &other, ContactList<dim> &list)
{
  ContactRecord<dim> record;
  record.key    = {static_cast<std::int64_t>(in[0]), static_cast<std::int64_t>(in[1]), static_cast<std::int64_t>(in[2])};
  record.point  = static_cast<std::uint32_t>(in[3]);
  record.depth  = in[4];
  const auto n  = static_cast<std::size_t>(in[5]);
  record.slope  = Eigen::Map<const Point<dim>>(in + 6);
  record.normal = Eigen::Map<const Point<dim>>(in + 6 + dim);
  record.first  = static_cast<std::uint32_t>(list.carriers.size());
  in += head<dim>;
  for (std::size_t k = 0; k < n; ++k, in += each<dim>)
  {
    Carrier<dim> carrier;
    carrier.index  = static_cast<std::uint32_t>(in[0]);
    carrier.id     = other.id[carrier.index];
    carrier.weight = in[2];
    carrier.slope  = Eigen::Map<const Point<dim>>(in + 3);
    for (int a = 0; a < dim; ++a)
      if (static_cast<int>(in[1]) >> a & 1)
        carrier.sign[a] = -1;
    list.carriers.push_back(carrier);
  }
  record.last = static_cast<std::uint32_t>(list.carriers.size());
  list.records.push_back(record);
  return in;
}
} // namespace

template <int dim>
ContactList<dim> ContactSet<dim>::detect(const Faces<dim> &faces)
{
  List         own;
  std::int64_t lost = 0;
  auto         old  = state_.list.records.begin();
  const auto   end  = state_.list.records.end();
  for (auto &pair : pairs_)
  {
    const auto stop = std::find_if(old, end, [&](const Record &r) { return r.key.pair != pair.index(); });
    pair.update(faces, symmetry_axes_, fragments_of(pair));
    pair.detect(faces, {old, stop}, state_.last_drift, own, lost);
    old = stop;
  }
  if (!ranks_.alone() && !pairs_.empty())
    return joined(faces, own, lost);
  state_.lost += lost;
  return own;
}

template <int dim>
ContactList<dim> ContactSet<dim>::joined(const Faces<dim> &faces, const List &own, std::int64_t lost)
{
  std::vector<double> out{static_cast<double>(lost)};
  for (const auto &record : own.records)
    pack<dim>(own, record, out);
  std::vector<std::size_t>   starts;
  const auto                 in = ranks_.gather(out, &starts);
  std::vector<const double *> at, stop;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r)
  {
    state_.lost += static_cast<std::int64_t>(in[starts[r]]);
    at.push_back(in.data() + starts[r] + 1);
    stop.push_back(in.data() + starts[r + 1]);
  }
  // Ranks have runs of points by ascending id.
  List all;
  for (const auto &pair : pairs_)
    for (std::size_t r = 0; r < at.size(); ++r)
      while (at[r] != stop[r] && static_cast<std::int64_t>(*at[r]) == pair.index())
        at[r] = unpack<dim>(at[r], faces[pair.other_party()], all);
  return all;
}

template <int dim>
void ContactSet<dim>::add_overlaps(const Faces<dim> &faces, const ContactPair<dim> &pair, List &list)
{
  if (ranks_.alone())
  {
    pair.detect_overlaps(faces, list);
    return;
  }
  List own;
  pair.detect_overlaps(faces, own);
  const List         all   = joined(faces, own, 0);
  const std::uint32_t first = static_cast<std::uint32_t>(list.carriers.size());
  list.carriers.insert(list.carriers.end(), all.carriers.begin(), all.carriers.end());
  for (Record record : all.records)
  {
    record.first += first;
    record.last += first;
    list.records.push_back(record);
  }
}

template <int dim>
std::vector<Attention> ContactSet<dim>::attention() const
{
  std::vector<Attention> all;
  for (const auto &pair : pairs_)
    for (const Attention &a : pair.attention())
      all.push_back(a);
  return all;
}

template <int dim>
double ContactPair<dim>::search_reach() const
{
  const double radius = .5 * apart_; // of the points, where they are particles
  return other_party_ == mesh_party  ? (point_party_ == particle_party ? radius : 0.) + max_depth_ :
         meeting_ == Meeting::balls ? ball_share * size_ :
                                      field_.reach();
}

template <int dim>
std::vector<Attention> ContactPair<dim>::attention() const
{
  std::vector<Attention> all;
  if (point_party_ == particle_party)
    all.push_back({point_body_, other_body_, other_party_, search_reach()});
  if (other_party_ == particle_party && !spec_.meets_itself())
    all.push_back({other_body_, point_body_, point_party_, search_reach()});
  return all;
}

template <int dim>
std::pair<std::size_t, std::size_t> ContactPair<dim>::own_points(const Faces<dim> &faces) const
{
  const std::size_t n = points_.size();
  if (ranks_.alone())
    return {0, n};
  std::vector<double> before(n + 1, 0.);
  auto                known = work_.begin();
  for (std::size_t q = 0; q < n; ++q)
  {
    const std::int64_t id = faces[point_party_].id[points_[q]];
    while (known != work_.end() && known->first < id)
      ++known;
    before[q + 1] = before[q] + (known != work_.end() && known->first == id ? known->second : 1.);
  }
  const auto cut = [&](int rank) {
    const double share = before[n] * rank / ranks_.size();
    return static_cast<std::size_t>(std::lower_bound(before.begin(), before.end(), share) - before.begin());
  };
  return {cut(ranks_.rank()), ranks_.rank() + 1 == ranks_.size() ? n : cut(ranks_.rank() + 1)};
}

template <int dim>
void ContactPair<dim>::count_work(const Faces<dim> &faces, std::pair<std::size_t, std::size_t> own)
{
  if (ranks_.alone())
    return;
  std::vector<std::uint32_t> counts;
  for (std::size_t q = own.first; q < own.second; ++q)
    counts.push_back(static_cast<std::uint32_t>(list_.of(q).size()));
  const auto all = ranks_.gather(counts);
  work_.clear();
  for (std::size_t q = 0; q < all.size(); ++q)
    work_.emplace_back(faces[point_party_].id[points_[q]], 1. + all[q]);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template ContactList<d>         ContactSet<d>::detect(const Faces<d> &);                                   \
  template ContactList<d>         ContactSet<d>::joined(const Faces<d> &, const List &, std::int64_t);       \
  template void                   ContactSet<d>::add_overlaps(const Faces<d> &, const ContactPair<d> &, List &); \
  template std::vector<Attention> ContactSet<d>::attention() const;                                          \
  template double                 ContactPair<d>::search_reach() const;                                      \
  template std::vector<Attention> ContactPair<d>::attention() const;                                         \
  template std::pair<std::size_t, std::size_t> ContactPair<d>::own_points(const Faces<d> &) const;           \
  template void ContactPair<d>::count_work(const Faces<d> &, std::pair<std::size_t, std::size_t>);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
