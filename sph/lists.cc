// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <algorithm>

namespace ogive::sph
{
template <int dim>
void Solver<dim>::Implementation::sort_particles()
{
  std::array<std::span<const double>, dim> x;
  for (int a = 0; a < dim; ++a)
    x[a] = store.x[a];
  std::vector<std::uint32_t> order;
  for (const auto &b : bodies)
  {
    const auto part = morton_order<dim>(x, b.first, b.last, b.spacing, store.id);
    order.insert(order.end(), part.begin(), part.end());
  }
  for_each_rider_range([&](const Body &b, std::size_t first, std::size_t last) {
    const auto part = morton_order<dim>(x, first, last, b.spacing, store.id);
    order.insert(order.end(), part.begin(), part.end());
  });
  bool sorted = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    sorted &= order[k] == k;
  if (!sorted || !ranks.alone()) // of other ranks' particles one says what all say
  {
    store.permute(order);
    std::vector<std::int64_t> old = near_surface;
    for (std::size_t k = 0; k < order.size(); ++k)
      near_surface[k] = old[order[k]];
    ++topology;
  }
  for (int a = 0; a < dim; ++a)
    store.x_listed[a] = store.x[a];
  time_listed = time;
}

template <int dim>
void Solver<dim>::Implementation::list_ghosts(PerAxis<std::vector<double>> &x,
                                              std::vector<std::array<std::size_t, 2>> &images_of_riders)
{
  const std::size_t n = store.size();
  std::array<std::span<const double>, dim> view;
  const auto place = [&] { // new ghosts
    for (std::size_t g = x[0].size() - n; g < ghosts.size(); ++g)
      for (int a = 0; a < dim; ++a)
        x[a].push_back(ghosts.sign[g][a] * x[a][ghosts.parent[g]] + shift(g, a, time_listed));
  };
  const auto mirror = [&](std::size_t k, bool rides, std::size_t first, std::size_t last) {
    const std::size_t begin  = ghosts.size();
    const auto        guests = place_guests(k, rides, x);
    for (int a = 0; a < dim; ++a)
      view[a] = x[a];
    ghosts.append<dim>(view, begin, {{{first, last}, guests}}, bodies[k].list_radius, parameters.symmetry,
                       parameters.mirrors);
    place();
    return guests;
  };
  call_guests();
  std::vector<std::array<std::size_t, 2>> guests;
  for (std::size_t k = 0; k < bodies.size(); ++k)
    guests.push_back(mirror(k, false, bodies[k].first, bodies[k].last));
  for (auto &m : images)
  {
    for (int a = 0; a < dim; ++a)
      view[a] = x[a];
    append_images(m, view, guests);
    place();
  }
  for (std::size_t k = 0; k < bodies.size() && any_riders(); ++k)
  {
    mirror(k, true, bodies[k].first_rider, bodies[k].last_rider);
    images_of_riders.push_back(ghosts.range.back());
  }
  guest_id.resize(ghosts.size(), 0);
  seat_guests();
}

template <int dim>
void Solver<dim>::Implementation::rebuild_lists()
{
  const std::size_t n = store.size();
  // Joint forces know no shares and one sound speed a particle.
  joint = joint_possible() && energy_share.empty() &&
          std::all_of(bodies.begin(), bodies.end(), [](const Body &b) { return b.seam_hourglass == 1; });
  ghosts.clear();
  find_near_walls();
  const bool listed_riders = !images.empty() && images.back().bits == 0;
  if (any_riders() && !listed_riders)
    images.emplace_back();
  if (!any_riders() && listed_riders)
    images.pop_back();
  PerAxis<std::vector<double>>            x;
  std::vector<std::array<std::size_t, 2>> images_of_riders;
  for (int a = 0; a < dim; ++a)
    x[a].assign(store.x_listed[a].begin(), store.x_listed[a].end());
  list_ghosts(x, images_of_riders);
  const std::size_t all = n + ghosts.size();
  active.assign(all, 0);

  std::array<std::span<const double>, dim> view;
  for (int a = 0; a < dim; ++a)
    view[a] = x[a];
  pairs.rows.clear();
  for (std::size_t k = 0; k < bodies.size(); ++k)
    append_rows<dim>(view, bodies[k].first, bodies[k].last, n + ghosts.range[k][0], n + ghosts.range[k][1],
                     bodies[k].list_radius, static_cast<std::uint32_t>(all), pairs.rows);
  list_images(view);
  if (any_riders())
    list_riders(view, images_of_riders);
  part_pieces(pairs.rows);
  pieces_stale = false;
  if (joint)
    halve(pairs.rows, n_own());

  // One record more: the zeros that fill up the rows.
  force_records.assign((all + 1) * L::force_stride, 0.);
  viscous_records.assign(joint ? 0 : (all + 1) * viscous_stride, 0.);
  viscous_sums.resize(joint ? 0 : n * V::sums_stride);
  // Half sweeps write sums of whatever a row names.
  const std::size_t summed = joint ? all + 1 : n;
  gradient_sums.resize(n * L::gradient_stride);
  force_sums.resize(summed * L::forces_stride);
  power_sums.resize(summed * L::powers_stride);
  correction_records.assign((all + 1) * (variable ? L::wide_correction_stride : L::correction_stride), 0.);
  if (sensed)
    sensor_records.assign((all + 1) * SensorLayout<dim>::stride, 0.);
  if (parameters.options.artificial_stress > 0)
    stress_records.assign((all + 1) * StressLayout<dim>::stride, 0.);
  record_damage.assign(all + 1, 0.);
  energy_records.assign((all + 1) * L::energy_stride, 0.);
  size_pairs(pairs);
  find_blocks();
  index_of_id.assign(n_all(), Solver::elsewhere);
  for (std::size_t i = 0; i < n_own(); ++i)
    index_of_id[store.id[i]] = static_cast<std::uint32_t>(i);
  for (const auto &b : bodies)
    std::fill(radius.begin() + b.first, radius.begin() + b.last, .5 * b.spacing);
  diagnostics.own   = n_own();
  diagnostics.pairs = pairs.rows.pairs;
  for (const auto &m : images)
    diagnostics.pairs += m.pairs.rows.pairs;
  ++diagnostics.rebuilds;
  if (reference.on)
    set_reference();
}

template <int dim>
void Solver<dim>::Implementation::size_pairs(Pairs &p) const
{
  const std::size_t n = p.rows.half.empty() ? p.rows.index.size() : p.rows.half_at.back();
  p.hourglass.resize(n);
  if (!correction || parameters.options.shock_split != "none")
    p.viscosity.resize(n * viscous_terms);
  if (is_used(&SweepFunctions::weak_power))
    p.weak.resize(n * viscous_terms);
}

template <int dim>
void Solver<dim>::Implementation::list_images(const std::array<std::span<const double>, dim> &x)
{
  const std::size_t n = store.size();
  for (auto &m : images)
  {
    if (m.bits == 0) // riders
      continue;
    m.pairs.rows.clear();
    bool any = false;
    for (std::size_t k = 0; k < bodies.size(); ++k)
    {
      any = any || m.range[k][0] < m.range[k][1];
      append_rows<dim>(x, bodies[k].first, bodies[k].last, n + m.range[k][0], n + m.range[k][1],
                       bodies[k].list_radius, static_cast<std::uint32_t>(n + ghosts.size()), m.pairs.rows, true);
    }
    part_pieces(m.pairs.rows);
    size_pairs(m.pairs);
    m.sums.assign(any ? n * std::max({L::gradient_stride, L::forces_stride, V::sums_stride, L::means_stride}) : 0, 0.);
    m.forces.assign(any ? n * L::forces_stride : 0, 0.);
  }
}

template <int dim>
void Solver<dim>::Implementation::part_pieces(NeighbourRows &rows) const
{
  if (pieces.empty())
    return;
  const auto dummy = static_cast<std::uint32_t>(store.size() + ghosts.size());
  const auto piece = [&](std::uint32_t i) {
    const auto id = static_cast<std::size_t>(id_of_record(i)); // riders: negative, beyond all
    return id < pieces.size() ? pieces[id] : -1;
  };
  NeighbourRows kept;
  for (std::uint32_t i = 0; i + 1 < rows.row.size(); ++i)
  {
    const std::int64_t own = piece(i);
    for (std::size_t k = rows.row[i]; k < rows.row[i + 1]; ++k)
      if (const std::uint32_t j = rows.index[k]; j != dummy)
        if (const std::int64_t other = piece(j); own < 0 || other < 0 || own == other)
          kept.index.push_back(j);
    kept.pairs += kept.index.size() - kept.row.back();
    while (kept.index.size() % simd_width != 0)
      kept.index.push_back(dummy);
    kept.row.push_back(kept.index.size());
  }
  rows = std::move(kept);
}

/// Rows of the riders over all of their body, and of the particles over the
/// riders.
template <int dim>
void Solver<dim>::Implementation::list_riders(const std::array<std::span<const double>, dim> &x,
                                              const std::vector<std::array<std::size_t, 2>> &images_of_riders)
{
  const std::size_t n     = store.size();
  const auto        dummy = static_cast<std::uint32_t>(n + ghosts.size());
  Images           &m     = seam();
  m.pairs.rows.clear();
  m.range.clear();
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    const Body                &b = bodies[k];
    std::vector<std::uint32_t> riders, all;
    const auto                 list = [](std::vector<std::uint32_t> &to, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        to.push_back(static_cast<std::uint32_t>(i));
    };
    m.range.push_back({0, b.all_riders});
    list(riders, b.first_rider, b.last_rider);
    list(riders, n + images_of_riders[k][0], n + images_of_riders[k][1]);
    append_rows_of<dim>(x, b.first, b.last, riders, b.list_radius, dummy, m.pairs.rows);
    all = riders;
    list(all, b.first, b.last);
    list(all, n + ghosts.range[k][0], n + ghosts.range[k][1]);
    append_rows_of<dim>(x, b.first_rider, b.last_rider, all, b.list_radius, dummy, pairs.rows);
  }
  part_pieces(m.pairs.rows);
  size_pairs(m.pairs);
  m.sums.assign(n * std::max({L::gradient_stride, L::forces_stride, V::sums_stride, L::means_stride, SensorLayout<dim>::sums_stride}), 0.);
  m.forces.assign(n * L::forces_stride, 0.);
}

template <int dim>
void Solver<dim>::Implementation::pack_motion()
{
  find_active();
  for (std::size_t i = 0; i < store.size(); ++i)
  {
    double r[L::n_motion];
    for (int a = 0; a < dim; ++a)
    {
      r[L::x + a] = store.x[a][i];
      r[L::v + a] = store.v[a][i];
    }
    r[L::weight]  = weight(i);
    r[L::density] = plane_density(i);
    note_motion(i, r);
  }
  if (reference.on)
    pack_lattice();
  reflect_motion();
}

template <int dim>
void Solver<dim>::Implementation::reflect_motion()
{
  exchange(force_records, L::force_stride, 0, L::n_motion);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &force_records[ghosts.parent[g] * L::force_stride];
    double       *to   = &force_records[(store.size() + g) * L::force_stride];
    for (int a = 0; a < dim; ++a)
    {
      to[L::x + a] = ghosts.sign[g][a] * from[L::x + a] + shift(g, a, time);
      to[L::v + a] = ghosts.turn[g] * ghosts.sign[g][a] * from[L::v + a] + shift_rate(g, a);
    }
    to[L::weight]  = share(g) * from[L::weight];
    to[L::density] = from[L::density];
  }
}

template <int dim>
void Solver<dim>::Implementation::reflect_forces()
{
  exchange(force_records, L::force_stride, L::n_motion, L::force_stride);
  if (std::any_of(bodies.begin(), bodies.end(), [](const Body &b) { return b.material->parameters().damage.law != "none"; }))
    exchange(record_damage, 1, 0, 1);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &force_records[ghosts.parent[g] * L::force_stride];
    double       *to   = &force_records[(store.size() + g) * L::force_stride];
    const auto   &s    = ghosts.sign[g];
    to[L::sound]       = from[L::sound];
    record_damage[store.size() + g] = record_damage[ghosts.parent[g]];
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
      {
        const double sign          = ghosts.turn[g] * s[a] * s[b];
        to[L::p + a * dim + b]     = sign * from[L::p + a * dim + b];
        to[L::rate + L::sym(a, b)] = sign * from[L::rate + L::sym(a, b)];
      }
  }
}

template <int dim>
void Solver<dim>::Implementation::reflect_shares()
{
  exchange(force_records, L::force_stride, L::sound, L::sound + 1);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    image_record(force_records, L::force_stride, g)[L::sound] = force_records[ghosts.parent[g] * L::force_stride + L::sound];
}

template <int dim>
Sweep Solver<dim>::Implementation::sweep_of(const Body &b, Pairs &p, double *sums)
{
  const auto &o = parameters.options;
  Sweep       s;
  s.begin              = b.first;
  s.end                = b.last;
  s.row                = p.rows.row.data();
  s.index              = p.rows.index.data();
  s.half               = p.rows.half.data();
  s.half_at            = p.rows.half_at.data();
  s.damage             = record_damage.data();
  s.force_records      = force_records.data();
  s.correction_records = correction_records.data();
  s.energy_records     = energy_records.data();
  s.sums               = sums;
  s.viscous_records    = viscous_records.data();
  s.sensor_records     = sensor_records.data();
  s.stress_records     = stress_records.data();
  s.reference_records  = reference.records.data();
  s.deformation        = reference.deformation.data();
  s.pair_slope         = reference.slope.data();
  s.pair_viscous_slope = reference.viscous_slope.data();
  s.pair_hourglass     = p.hourglass.data();
  s.viscosity_step     = !p.viscosity.empty();
  s.weak_step          = !p.weak.empty();
  s.pair_viscosity     = s.viscosity_step ? p.viscosity.data() : unasked.data();
  s.pair_weak          = s.weak_step ? p.weak.data() : unasked.data();
  s.n_entries          = p.rows.index.size();
  s.spacing            = b.spacing;
  s.keep_weak          = correction ? 0 : 1;
  s.compressed_only    = parameters.options.viscosity_switch != "divergence-gradient";
  s.h                  = b.h;
  s.alpha              = o.alpha;
  s.beta               = o.beta;
  s.hourglass          = o.hourglass;
  s.support            = o.correction_support;
  s.direct_share       = shares.viscosity;
  s.weak_share         = shares.weak;
  s.hourglass_share    = shares.hourglass;
  return s;
}

/// The same over its riders.
template <int dim>
Sweep Solver<dim>::Implementation::rider_sweep_of(const Body &b, double *sums)
{
  Sweep s = sweep_of(b, pairs, sums);
  if (joint) // nobody asks for the numbers of the riders' pairs
  {
    s.pair_hourglass = s.pair_viscosity = unasked.data();
    s.hourglass_step = s.viscosity_step = 0;
  }
  s.begin = b.first_rider;
  s.end   = b.last_rider;
  return s;
}

template <int dim>
std::size_t Solver<dim>::Implementation::bytes() const
{
  std::size_t numbers = 0;
  const_cast<Store<dim> &>(store).for_each_array([&](const std::string &, const auto &a) { numbers += a.size(); });
  for (const auto *a :
       {&force_records, &viscous_records, &sensor_records, &stress_records, &correction_records, &energy_records,
        &record_damage, &gradient_sums, &mass_sums, &sensor_sums, &force_sums, &viscous_sums, &mean_sums, &power_sums,
        &velocity_gradient, &reach, &corrected, &wave_number, &radius, &pairs.hourglass, &pairs.viscosity, &pairs.weak})
    numbers += a->size();
  const std::size_t words = pairs.rows.row.size() + pairs.rows.half.size() + pairs.rows.half_at.size() +
                            4 * store.size() + near_surface.size() + active.size(); // id, fixed, touch, body
  return 8 * (numbers + words) + 4 * (pairs.rows.index.size() + index_of_id.size());
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void  Solver<d>::Implementation::part_pieces(NeighbourRows &) const;                              \
  template void  Solver<d>::Implementation::list_riders(const std::array<std::span<const double>, d> &,      \
                                                        const std::vector<std::array<std::size_t, 2>> &);    \
  template Sweep Solver<d>::Implementation::rider_sweep_of(const Body &, double *);                          \
  template std::size_t Solver<d>::Implementation::bytes() const;                                             \
  template void  Solver<d>::Implementation::sort_particles();                                                \
  template void  Solver<d>::Implementation::rebuild_lists();                                                 \
  template void  Solver<d>::Implementation::size_pairs(Pairs &) const;                                       \
  template void  Solver<d>::Implementation::list_images(const std::array<std::span<const double>, d> &);     \
  template void  Solver<d>::Implementation::pack_motion();                                                   \
  template void  Solver<d>::Implementation::reflect_motion();                                                \
  template void  Solver<d>::Implementation::reflect_shares();                                                \
  template void  Solver<d>::Implementation::reflect_forces();                                                \
  template Sweep Solver<d>::Implementation::sweep_of(const Body &, Pairs &, double *);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
