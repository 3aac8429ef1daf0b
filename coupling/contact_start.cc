// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

/// How contact begins, and what it makes of bodies that overlap.
namespace ogive::coupling
{
namespace
{
/// Positions that can be moved, seen as Faces.
template <int dim>
struct Trial
{
  Faces<dim>                                          faces;
  std::array<std::array<std::vector<double>, dim>, 2> x;

  explicit Trial(const Faces<dim> &start)
    : faces(start)
  {
    for (int party = 0; party < 2; ++party)
      for (int a = 0; a < dim; ++a)
      {
        x[party][a].assign(start[party].x[a].begin(), start[party].x[a].end());
        faces[party].x[a] = x[party][a];
      }
  }
};
} // namespace

std::string InitialOverlap::describe() const
{
  std::ostringstream text;
  text << "contact \"" << contact << "\": " << count << " points overlap at the start, by up to " << worst
       << " m at (" << where.transpose() << ") m; ";
  if (healed)
    text << "they were moved apart, by up to " << moved << " m";
  else
    text << "their gap counts as zero until it opens";
  return text.str();
}

template <int dim>
void ContactSet<dim>::start_fragments(const Faces<dim> &faces)
{
  for (auto &fragments : fragments_)
    fragments.start(faces);
}

template <int dim>
void ContactSet<dim>::start(const Faces<dim> &faces)
{
  start_fragments(faces);
  overlaps_.clear();
  for (auto &pair : pairs_)
  {
    pair.measure(faces, symmetry_axes_);
    pair.update(faces, symmetry_axes_, fragments_of(pair));
    const std::size_t first = state_.list.records.size();
    add_overlaps(faces, pair, state_.list);
    const std::span<Record> found(state_.list.records.data() + first, state_.list.records.size() - first);
    for (auto &record : found)
    {
      begin_contact(faces, pair, state_.list, record);
      record.offset = record.depth;
    }
    if (const InitialOverlap overlap = overlap_of(faces, pair, found); overlap.count > 0)
      overlaps_.push_back(overlap);
    for (auto &record : found)
      record.depth = 0;
  }
  state_.topology = faces[mesh_party].topology;
  snapshot();
}

template <int dim>
InitialOverlap ContactSet<dim>::overlap_of(const Faces<dim> &faces, const ContactPair<dim> &pair,
                                           std::span<const Record> found) const
{
  // Bodies drawn flush touch within rounding of their coordinates.
  const double   rounding = 1e-6 * pair.half_spacing();
  InitialOverlap overlap;
  overlap.contact = pair.spec().name;
  std::int64_t id = -1;
  for (const auto &record : found)
    if (record.depth > rounding)
    {
      ++overlap.count;
      if (record.depth > overlap.worst)
      {
        overlap.worst = record.depth;
        overlap.where = spatial<dim>(faces.position(pair.point_party(), record.point));
        id            = record.key.point;
      }
    }
  const bool refuse = pair.spec().overlap == "refuse" && overlap.count > 0;
  if (!refuse && !(overlap.worst > pair.half_spacing()))
    return overlap;
  std::ostringstream message;
  message << "contact \"" << overlap.contact << "\": " << overlap.count << " points overlap at the start, worst "
          << (pair.point_party() == particle_party ? "particle " : "node ") << id << " by " << overlap.worst
          << " m at (" << overlap.where.transpose() << ") m";
  if (overlap.worst > pair.half_spacing())
    message << ", more than half a spacing (" << pair.half_spacing() << " m)";
  throw InputError({"", 0, "Contacts/" + overlap.contact + "/overlap"}, message.str(),
                   overlap.worst > pair.half_spacing() ?
                     "bodies that are at least as far apart as they overlap now" :
                     "bodies farther apart, or overlap = heal or rest, which allow up to half a spacing");
}

template <int dim>
std::vector<Move> ContactSet<dim>::healing(const Faces<dim> &faces, std::vector<InitialOverlap> &healed)
{
  constexpr int rounds = 50;
  Trial<dim>    trial(faces);
  std::map<std::string, InitialOverlap>                               report;
  std::map<std::pair<int, std::uint32_t>, std::pair<int, Point<dim>>> moved; // party, point: body, way
  start_fragments(faces);
  for (auto &pair : pairs_)
    pair.measure(faces, symmetry_axes_);
  bool any = true;
  for (int round = 0; any && round < rounds; ++round)
  {
    any = false;
    for (auto &pair : pairs_)
    {
      if (pair.spec().overlap != "heal")
        continue;
      List list;
      pair.update(trial.faces, symmetry_axes_, fragments_of(pair));
      add_overlaps(trial.faces, pair, list);
      InitialOverlap overlap = overlap_of(trial.faces, pair, list.records);
      if (overlap.count == 0)
        continue;
      any            = true;
      overlap.healed = true;
      const auto &known = report.try_emplace(pair.spec().name, overlap).first->second;
      for (const auto &record : list.records)
      {
        if (!(record.depth > 0))
          continue;
        // Past the surface by a hair, so that the end does not creep up on it.
        Point<dim> way = (record.depth + 1e-7 * pair.half_spacing()) / record.slope.norm() * record.normal;
        const auto party = pair.point_party();
        for (const int axis : symmetry_axes_)
          if (axis < dim && trial.x[party][axis][record.point] == 0)
            way[axis] = 0; // a plane of symmetry keeps its points
        for (int a = 0; a < dim; ++a)
          trial.x[party][a][record.point] += way[a];
        auto &sum = moved.try_emplace({party, record.point}, pair.point_body(), Point<dim>::Zero()).first->second;
        sum.second += way;
        auto &entry = report.at(known.contact);
        entry.moved = std::max(entry.moved, sum.second.norm());
      }
    }
  }
  std::vector<Move> moves;
  for (const auto &[point, way] : moved)
    moves.push_back({way.first, static_cast<Party>(point.first), faces[point.first].id[point.second],
                     spatial<dim>(way.second)});
  for (const auto &[name, overlap] : report)
    healed.push_back(overlap);
  for (auto &pair : pairs_)
    pair.forget();
  return moves;
}

template <int dim>
void ContactSet<dim>::report_healed(std::vector<InitialOverlap> healed)
{
  // What is left after the moves is their rounding.
  std::erase_if(overlaps_, [&](const InitialOverlap &left) {
    return std::any_of(healed.begin(), healed.end(), [&](const auto &h) { return h.contact == left.contact; });
  });
  overlaps_.insert(overlaps_.begin(), healed.begin(), healed.end());
}

#define OGIVE_INSTANTIATE(dim) \
  template void ContactSet<dim>::start_fragments(const Faces<dim> &); \
  template void ContactSet<dim>::start(const Faces<dim> &); \
  template InitialOverlap ContactSet<dim>::overlap_of(const Faces<dim> &, const ContactPair<dim> &, \
                                                      std::span<const Record>) const; \
  template std::vector<Move> ContactSet<dim>::healing(const Faces<dim> &, std::vector<InitialOverlap> &); \
  template void ContactSet<dim>::report_healed(std::vector<InitialOverlap>);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
