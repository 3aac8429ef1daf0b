// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "sph/corrector.h"
#include "sph/implementation.h"

#include <algorithm>
#include <numeric>

/// Particles that come in while a run goes on, and riders.
namespace ogive::sph
{
namespace
{
constexpr std::size_t none = static_cast<std::size_t>(-1);

template <int dim>
std::vector<AlignedVector<double> *> arrays_of(Store<dim> &store)
{
  std::vector<AlignedVector<double> *> all;
  store.for_each_array([&](const std::string &, AlignedVector<double> &a) { all.push_back(&a); });
  return all;
}
} // namespace

template <int dim>
void Solver<dim>::Implementation::size_arrays()
{
  const auto       &o = parameters.options;
  const std::size_t n = store.size();
  wave_number.resize(n);
  radius.resize(n);
  near_surface.resize(n, 0);
  sensor_sums.resize(sensed ? n * SensorLayout<dim>::sums_stride : 0);
  mass_sums.resize(summation ? n * padded(1) : 0);
  mean_sums.resize(correction ? n * L::means_stride : 0);
  reach.resize(variable ? n : 0);
  corrected.resize(o.correction == "shepard" ? n * dim : 0);
  velocity_gradient.resize(n * dim * dim);
  for (auto *hoop : {&hoop_force, &hoop_viscosity, &hoop_weak})
    hoop->resize(parameters.axisymmetric ? n : 0);
  active.resize(n);
  press.resize(n * parameters.walls.size());
}

template <int dim>
auto Solver<dim>::Implementation::body_of(int scene) -> Body &
{
  const auto at = std::find_if(bodies.begin(), bodies.end(), [&](const Body &b) { return b.scene == scene; });
  require(at != bodies.end(), "no particles belong to that body");
  return *at;
}

template <int dim>
void Solver<dim>::Implementation::check_growth() const
{
  const auto &o      = parameters.options;
  const auto  refuse = [](const char *entry, const char *expected) {
    throw InputError({"", 0, std::string("SPH/") + entry},
                      "particles that come in during a run, or complete their neighbourhood in a mesh, do not know it",
                      expected);
  };
  if (reference.on)
    refuse("configuration", "current");
  if (summation)
    refuse("density", "continuity");
  if (variable)
    refuse("support rule", "fixed");
  if (o.artificial_stress > 0)
    refuse("artificial stress", "0");
  if (o.correction == "shepard")
    refuse("correction", "pairwise or none");
}

/// The arrays with `from[k]` (an old index, or none) at k.
template <int dim>
void Solver<dim>::Implementation::rearrange(const std::vector<std::size_t> &from)
{
  Store<dim> old = std::move(store);
  store          = Store<dim>();
  store.in_parts = old.in_parts;
  store.resize(from.size());
  const auto source = arrays_of(old), target = arrays_of(store);
  std::vector<std::int64_t> was_near = near_surface;
  near_surface.assign(from.size(), 1);
  for (std::size_t a = 0; a < source.size(); ++a)
    for (std::size_t k = 0; k < from.size() && !source[a]->empty(); ++k)
      if (from[k] != none)
        (*target[a])[k] = (*source[a])[from[k]];
  for (std::size_t k = 0; k < from.size(); ++k)
    if (from[k] != none)
      near_surface[k] = was_near[from[k]];
  std::vector<std::vector<std::int64_t>> integers;
  old.for_each_integer([&](const char *, const auto &a) { integers.emplace_back(a.begin(), a.end()); });
  auto source_of = integers.cbegin();
  store.for_each_integer([&](const char *, auto &a) {
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] != none)
        a[k] = static_cast<std::decay_t<decltype(a[k])>>((*source_of)[from[k]]);
    ++source_of;
  });
}

template <int dim>
void Solver<dim>::Implementation::put(const Newcomers<dim> &in, const std::vector<std::size_t> &which,
                                      std::size_t first)
{
  const std::size_t n = which.size();
  for (int a = 0; a < dim; ++a)
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::size_t j           = which[k];
      store.x[a][first + k]         = in.x[a][j];
      store.v[a][first + k]         = in.v[a][j];
      if (store.in_parts)
        store.v_strain[a][first + k] = in.v[a][j];
      store.x0[a][first + k]        = in.x0[a][j];
      store.half_cell[a][first + k] = in.half_cell[a][j];
    }
  materials::Points from = in.points;
  std::vector<const AlignedVector<double> *> fields;
  from.for_each_array([&](const char *, AlignedVector<double> &f) { fields.push_back(&f); });
  std::size_t f = 0;
  store.points.for_each_array([&](const char *, AlignedVector<double> &to) {
    for (std::size_t k = 0; k < n; ++k)
      to[first + k] = (*fields[f])[which[k]];
    ++f;
  });
  for (std::size_t k = 0; k < n; ++k)
  {
    store.mass[first + k]          = in.mass[which[k]];
    store.swept_density[first + k] = in.points.density[which[k]];
    store.switch_factor[first + k] = 0;
    store.rest_share[first + k]    = 1;
  }
}

/// Which of the newcomers stand on ground of this rank.
template <int dim>
std::vector<std::size_t> Solver<dim>::Implementation::own_of(const Newcomers<dim> &in) const
{
  std::vector<std::size_t> here;
  for (std::size_t k = 0; k < in.size(); ++k)
  {
    std::array<double, dim> where;
    for (int a = 0; a < dim; ++a)
      where[a] = in.x[a][k];
    if (territory.at(where, ranks.rank()) == ranks.rank())
      here.push_back(k);
  }
  return here;
}

/// Lists, surface and forces at the state in place.
template <int dim>
void Solver<dim>::Implementation::settle()
{
  size_arrays();
  share_out(has_grown());
  sort_particles();
  rebuild_lists();
  touch_walls();
  if (store.in_parts) // as in follow()
    store.v.swap(store.v_strain);
  const StepStatus status = advance_material(0);
  require(status.ok, "the state of the newcomers is sound");
  find_surface();
  forces();
  if (store.in_parts)
    store.v.swap(store.v_strain);
}

/// Newcomers of squeezed elements stand closer to a wall than half of their cell
/// at the start: there they lie. To land them farther out would be a blow.
template <int dim>
void Solver<dim>::Implementation::fit_between_walls(const Body &body, std::size_t first, std::size_t last)
{
  constexpr double least = 1e-3;
  for (std::size_t i = first; i < last; ++i)
    for (std::size_t w = 0; w < parameters.walls.size(); ++w)
    {
      const auto &wall     = parameters.walls[w];
      double      distance = 0;
      for (int a = 0; a < dim; ++a)
        distance += wall.normal[a] * (store.x[a][i] - wall.point[a] - wall.velocity[a] * time);
      const double share = distance / rest_gap(body, i, w);
      store.rest_share[i] *= std::clamp(share, least, 1.);
    }
}

template <int dim>
std::vector<std::int64_t> Solver<dim>::add(const Newcomers<dim> &in)
{
  auto &s = *self_;
  s.check_growth();
  if (in.size() == 0)
    return {};
  auto                          &body = s.body_of(in.body);
  const std::vector<std::size_t> here = s.own_of(in);
  const std::size_t n = s.store.size(), m = here.size(), at = body.last;
  std::int64_t      next = 0;
  for (const std::int64_t id : s.store.id)
    next = std::max(next, id + 1);
  next = s.ranks.max(next);
  std::vector<std::size_t> from;
  for (std::size_t k = 0; k < at; ++k)
    from.push_back(k);
  from.insert(from.end(), m, none);
  for (std::size_t k = at; k < n; ++k)
    from.push_back(k);
  s.rearrange(from);
  s.put(in, here, at);
  std::vector<std::int64_t> ids(in.size());
  std::iota(ids.begin(), ids.end(), next);
  for (std::size_t k = 0; k < m; ++k)
  {
    s.store.id[at + k]   = ids[here[k]];
    s.store.body[at + k] = in.body;
  }
  body.last += m;
  body.all += in.size();
  for (auto &other : s.bodies)
  {
    if (&other != &body && other.first >= at)
    {
      other.first += m;
      other.last += m;
    }
    other.first_rider += m;
    other.last_rider += m;
  }
  s.fit_between_walls(body, at, at + m);
  s.is_slave.resize(s.is_slave.empty() ? 0 : s.is_slave.size() + in.size(), 0);
  for (auto &v : s.slave_velocity)
    v.resize(s.is_slave.size(), 0.);
  s.settle();
  return ids;
}

template <int dim>
void Solver<dim>::set_riders(const Newcomers<dim> &in)
{
  auto &s = *self_;
  s.check_growth();
  auto                          &body = s.body_of(in.body);
  const std::vector<std::size_t> here = s.own_of(in);
  std::vector<std::size_t>       from;
  for (std::size_t k = 0; k < s.n_own(); ++k)
    from.push_back(k);
  std::size_t next = s.n_own(), at = 0;
  for (auto &other : s.bodies)
  {
    const std::size_t old = other.first_rider, last = other.last_rider;
    other.first_rider = next;
    if (&other == &body)
    {
      at = next;
      from.insert(from.end(), here.size(), none);
    }
    else
      for (std::size_t k = old; k < last; ++k)
        from.push_back(k);
    next             = from.size();
    other.last_rider = next;
  }
  s.rearrange(from);
  s.put(in, here, at);
  for (std::size_t k = 0; k < here.size(); ++k)
  {
    s.store.id[at + k]   = -1 - static_cast<std::int64_t>(here[k]);
    s.store.body[at + k] = -1;
  }
  body.all_riders = in.size();
  s.prepare_riders(body);
  s.settle();
}

template <int dim>
void Solver<dim>::Implementation::prepare_riders(Body &body)
{
  for (auto &v : body.rider_velocity)
    v.assign(body.all_riders, 0.);
  body.rider_state = materials::Points();
  body.rider_state.resize(body.all_riders);
  for (std::size_t i = body.first_rider; i < body.last_rider; ++i)
    near_surface[i] = 0;
}

template <int dim>
typename Solver<dim>::Riders Solver<dim>::riders(int body_index)
{
  auto  &body = self_->body_of(body_index);
  Riders r;
  r.n = body.all_riders;
  for (int a = 0; a < dim; ++a)
    r.velocity[a] = body.rider_velocity[a];
  r.state = &body.rider_state;
  return r;
}

template <int dim>
void Solver<dim>::seam_forces(int body_index, const std::array<std::span<double>, dim> &force) const
{
  const auto &s    = *self_;
  const auto &body = self_->body_of(body_index);
  for (int a = 0; a < dim; ++a)
    for (std::size_t i = body.first; i < body.last; ++i)
      force[a][i] = s.seam_pairs(body, i) ? s.seam().forces[i * Layout<dim>::forces_stride + Layout<dim>::f_sum + a] : 0.;
}

template <int dim>
void Solver<dim>::seam_normals(int body_index, const std::array<std::span<double>, dim> &area)
{
  self_->unit_seam(self_->body_of(body_index), area);
}

/// A force sweep over the pairs with riders of records that hold B for sigma B.
template <int dim>
void Solver<dim>::Implementation::unit_seam(const Body &body, const std::array<std::span<double>, dim> &area)
{
  if (body.all_riders == 0)
    return;
  const AlignedVector<double> kept = force_records, kept_pairs = seam().pairs.hourglass;
  const auto                  pack = [&](const Body &b, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      double *record   = &force_records[i * L::force_stride];
      Matrix  b_matrix = Matrix::Identity();
      if (!standard)
        corrector<dim>(moment(i), b_matrix);
      b_matrix *= ring(i) * axis_share(b, i);
      if (standard)
        b_matrix /= ring(i) * ring(i) * store.points.density[i] * store.points.density[i];
      record[L::sound] = 0;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
          record[L::p + a * dim + c] = b_matrix(a, c);
    }
  };
  pack(body, body.first, body.last);
  pack(body, body.first_rider, body.last_rider);
  reflect_forces();
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    force_records[(store.size() + g) * L::force_stride + L::sound] = 0;
  AlignedVector<double> sums(store.size() * L::forces_stride, 0.);
  body.sweeps.force(sweep_of(body, seam().pairs, sums.data()));
  for (int a = 0; a < dim; ++a)
    for (std::size_t i = body.first; i < body.last; ++i)
      area[a][i] = seam_pairs(body, i) ? sums[i * L::forces_stride + L::f_sum + a] : 0.;
  force_records          = kept;
  seam().pairs.hourglass = kept_pairs;
}

template <int dim>
double Solver<dim>::seam_work(int body) const
{
  return self_->ranks.sum(self_->works.seam[static_cast<std::size_t>(&self_->body_of(body) - self_->bodies.data())]);
}

/// Moves the riders of a step: their velocities are those they were given.
template <int dim>
void Solver<dim>::Implementation::kick_riders()
{
  for (const auto &b : bodies)
    for (std::size_t i = b.first_rider; i < b.last_rider; ++i)
    {
      const std::size_t k      = static_cast<std::size_t>(-1 - store.id[i]);
      double           *record = &energy_records[i * L::energy_stride];
      for (int a = 0; a < dim; ++a)
      {
        record[L::x + a] = store.x[a][i];
        record[L::v + a] = .5 * (store.v[a][i] + b.rider_velocity[a][k]);
        store.v[a][i]    = b.rider_velocity[a][k];
      }
      record[L::weight] = weight(i);
    }
}

template <int dim>
void Solver<dim>::Implementation::add_power_at_seam(bool with_forces, double kick)
{
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    const auto &b     = bodies[k];
    double      power = 0;
    for (std::size_t i = b.first; i < b.last && b.all_riders > 0; ++i)
    {
      if (!seam_pairs(b, i))
        continue;
      const double *sums   = &seam().sums[i * L::powers_stride];
      const double *record = &energy_records[i * L::energy_stride];
      power += record[L::weight] * sums[L::stress_power] + .5 * (sums[L::viscous_power] + sums[L::hourglass_power]);
      for (int a = 0; with_forces && a < dim; ++a)
        power += seam().forces[i * L::forces_stride + L::f_sum + a] * record[L::v + a];
    }
    works.seam[k] += kick * power;
  }
}

template <int dim>
std::array<double, dim> Solver<dim>::cell(int body) const
{
  auto cell = self_->body_of(body).half_cell;
  for (double &c : cell)
    c *= 2;
  return cell;
}

template <int dim>
double Solver<dim>::reach(int body) const
{
  return self_->body_of(body).list_radius;
}

template <int dim>
void Solver<dim>::set_seam_hourglass(int body, double coefficient)
{
  const double z = self_->parameters.options.hourglass;
  self_->body_of(body).seam_hourglass = z > 0 ? std::max(1., coefficient / z) : 1.;
}

template <int dim>
void Solver<dim>::Implementation::take_rider_states()
{
  for (auto &b : bodies)
  {
    std::vector<const AlignedVector<double> *> fields;
    b.rider_state.for_each_array([&](const char *, AlignedVector<double> &f) { fields.push_back(&f); });
    std::size_t f = 0;
    store.points.for_each_array([&](const char *, AlignedVector<double> &to) {
      for (std::size_t i = b.first_rider; i < b.last_rider; ++i)
        to[i] = (*fields[f])[static_cast<std::size_t>(-1 - store.id[i])];
      ++f;
    });
  }
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::fit_between_walls(const Body &, std::size_t, std::size_t);        \
  template void Solver<d>::Implementation::size_arrays();                                                    \
  template void Solver<d>::Implementation::rearrange(const std::vector<std::size_t> &);                      \
  template void Solver<d>::Implementation::check_growth() const;                                             \
  template void Solver<d>::Implementation::prepare_riders(Body &);                                           \
  template void Solver<d>::Implementation::kick_riders();                                                    \
  template void Solver<d>::Implementation::add_power_at_seam(bool, double);                                    \
  template std::array<double, d> Solver<d>::cell(int) const;                                                 \
  template double Solver<d>::reach(int) const;                                                               \
  template void Solver<d>::set_seam_hourglass(int, double);                                                  \
  template void Solver<d>::Implementation::take_rider_states();                                              \
  template std::vector<std::int64_t> Solver<d>::add(const Newcomers<d> &);                                   \
  template void                      Solver<d>::set_riders(const Newcomers<d> &);                            \
  template Solver<d>::Riders         Solver<d>::riders(int);                                                 \
  template void   Solver<d>::seam_forces(int, const std::array<std::span<double>, d> &) const;               \
  template void Solver<d>::seam_normals(int, const std::array<std::span<double>, d> &);                      \
  template double Solver<d>::seam_work(int) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
