// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

/// What contact remembers: for a rejected step and for a restart.
namespace ogive::coupling
{
template <int dim>
void ContactSet<dim>::snapshot()
{
  kept_ = state_;
  kept_fragments_.clear();
  for (const auto &fragments : fragments_)
    kept_fragments_.push_back(fragments.state());
}

template <int dim>
void ContactSet<dim>::restore()
{
  state_ = kept_;
  for (std::size_t f = 0; f < kept_fragments_.size(); ++f)
  {
    fragments_[f].set_state(kept_fragments_[f]);
    told_[f] = fragments_[f].version(); // the particle solver went back as well
  }
  for (auto &pair : pairs_)
    pair.forget();
}

template <int dim>
void ContactSet<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<std::int64_t> names;
  std::vector<double>       values;
  for (const auto &r : state_.list.records)
  {
    names.insert(names.end(), {r.key.pair, r.key.point, r.key.other});
    values.insert(values.end(), {r.stiffness, r.tangential_stiffness, r.offset, r.depth, r.next});
    for (const Point<dim> *p : {&r.normal, &r.spring, &r.slide, &r.force})
      values.insert(values.end(), p->data(), p->data() + dim);
  }
  archive.write(prefix + "/contacts", names);
  archive.write(prefix + "/contact_state", values);

  const auto                 &e     = state_.energy;
  const auto                 &limit = state_.limit;
  const std::vector<double>   totals{e.taken,
                                     e.stored,
                                     e.friction_heat,
                                     e.work[0],
                                     e.work[1],
                                     state_.impulse,
                                     reference_dt_,
                                     state_.last_drift,
                                     limit.dt,
                                     limit.culprit.where[0],
                                     limit.culprit.where[1],
                                     limit.culprit.where[2],
                                     e.eroded};
  const std::vector<std::int64_t> counts{state_.lost, static_cast<std::int64_t>(state_.topology), limit.culprit.body, limit.culprit.id,
                                          state_.died};
  archive.write(prefix + "/contact_totals", totals);
  archive.write(prefix + "/contact_plane_impulse",
                std::span<const double>(state_.plane_impulse.data(), static_cast<std::size_t>(dim)));
  archive.write(prefix + "/contact_counts", counts);
  save_fragments(archive, prefix);
}

template <int dim>
void ContactSet<dim>::save_fragments(ArchiveWriter &archive, const std::string &prefix) const
{
  for (std::size_t f = 0; f < fragments_.size(); ++f)
    archive.write(prefix + "/fragments-" + std::to_string(f), fragments_[f].state());
}

template <int dim>
void ContactSet<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto     names  = archive.integers(prefix + "/contacts");
  const auto     values = archive.doubles(prefix + "/contact_state");
  const auto     totals = archive.doubles(prefix + "/contact_totals");
  const auto     counts = archive.integers(prefix + "/contact_counts");
  constexpr auto width  = static_cast<std::size_t>(5 + 4 * dim);
  const auto     n      = names.size() / 3;
  if (names.size() != 3 * n || values.size() != width * n || totals.size() != 13 || counts.size() != 5)
    throw InputError("the checkpoint's contacts (" + prefix + ") do not belong to this scene");

  State state;
  state.list.records.resize(n);
  for (std::size_t c = 0; c < n; ++c)
  {
    auto         &r = state.list.records[c];
    const double *v = values.data() + width * c;
    r.key           = {names[3 * c], names[3 * c + 1], names[3 * c + 2]};
    if (r.key.pair < 0 || r.key.pair >= static_cast<std::int64_t>(pairs_.size()))
      throw InputError("the checkpoint holds a contact that the scene does not list");
    r.stiffness            = v[0];
    r.tangential_stiffness = v[1];
    r.offset               = v[2];
    r.depth                = v[3];
    r.next                 = v[4];
    v += 5;
    for (Point<dim> *p : {&r.normal, &r.spring, &r.slide, &r.force})
    {
      *p = Eigen::Map<const Point<dim>>(v);
      v += dim;
    }
  }
  state.energy        = {totals[0], totals[1], totals[2], totals[12], {totals[3], totals[4]}};
  state.impulse       = totals[5];
  reference_dt_       = totals[6];
  state.last_drift    = totals[7];
  state.limit.dt      = totals[8];
  const auto planes   = archive.doubles(prefix + "/contact_plane_impulse");
  if (planes.size() != static_cast<std::size_t>(dim))
    throw InputError("the checkpoint's contacts (" + prefix + ") do not belong to this scene");
  state.plane_impulse = Eigen::Map<const Point<dim>>(planes.data());
  state.lost          = counts[0];
  state.topology      = static_cast<std::uint64_t>(counts[1]);
  state.died          = counts[4] != 0;
  state.limit.culprit = {"contact", static_cast<int>(counts[2]), counts[3],
                         Vec3(totals[9], totals[10], totals[11]),
                         "stiffness of its contacts against its mass"};
  kept_               = std::move(state);
  kept_fragments_.clear();
  for (std::size_t f = 0; f < fragments_.size(); ++f)
    kept_fragments_.push_back(archive.integers(prefix + "/fragments-" + std::to_string(f)));
  restore();
}

#define OGIVE_INSTANTIATE(dim) \
  template void ContactSet<dim>::snapshot(); \
  template void ContactSet<dim>::restore(); \
  template void ContactSet<dim>::save(ArchiveWriter &, const std::string &) const; \
  template void ContactSet<dim>::save_fragments(ArchiveWriter &, const std::string &) const; \
  template void ContactSet<dim>::load(const ArchiveReader &, const std::string &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
