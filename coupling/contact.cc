// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"
#include "coupling/laws.h"

#include <algorithm>
#include <sstream>

namespace ogive::coupling
{
namespace
{
template <int dim>
Vec3 spatial(const Point<dim> &p)
{
  Vec3 v = Vec3::Zero();
  v.head<dim>() = p;
  return v;
}

template <int dim>
Point<dim> carried_velocity(const Faces<dim> &faces, Party party, const ContactRecord<dim> &record, bool moved)
{
  Point<dim> v = Point<dim>::Zero();
  for (int k = 0; k < record.n; ++k)
  {
    const std::uint32_t i = moved ? faces.now(party, record.other[k], record.other_id[k]) : record.other[k];
    v += record.weight[k] * faces.velocity(party, i);
  }
  return v;
}
} // namespace

template <int dim>
ContactSet<dim>::ContactSet(std::vector<ContactSpec> specs, std::vector<int> symmetry_axes,
                            double reference_dt, double step_share)
  : symmetry_axes_(std::move(symmetry_axes))
  , reference_dt_(reference_dt)
  , step_share_(step_share)
{
  require(specs.empty() || (reference_dt > 0 && std::isfinite(reference_dt)),
          "contact needs a reference step > 0");
  for (const auto &spec : specs)
  {
    const auto next = [&] { return static_cast<std::int64_t>(pairs_.size()); };
    if (spec.first_party == particle_party || spec.second_party == mesh_party)
      pairs_.emplace_back(spec, false, next());
    if (spec.first_party == mesh_party || spec.second_party == particle_party)
      pairs_.emplace_back(spec, true, next());
  }
}

template <int dim>
void ContactSet<dim>::start(const Faces<dim> &faces)
{
  overlaps_.clear();
  for (auto &pair : pairs_)
  {
    pair.measure(faces, symmetry_axes_);
    pair.update(faces, symmetry_axes_);
    std::vector<Record> found;
    pair.detect_overlaps(faces, found);
    for (auto &record : found)
    {
      begin_contact(faces, pair, record);
      record.offset = record.depth;
    }
    review_overlaps(faces, pair, found);
    for (auto &record : found)
      record.depth = 0;
    state_.records.insert(state_.records.end(), found.begin(), found.end());
  }
  kept_ = state_;
}

template <int dim>
void ContactSet<dim>::review_overlaps(const Faces<dim> &faces, const ContactPair<dim> &pair,
                                      std::span<const Record> found)
{
  // Bodies drawn flush touch within rounding of their coordinates.
  const double   rounding = 1e-6 * pair.half_spacing();
  InitialOverlap overlap{pair.spec().name, 0, 0, Vec3::Zero()};
  for (const auto &record : found)
    if (record.depth > rounding)
    {
      ++overlap.count;
      if (record.depth > overlap.worst)
      {
        overlap.worst = record.depth;
        overlap.where = spatial<dim>(faces.position(pair.point_party(), record.point));
      }
    }
  if (overlap.count == 0)
    return;
  if (overlap.worst > pair.half_spacing())
  {
    std::ostringstream message;
    message << "contact \"" << overlap.contact << "\": the bodies overlap at the start by " << overlap.worst
            << " m at (" << overlap.where.transpose() << ") m, more than half a spacing ("
            << pair.half_spacing() << " m); move them apart";
    throw InputError({"", 0, "Contacts/" + overlap.contact}, message.str());
  }
  overlaps_.push_back(overlap);
}

template <int dim>
void ContactSet<dim>::begin_contact(const Faces<dim> &faces, const ContactPair<dim> &pair,
                                    Record &record) const
{
  double inverse_mass = 1 / faces[pair.point_party()].mass[record.point];
  for (int k = 0; k < record.n; ++k)
    inverse_mass +=
      record.weight[k] * record.weight[k] / faces[pair.other_party()].mass[record.other[k]];
  record.stiffness            = penalty_stiffness(pair.share(), inverse_mass, reference_dt_);
  record.tangential_stiffness = pair.spec().friction > 0 ? record.stiffness : 0;
}

template <int dim>
void ContactSet<dim>::continue_contact(const Faces<dim> &faces, const ContactPair<dim> &pair,
                                       const Record *old, Record &record)
{
  if (old)
  {
    record.stiffness            = old->stiffness;
    record.tangential_stiffness = old->tangential_stiffness;
    record.offset               = std::min(old->offset, record.depth);
  }
  else
    begin_contact(faces, pair, record);
  record.depth -= record.offset;
  record.force = record.stiffness * record.depth * record.normal;

  record.point_velocity = faces.velocity(pair.point_party(), record.point);
  record.other_velocity = carried_velocity(faces, pair.other_party(), record, false);

  if (record.tangential_stiffness > 0)
  {
    Point<dim> spring = Point<dim>::Zero(), slide;
    if (old)
    {
      spring = turned_into_plane<dim>(old->spring, record.normal);
      slide  = across<dim>(old->slide, record.normal);
    }
    else
    {
      // It has slid for as long as it took to get this deep.
      const Point<dim> relative = record.point_velocity - record.other_velocity;
      const double     inwards  = -relative.dot(record.normal) * state_.last_drift;
      const double     part     = inwards > record.depth ? record.depth / inwards : 1;
      slide                     = across<dim>(part * state_.last_drift * relative, record.normal);
    }
    const auto step = coulomb<dim>(spring, slide, record.tangential_stiffness,
                                   pair.spec().friction * record.stiffness * record.depth);
    record.spring = step.spring;
    record.force -= record.tangential_stiffness * step.spring;
    state_.energy.friction_heat += step.heat;
  }
}

template <int dim>
void ContactSet<dim>::end_contact(const Record &record)
{
  if (record.tangential_stiffness > 0)
    state_.energy.friction_heat +=
      coulomb<dim>(record.spring, across<dim>(record.slide, record.normal), record.tangential_stiffness, 0).heat;
}

template <int dim>
void ContactSet<dim>::gather(Faces<dim> &faces)
{
  std::vector<Record> records, found;
  auto                old = state_.records.begin();
  const auto          end = state_.records.end();
  for (auto &pair : pairs_)
  {
    const auto stop =
      std::find_if(old, end, [&](const Record &r) { return r.key.pair != pair.index(); });
    pair.update(faces, symmetry_axes_);
    found.clear();
    pair.detect(faces, {old, stop}, state_.last_drift, found, state_.lost);
    for (auto &record : found)
    {
      for (; old != stop && old->key < record.key; ++old)
        end_contact(*old);
      const bool lasts = old != stop && old->key == record.key;
      continue_contact(faces, pair, lasts ? &*old : nullptr, record);
      if (lasts)
        ++old;
    }
    for (; old != stop; ++old)
      end_contact(*old);
    records.insert(records.end(), found.begin(), found.end());
  }
  state_.records = std::move(records);
  add_forces(faces);
  limit_step(faces);
}

template <int dim>
void ContactSet<dim>::add_forces(Faces<dim> &faces) const
{
  for (const auto &record : state_.records)
  {
    const auto &pair = pairs_[record.key.pair];
    faces.add_force(pair.point_party(), record.point, record.force);
    // The last corner takes what is left, so the sum is the reaction to the bit.
    Point<dim> rest = -record.force;
    for (int k = 0; k + 1 < record.n; ++k)
    {
      const Point<dim> share = -record.weight[k] * record.force;
      faces.add_force(pair.other_party(), record.other[k], share);
      rest -= share;
    }
    faces.add_force(pair.other_party(), record.other[record.n - 1], rest);
  }
}

template <int dim>
void ContactSet<dim>::limit_step(const Faces<dim> &faces)
{
  state_.limit = {};
  if (state_.records.empty())
    return;
  // With K = sum k g g^T, g = (1, -w_I), the row of a point in M^-1 K sums to
  // sum k |g| (1 + sum w_I)/m = sum 2 k |g|/m.
  struct Row
  {
    int           party;
    std::uint32_t point;
    double        square; // share of w^2 in one contact
    auto          place() const { return std::pair(party, point); }
  };
  std::vector<Row> rows;
  for (const auto &record : state_.records)
  {
    const auto &pair = pairs_[record.key.pair];
    const auto  row  = [&](int party, std::uint32_t i, double weight) {
      rows.push_back({party, i, 2 * record.stiffness * weight / faces[party].mass[i]});
    };
    row(pair.point_party(), record.point, 1);
    for (int k = 0; k < record.n; ++k)
      row(pair.other_party(), record.other[k], record.weight[k]);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row &a, const Row &b) { return a.place() < b.place(); });
  double worst = 0;
  for (std::size_t a = 0; a < rows.size();)
  {
    double      sum = 0;
    std::size_t b   = a;
    for (; b < rows.size() && rows[b].place() == rows[a].place(); ++b)
      sum += rows[b].square;
    if (sum > worst)
    {
      worst               = sum;
      const auto &surface = faces[rows[a].party];
      state_.limit.culprit = {"contact", surface.body[rows[a].point], surface.id[rows[a].point],
                              spatial<dim>(faces.position(rows[a].party, rows[a].point)),
                              "stiffness of its contacts against its mass"};
    }
    a = b;
  }
  state_.limit.dt = 2 * std::sqrt((1 - step_share_ * step_share_) / worst);
}

template <int dim>
void ContactSet<dim>::close(const Faces<dim> &faces, const TimeStep &step)
{
  auto &energy  = state_.energy;
  energy.stored = 0;
  state_.last_drift = step.drift;
  for (auto &record : state_.records)
  {
    const auto      &pair = pairs_[record.key.pair];
    const Point<dim> point =
      faces.velocity(pair.point_party(), faces.now(pair.point_party(), record.point, record.key.point));
    const Point<dim> other    = carried_velocity(faces, pair.other_party(), record, true);
    const Point<dim> relative = point - other;

    const double on_point = .5 * step.kick * record.force.dot(point + record.point_velocity);
    const double on_other = -.5 * step.kick * record.force.dot(other + record.other_velocity);
    energy.work[pair.point_party()] += on_point;
    energy.work[pair.other_party()] += on_other;
    energy.taken -= on_point + on_other;
    state_.impulse += step.kick * record.force.norm();

    record.slide      = step.drift * relative;
    const double next = record.depth - record.slide.dot(record.normal);
    energy.stored += .5 * record.stiffness * record.depth * std::max(0., next);
    energy.stored += .5 * record.tangential_stiffness *
                     record.spring.dot(record.spring + across<dim>(record.slide, record.normal));
  }
}

template <int dim>
void ContactSet<dim>::restore()
{
  state_ = kept_;
  for (auto &pair : pairs_)
    pair.forget();
}

template <int dim>
std::size_t ContactSet<dim>::active() const
{
  return static_cast<std::size_t>(std::count_if(state_.records.begin(), state_.records.end(),
                                                [](const Record &r) { return r.depth > 0; }));
}

template <int dim>
Vec3 ContactSet<dim>::force(int a, int b) const
{
  Vec3 sum = Vec3::Zero();
  for (const auto &record : state_.records)
  {
    const auto &pair = pairs_[record.key.pair];
    if (pair.point_body() == a && pair.other_body() == b)
      sum += spatial<dim>(record.force);
    else if (pair.point_body() == b && pair.other_body() == a)
      sum -= spatial<dim>(record.force);
  }
  return sum;
}

template <int dim>
void ContactSet<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<std::int64_t> names;
  std::vector<double>       values;
  for (const auto &r : state_.records)
  {
    names.insert(names.end(), {r.key.pair, r.key.point});
    values.insert(values.end(), {r.stiffness, r.tangential_stiffness, r.offset, r.depth});
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
                                     limit.culprit.where[2]};
  const std::vector<std::int64_t> counts{state_.lost, limit.culprit.body, limit.culprit.id};
  archive.write(prefix + "/contact_totals", totals);
  archive.write(prefix + "/contact_counts", counts);
}

template <int dim>
void ContactSet<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto     names  = archive.integers(prefix + "/contacts");
  const auto     values = archive.doubles(prefix + "/contact_state");
  const auto     totals = archive.doubles(prefix + "/contact_totals");
  const auto     counts = archive.integers(prefix + "/contact_counts");
  constexpr auto width  = static_cast<std::size_t>(4 + 4 * dim);
  const auto     n      = names.size() / 2;
  if (names.size() != 2 * n || values.size() != width * n || totals.size() != 12 || counts.size() != 3)
    throw InputError("the checkpoint's contacts (" + prefix + ") do not belong to this scene");

  State state;
  state.records.resize(n);
  for (std::size_t c = 0; c < n; ++c)
  {
    auto         &r = state.records[c];
    const double *v = values.data() + width * c;
    r.key           = {names[2 * c], names[2 * c + 1]};
    if (r.key.pair < 0 || r.key.pair >= static_cast<std::int64_t>(pairs_.size()))
      throw InputError("the checkpoint holds a contact that the scene does not list");
    r.stiffness            = v[0];
    r.tangential_stiffness = v[1];
    r.offset               = v[2];
    r.depth                = v[3];
    v += 4;
    for (Point<dim> *p : {&r.normal, &r.spring, &r.slide, &r.force})
    {
      *p = Eigen::Map<const Point<dim>>(v);
      v += dim;
    }
  }
  state.energy        = {totals[0], totals[1], totals[2], {totals[3], totals[4]}};
  state.impulse       = totals[5];
  reference_dt_       = totals[6];
  state.last_drift    = totals[7];
  state.limit.dt      = totals[8];
  state.lost          = counts[0];
  state.limit.culprit = {"contact", static_cast<int>(counts[1]), counts[2],
                         Vec3(totals[9], totals[10], totals[11]),
                         "stiffness of its contacts against its mass"};
  kept_               = std::move(state);
  restore();
}

template class ContactSet<1>;
template class ContactSet<2>;
template class ContactSet<3>;
} // namespace ogive::coupling
