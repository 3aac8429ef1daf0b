// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/contact.h"

#include "core/base/error.h"
#include "coupling/laws.h"

#include <algorithm>
#include <utility>

namespace ogive::coupling
{
namespace
{
/// Velocity of a carrier as the point sees it: of its image, if it is one.
template <int dim>
Point<dim> seen_velocity(const Faces<dim> &faces, Party party, const Carrier<dim> &carrier)
{
  return carrier.sign.cwiseProduct(faces.velocity(party, faces.now(party, carrier.index, carrier.id)));
}
} // namespace

template <int dim>
ContactSet<dim>::ContactSet(std::vector<ContactSpec> specs, std::vector<int> symmetry_axes,
                            double reference_dt, double step_share, const Ranks &ranks)
  : ranks_(ranks)
  , symmetry_axes_(std::move(symmetry_axes))
  , reference_dt_(reference_dt)
  , step_share_(step_share)
{
  require(specs.empty() || (reference_dt > 0 && std::isfinite(reference_dt)),
          "contact needs a reference step > 0");
  for (const auto &spec : specs)
  {
    const auto next = [&] { return static_cast<std::int64_t>(pairs_.size()); };
    const bool particles = spec.first_party == particle_party && spec.second_party == particle_party;
    if (spec.first_party == particle_party || spec.second_party == mesh_party)
      pairs_.emplace_back(spec, false, Meeting::surface, next());
    if (!spec.meets_itself() && (spec.first_party == mesh_party || particles))
      pairs_.emplace_back(spec, true, Meeting::surface, next());
    if (particles)
      pairs_.emplace_back(spec, false, Meeting::balls, next());
    if (spec.meets_itself() && particles)
      fragments_.emplace_back(spec.first, spec.joined_within, spec.joined_at_start);
  }
  told_.assign(fragments_.size(), 0);
  for (auto &pair : pairs_)
    pair.share_points(ranks_);
}

template <int dim>
void ContactSet<dim>::begin_contact(const Faces<dim> &faces, const ContactPair<dim> &pair, const List &list,
                                    Record &record) const
{
  // What a point has of its own share of the leapfrog's limit, over what one
  // contact takes of it; a tenth is kept back.
  const double room    = .9 * 2 * (1 - step_share_ * step_share_) / .1;
  const double inverse = std::max(pair.inverse_mass(faces, list, record),
                                  pair.crowded_inverse_mass(faces, list, record) / room);
  record.stiffness            = penalty_stiffness(pair.share(), inverse, reference_dt_);
  record.tangential_stiffness = pair.spec().friction > 0 ? record.stiffness : 0;
}

template <int dim>
Point<dim> ContactSet<dim>::force_on(const Carrier<dim> &carrier, const Record &record)
{
  const Point<dim> friction = record.tangential_stiffness * record.spring;
  return carrier.sign.cwiseProduct(carrier.weight * friction - record.stiffness * record.depth * carrier.slope);
}

template <int dim>
void ContactSet<dim>::continue_contact(const Faces<dim> &faces, const ContactPair<dim> &pair,
                                       const Record *old, const List &list, Record &record)
{
  if (old)
  {
    record.stiffness            = old->stiffness;
    record.tangential_stiffness = old->tangential_stiffness;
    record.offset               = std::min(std::max(old->offset, record.offset), record.depth);
  }
  else
    begin_contact(faces, pair, list, record);
  record.depth -= record.offset;
  record.force          = record.stiffness * record.depth * record.slope;
  record.point_velocity = faces.velocity(pair.point_party(), record.point);

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
      Point<dim> relative = record.point_velocity;
      for (const auto &carrier : list.of(record))
        relative -= carrier.weight * seen_velocity(faces, pair.other_party(), carrier);
      const double inwards = -relative.dot(record.normal) * state_.last_drift;
      const double part    = inwards > record.depth ? record.depth / inwards : 1;
      slide                = across<dim>(part * state_.last_drift * relative, record.normal);
    }
    const auto step = coulomb<dim>(spring, slide, record.tangential_stiffness,
                                   pair.spec().friction * record.force.norm());
    record.spring = step.spring;
    record.force -= record.tangential_stiffness * step.spring;
    state_.energy.friction_heat += step.heat;
  }
  for (const auto &carrier : list.of(record))
    record.carrier_power += force_on(carrier, record)
                              .dot(carrier.sign.cwiseProduct(seen_velocity(faces, pair.other_party(), carrier)));
}

template <int dim>
double ContactSet<dim>::gained(const Faces<dim> &faces, const ContactPair<dim> &pair, const List &list,
                               const Record &record) const
{
  Point<dim> relative = faces.velocity(pair.point_party(), record.point);
  for (const auto &carrier : list.of(record))
    relative -= carrier.weight * seen_velocity(faces, pair.other_party(), carrier);
  return std::max(0., -relative.dot(record.normal) * state_.last_drift);
}

template <int dim>
void ContactSet<dim>::bridge_jump(const Faces<dim> &faces, const ContactPair<dim> &pair, const Record *old,
                                  bool death, const List &list, Record &record)
{
  const double small = .01 * pair.half_spacing(); // less than that is no other facet
  const double due   = old ? std::max(0., old->next) : gained(faces, pair, list, record);
  const double jump  = record.depth - (old ? std::min(old->offset, record.depth) : 0) - due;
  if (jump > small)
    record.offset = record.depth - due;
  else if (old && death && jump < -small)
    state_.energy.eroded += .5 * old->stiffness * (due * due - (due + jump) * (due + jump));
}

template <int dim>
void ContactSet<dim>::end_contact(const Record &record, bool death)
{
  if (death)
    state_.energy.eroded += .5 * record.stiffness * record.depth * std::max(0., record.next);
  if (record.tangential_stiffness > 0)
    state_.energy.friction_heat +=
      coulomb<dim>(record.spring, across<dim>(record.slide, record.normal), record.tangential_stiffness, 0).heat;
}

template <int dim>
void ContactSet<dim>::gather(Faces<dim> &faces)
{
  const bool death = std::exchange(state_.topology, faces[mesh_party].topology) != faces[mesh_party].topology;
  state_.died |= death;
  std::vector<int> broken; // bodies with new fragments
  for (auto &fragments : fragments_)
    if (fragments.update(faces))
      broken.push_back(fragments.body());
  List        list = detect(faces);
  auto        old  = state_.list.records.begin();
  const auto  end  = state_.list.records.end();
  std::size_t k    = 0;
  for (auto &pair : pairs_)
  {
    const auto stop =
      std::find_if(old, end, [&](const Record &r) { return r.key.pair != pair.index(); });
    const bool bridge = state_.died || (pair.spec().meets_itself() &&
                                  std::find(broken.begin(), broken.end(), pair.point_body()) != broken.end());
    for (; k < list.records.size() && list.records[k].key.pair == pair.index(); ++k)
    {
      Record &record = list.records[k];
      for (; old != stop && old->key < record.key; ++old)
        end_contact(*old, death);
      const bool lasts = old != stop && old->key == record.key;
      if (bridge)
        bridge_jump(faces, pair, lasts ? &*old : nullptr, death, list, record);
      continue_contact(faces, pair, lasts ? &*old : nullptr, list, record);
      if (lasts)
        ++old;
    }
    for (; old != stop; ++old)
      end_contact(*old, death);
  }
  state_.list = std::move(list);
  add_forces(faces);
  limit_step(faces);
}

template <int dim>
void ContactSet<dim>::add_forces(Faces<dim> &faces) const
{
  for (const auto &record : state_.list.records)
  {
    const auto &pair = pairs_[record.key.pair];
    faces.add_force(pair.point_party(), record.point, record.force);
    // Without images the last carrier takes what is left, so the sum is the
    // reaction to the bit.
    Point<dim>   rest    = -record.force;
    const auto   carried = state_.list.of(record);
    const bool   images  = std::any_of(carried.begin(), carried.end(),
                                       [](const auto &c) { return c.sign != Point<dim>::Ones(); });
    for (std::size_t k = 0; k < carried.size(); ++k)
    {
      const Point<dim> share = k + 1 < carried.size() || images ? force_on(carried[k], record) : rest;
      faces.add_force(pair.other_party(), carried[k].index, share);
      rest -= share;
    }
  }
}

template <int dim>
void ContactSet<dim>::limit_step(const Faces<dim> &faces)
{
  state_.limit = {};
  if (state_.list.records.empty())
    return;
  // With K = sum k g g^T, g = (s, -s_I), s = sum s_I, the row of a point in
  // M^-1 K sums to sum k |g| (|s| + sum |s_I|)/m; over facets |s| = 1, s_I = w_I.
  struct Row
  {
    int           party;
    std::uint32_t point;
    double        square; // share of w^2 in one contact
    auto          place() const { return std::pair(party, point); }
  };
  std::vector<Row> rows;
  for (const auto &record : state_.list.records)
  {
    const auto &pair  = pairs_[record.key.pair];
    const double own  = record.slope.norm();
    double       size = own;
    for (const auto &carrier : state_.list.of(record))
      size += carrier.slope.norm();
    const auto row = [&](int party, std::uint32_t i, double slope) {
      rows.push_back({party, i, size * record.stiffness * slope / faces[party].mass[i]});
    };
    row(pair.point_party(), record.point, own);
    for (const auto &carrier : state_.list.of(record))
      row(pair.other_party(), carrier.index, carrier.slope.norm());
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
  for (auto &record : state_.list.records)
  {
    const auto      &pair = pairs_[record.key.pair];
    const Point<dim> point =
      faces.velocity(pair.point_party(), faces.now(pair.point_party(), record.point, record.key.point));
    Point<dim> other = Point<dim>::Zero(), force = record.force;
    double     closing = 0, power = record.carrier_power;
    for (const auto &carrier : state_.list.of(record))
    {
      const Point<dim> seen = seen_velocity(faces, pair.other_party(), carrier), on = force_on(carrier, record);
      other += carrier.weight * seen;
      closing -= carrier.slope.dot(point - seen);
      power += on.dot(carrier.sign.cwiseProduct(seen));
      force += on;
    }
    if (std::any_of(symmetry_axes_.begin(), symmetry_axes_.end(), [](int axis) { return axis < dim; }))
      state_.plane_impulse += step.kick * force;

    const double on_point = .5 * step.kick * record.force.dot(point + record.point_velocity);
    const double on_other = .5 * step.kick * power;
    energy.work[pair.point_party()] += on_point;
    energy.work[pair.other_party()] += on_other;
    energy.taken -= on_point + on_other;
    state_.impulse += step.kick * record.force.norm();

    record.slide      = step.drift * (point - other);
    const double next = record.depth + step.drift * closing;
    record.next       = next;
    energy.stored += .5 * record.stiffness * record.depth * std::max(0., next);
    energy.stored += .5 * record.tangential_stiffness *
                     record.spring.dot(record.spring + across<dim>(record.slide, record.normal));
  }
}

template <int dim>
const Fragments<dim> *ContactSet<dim>::fragments_of(const ContactPair<dim> &pair) const
{
  if (pair.spec().meets_itself() && pair.point_party() == particle_party)
    for (const auto &fragments : fragments_)
      if (fragments.body() == pair.point_body())
        return &fragments;
  return nullptr;
}

template <int dim>
std::vector<std::int64_t> ContactSet<dim>::new_pieces()
{
  bool fresh = false;
  for (std::size_t f = 0; f < fragments_.size(); ++f)
    fresh |= std::exchange(told_[f], fragments_[f].version()) != fragments_[f].version();
  std::vector<std::int64_t> pieces;
  for (std::size_t f = 0; fresh && f < fragments_.size(); ++f)
  {
    const auto label = fragments_[f].label();
    pieces.resize(std::max(pieces.size(), label.size()), Fragments<dim>::unknown);
    for (std::size_t i = 0; i < label.size(); ++i)
      pieces[i] = std::max(pieces[i], label[i]);
  }
  return pieces;
}

template <int dim>
std::size_t ContactSet<dim>::active() const
{
  return static_cast<std::size_t>(std::count_if(state_.list.records.begin(), state_.list.records.end(),
                                                [](const Record &r) { return r.depth > 0; }));
}

template <int dim>
Vec3 ContactSet<dim>::force(int a, int b) const
{
  Vec3 sum = Vec3::Zero();
  if (a == b)
    return sum;
  for (const auto &record : state_.list.records)
  {
    const auto &pair = pairs_[record.key.pair];
    if (pair.point_body() == a && pair.other_body() == b)
      sum += spatial<dim>(record.force);
    else if (pair.point_body() == b && pair.other_body() == a)
      sum -= spatial<dim>(record.force);
  }
  return sum;
}

template class ContactSet<1>;
template class ContactSet<2>;
template class ContactSet<3>;
} // namespace ogive::coupling
