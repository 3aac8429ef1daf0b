// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/solver.h"

#include "core/base/error.h"
#include "sph/agree.h"
#include "sph/implementation.h"
#include "sph/kernels/kernels.h"
#include "sph/state.h"
#include "sph/together.h"
#include "sph/viscosity/viscosities.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <ctime>

namespace ogive::sph
{
namespace
{
/// Share of h that particles may move apart before the lists are built again.
constexpr double skin_over_h = .12;

void check(const input::SphOptions &o)
{
  const auto one_of = [](const char *entry, const std::string &value, std::initializer_list<const char *> names) {
    std::string expected;
    for (const char *name : names)
    {
      if (value == name)
        return;
      expected += (expected.empty() ? "" : ", ") + std::string(name);
    }
    throw InputError({"", 0, std::string("SPH/") + entry}, "unknown value \"" + value + "\"", "one of " + expected);
  };
  one_of("form", o.form, {"standard", "corrected"});
  one_of("configuration", o.configuration, {"current", "reference"});
  one_of("density", o.density, {"continuity", "summation"});
  one_of("limiter", o.limiter, {"none", "linear"});
  one_of("switch", o.viscosity_switch, {"none", "balsara", "cullen-dehnen", "divergence-gradient"});
  one_of("correction", o.correction, {"none", "pairwise", "shepard"});
  one_of("support rule", o.support_rule, {"fixed", "total-variation", "minimal-dissipation", "monotonicity"});
  one_of("shock split", o.shock_split, {"none", "compression", "sharp", "curvature"});
  one_of("energy form", o.energy_form, {"compatible", "working", "averaged"});
  if ((o.correction == "shepard") == (o.energy_form == "compatible"))
    throw InputError({"", 0, "SPH/energy form"},
                     "\"" + o.energy_form + "\" does not go with correction = " + o.correction,
                     "working or averaged with shepard, compatible with all else");
  if (!(o.h_over_dx >= .6 && o.h_over_dx <= 4))
    throw InputError({"", 0, "SPH/h over dx"}, "out of range", "a number from .6 to 4");
  if (!(o.correction_support > 0 && o.correction_support <= 4))
    throw InputError({"", 0, "SPH/correction support"}, "out of range", "a number > 0 and <= 4");
}

Parameters settled(Parameters p)
{
  p.options = p.options.settled();
  return p;
}
} // namespace

template <int dim>
Solver<dim>::Implementation::Implementation(const Parameters &p, std::vector<BodyParticles<dim>> filled)
  : parameters(settled(p))
  , ranks(parameters.ranks)
  , standard(parameters.options.form == "standard")
  , correction(parameters.options.correction != "none")
  , summation(parameters.options.density == "summation")
  , variable(correction && parameters.options.support_rule != "fixed")
  , sensed(parameters.options.shock_split == "sharp" || parameters.options.shock_split == "curvature" || parameters.options.viscosity_switch == "divergence-gradient")
{
  const auto &o = parameters.options;
  check(o);
  reference.on = o.configuration == "reference";
  require(p.boundaries.size() == p.boundary_bodies.size(), "one body per boundary");
  require(p.mirrors.empty() || (p.walls.empty() && !reference.on), "mirrors go without walls and reference configuration");
  shares        = lattice_shares<dim>(o);
  joint         = joint_possible();
  if (p.axisymmetric)
  {
    require(dim == 2, "axial symmetry has two coordinates");
    if (summation)
      throw InputError({"", 0, "SPH/density"}, "the sum over masses is blind to the distance from the axis",
                       "continuity in an axisymmetric scene");
    parameters.symmetry.push_back({0}); // mirror images beyond the axis
    axis_factor.emplace(o.kernel);
  }
  with_viscosity<dim>(o.viscosity, [&](auto v) {
    viscous_terms  = decltype(v)::n_terms;
    viscous_stride = V::stride(decltype(v)::n_fields, o.limiter != "none");
  });
  std::vector<std::size_t> all;
  for (const auto &f : filled)
    all.push_back(f.x.size());
  const auto  ids = take_own(filled);
  std::size_t n   = 0;
  for (const auto &f : filled)
  {
    Body b;
    b.scene    = f.body;
    b.all      = all[bodies.size()];
    b.first    = n;
    b.last     = n += f.x.size();
    b.spacing  = f.spacing;
    for (int a = 0; a < dim; ++a)
      b.half_cell[a] = .5 * (f.cell[a] > 0 ? f.cell[a] : f.spacing);
    b.h        = o.h_over_dx * f.spacing;
    b.skin     = reference.on ? 0. : skin_over_h * b.h;
    b.material = f.material;
    b.grows    = f.grows;
    with_kernel(o.kernel, [&](auto k) {
      using Kernel   = decltype(k);
      b.list_radius  = Kernel::support * b.h * (correction ? std::max(1., o.correction_support) : 1.) + b.skin;
      b.self_value   = KernelAt<Kernel, dim>(b.h * o.correction_support).value(0.);
      b.centre_value = KernelAt<Kernel, dim>(b.h).value(0.);
    });
    b.sweeps = choose_sweeps<dim>({standard, f.material->parameters().damage.law != "none", o.kernel, o.viscosity,
                                   o.limiter != "none", o.correction, variable,
                                   !correction || o.shock_split != "none", reference.on, joint});
    if (!(o.artificial_stress > 0))
      b.sweeps.artificial_stress = b.sweeps.artificial_stress_power = nullptr;
    bodies.push_back(b);
  }
  for (auto &b : bodies)
    b.first_rider = b.last_rider = n;
  store.resize(n);
  size_arrays();
  wall_forces.resize(p.walls.size());
  friction_share.resize(p.walls.size());
  works.pull.resize(p.walls.size());
  works.seam.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    const auto &b = bodies[k];
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      for (int a = 0; a < dim; ++a)
      {
        store.x[a][i] = store.x0[a][i] = filled[k].x[i - b.first][a];
        store.v[a][i]                  = filled[k].v[i - b.first][a];
        store.half_cell[a][i]          = b.half_cell[a];
      }
      store.mass[i]       = filled[k].mass[i - b.first];
      store.rest_share[i] = 1;
      store.id[i]   = ids[k][i - b.first];
      store.body[i] = b.scene;
    }
    b.material->initialise(store.points, b.first, b.last);
  }
  store.swept_density = store.points.density;
  mark_boundaries(filled);
  find_wall_axes();
  sort_particles();
  begin_on_walls();
  if (reference.on)
    begin_reference();
  touch_walls();
  rebuild_lists();
  const StepStatus status = advance_material(0);
  require(status.ok, "the first state is not sound");
  find_surface();
  forces();
}

template <int dim>
Solver<dim>::Implementation::~Implementation() = default;

template <int dim>
Solver<dim>::Solver(const Parameters &p, std::vector<BodyParticles<dim>> filled)
  : self_(std::make_unique<Implementation>(p, std::move(filled)))
{}

template <int dim>
Solver<dim>::~Solver() = default;

template <int dim>
StepStatus Solver<dim>::step(const TimeStep &t)
{
  auto &s = *self_;
  s.kick(t);
  s.energy(t.kick);
  const StepStatus status = agree(s.ranks, s.drift(t.drift));
  return status.ok ? s.arrive(t) : status;
}

template <int dim>
StepStatus Solver<dim>::Implementation::arrive(const TimeStep &t)
{
  time = t.time + t.drift;
  ++steps;
  const bool uneven = is_uneven();
  if (uneven || lists_are_stale())
  {
    const auto start = std::clock();
    share_out(uneven);
    sort_particles();
    rebuild_lists();
    surface_stale = true;
    diagnostics.rebuild_s += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  touch_walls();
  store.swept_density     = store.points.density;
  const StepStatus status = advance_material(t.drift);
  if (!status.ok)
    return status;
  advance_switch(t.drift);
  if (surface_stale)
    find_surface();
  forces();
  updates += n_own();
  return {};
}

template <int dim>
std::span<const double> Solver<dim>::damage() const
{
  return {self_->store.points.damage.data(), self_->n_own()};
}

template <int dim>
void Solver<dim>::set_pieces(std::span<const std::int64_t> piece_of_id)
{
  self_->pieces.assign(piece_of_id.begin(), piece_of_id.end());
  self_->pieces_stale = true;
}

template <int dim>
StepLimit Solver<dim>::stable_dt() const
{
  const auto &s   = *self_;
  StepLimit   limit;
  std::size_t who = s.n_own();
  for (const auto &body : s.bodies)
    for (std::size_t i = body.first; i < body.last; ++i)
    {
      const double  w = s.store.points.sound_speed[i] * s.shares.frequency * s.wave_number[i];
      const double  damping = s.damping(i) / s.store.mass[i];
      double dt = s.parameters.options.step_factor *
                  largest_step(s.parameters.axisymmetric ? s.ring_frequency(body, i, w) : w, damping);
      if (s.parameters.axisymmetric)
        dt = std::min(dt, s.inward_step(i));
      if (dt < limit.dt)
      {
        limit.dt = dt;
        who      = i;
      }
    }
  if (who < s.n_own())
    limit.culprit = s.culprit(who, "stiffness and viscosity of its pairs");
  return tightest(s.ranks, limit);
}

template <int dim>
Surface<dim> Solver<dim>::surface()
{
  auto        &s = *self_;
  Surface<dim> f;
  f.n = s.store.size();
  for (int a = 0; a < dim; ++a)
  {
    f.x[a]     = s.store.x[a];
    f.v[a]     = s.store.v[a];
    f.force[a] = s.store.external[a];
  }
  f.mass           = s.store.mass;
  f.body           = s.store.body;
  f.id             = s.store.id;
  f.contact_points = s.contact_points;
  f.radius         = s.radius;
  f.topology       = s.topology;
  return f;
}

template <int dim>
Balance Solver<dim>::balance() const
{
  const auto &s = *self_;
  Balance     b;
  double      internal = 0;
  for (std::size_t i = 0; i < s.n_own(); ++i)
  {
    const double m = s.store.mass[i] * s.shared(i);
    internal += m * s.store.points.energy[i];
    b.plastic_work += m * s.store.points.plastic_work[i];
    b.viscosity_heat += m * s.store.viscosity_heat[i];
    b.hourglass_sph += m * s.store.hourglass_heat[i];
    if (!s.is_slave.empty() && s.is_slave[s.store.id[i]])
      continue;
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
    for (int a = 0; a < dim; ++a)
    {
      x[a] = s.store.x[a][i];
      v[a] = s.store.v[a][i];
    }
    b.mass += m;
    b.kinetic += .5 * m * v.squaredNorm();
    if (s.parameters.axisymmetric) // the radial momenta of a ring cancel
      b.momentum[1] += m * v[1];
    else
    {
      b.momentum += m * v;
      b.angular_momentum += m * x.cross(v);
    }
  }
  for (const auto &body : s.bodies)
    for (std::size_t i = body.first; i < body.last; ++i)
      b.thermal += s.store.mass[i] * s.shared(i) * s.store.points.plastic_work[i] *
                   body.material->parameters().thermal.heated_share();
  b.elastic       = internal - b.plastic_work - b.viscosity_heat - b.hourglass_sph;
  b.external_impulse = s.works.impulse;
  if (s.parameters.axisymmetric)
    b.external_impulse[0] = 0;
  b.external_work = s.works.external;
  b.wall_loss     = s.works.wall_loss;
  b.friction_heat = s.works.friction;
  sum_over(s.ranks, b);
  b.gradient_fallbacks = static_cast<double>(s.diagnostics.fallbacks);
  return b;
}

template <int dim>
Sample Solver<dim>::sample(int body) const
{
  const auto &s = *self_;
  Sample      out;
  for (const auto &b : s.bodies)
  {
    if (b.scene != body)
      continue;
    const auto take = [&](const AlignedVector<double> &from, std::vector<double> &to) {
      to.assign(from.begin() + b.first, from.begin() + b.last);
    };
    const auto &p = s.store.points;
    for (int a = 0; a < 3; ++a)
    {
      for (auto *to : {&out.x[a], &out.x0[a], &out.v[a], &out.half_cell[a]})
        to->assign(b.last - b.first, 0.);
      if (a >= dim)
        continue;
      take(s.store.x[a], out.x[a]);
      take(s.store.x0[a], out.x0[a]);
      take(s.store.v[a], out.v[a]);
      take(s.store.half_cell[a], out.half_cell[a]);
    }
    out.centre  = out.x;
    out.centre0 = out.x0;
    take(s.store.mass, out.mass);
    out.radius.assign(b.last - b.first, .5 * b.spacing);
    out.id.assign(s.store.id.begin() + b.first, s.store.id.begin() + b.last);
    for (int c = 0; c < 6; ++c)
      take(p.sigma[c], out.sigma[c]);
    take(p.density, out.density);
    take(p.energy, out.energy);
    take(p.plastic_strain, out.plastic_strain);
    take(p.damage, out.damage);
    take(p.temperature, out.temperature);
    for (std::size_t i = b.first; i < b.last; ++i)
      out.volume.push_back(s.store.mass[i] / p.density[i]);
  }
  gather(s.ranks, out);
  return out;
}

template <int dim>
std::size_t Solver<dim>::size() const
{
  return self_->n_all();
}
template <int dim>
std::uint64_t Solver<dim>::updates() const
{
  return self_->updates;
}
template <int dim>
double Solver<dim>::wall_force(std::size_t w) const
{
  return self_->ranks.sum(self_->wall_forces.at(w));
}
template <int dim>
std::span<const std::uint32_t> Solver<dim>::index_of_id() const
{
  return self_->index_of_id;
}
template <int dim>
Diagnostics Solver<dim>::diagnostics() const
{
  Diagnostics d = self_->diagnostics;
  d.pairs       = static_cast<std::size_t>(self_->ranks.sum(static_cast<std::int64_t>(d.pairs)));
  d.bytes       = self_->bytes();
  return d;
}

template <int dim>
void Solver<dim>::set_slaves(std::span<const std::int64_t> ids)
{
  auto &s = *self_;
  s.slave_ids.assign(ids.begin(), ids.end());
  s.is_slave.assign(ids.empty() ? 0 : s.n_all(), 0);
  for (const auto id : ids)
    s.is_slave.at(id) = 1;
  for (auto &v : s.slave_velocity)
    v.assign(s.is_slave.size(), 0.);
  for (std::size_t i = 0; i < s.n_own() && !ids.empty(); ++i)
    for (int a = 0; a < dim; ++a)
      s.slave_velocity[a][s.store.id[i]] = s.store.v[a][i];
  for (auto &v : s.slave_velocity)
    s.ranks.sum(std::span<double>(v));
}

template <int dim>
void Solver<dim>::weigh(std::span<const std::int64_t> ids, std::span<const double> shares)
{
  auto &s = *self_;
  if (s.reference.on || s.parameters.axisymmetric)
    throw InputError({"", 0, "SPH/configuration"}, "particles that share their energy with elements know neither the "
                                                   "reference configuration nor an axis",
                     "current, in a plane or in space");
  s.energy_share.resize(s.n_all(), 1.);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    require(shares[k] > 0 && shares[k] <= 1, "a share lies above 0 and not above 1");
    s.energy_share[static_cast<std::size_t>(ids[k])] = shares[k];
  }
  const bool joint = s.joint;
  s.joint          = false; // joint forces know no shares
  s.follow(joint);
}

template <int dim>
void Solver<dim>::drive_slaves(const std::array<std::span<const double>, dim> &velocity)
{
  auto &s = *self_;
  for (int a = 0; a < dim; ++a)
    for (std::size_t k = 0; k < s.slave_ids.size(); ++k)
      s.slave_velocity[a][s.slave_ids[k]] = velocity[a][k];
}

template <int dim>
void Solver<dim>::slave_forces(const std::array<std::span<double>, dim> &force) const
{
  using L       = Layout<dim>;
  const auto &s = *self_;
  for (std::size_t k = 0; k < s.slave_ids.size(); ++k)
  {
    const std::uint32_t i = s.index_of_id[s.slave_ids[k]];
    for (int a = 0; a < dim; ++a)
      force[a][k] = i == elsewhere ? 0. : s.force_sums[i * L::forces_stride + L::f_sum + a] + s.store.external[a][i];
  }
  for (int a = 0; a < dim; ++a) // each has one owner
    s.ranks.sum(force[a].first(s.slave_ids.size()));
}

template <int dim>
void Solver<dim>::snapshot()
{
  self_->keep();
}
template <int dim>
void Solver<dim>::restore()
{
  self_->go_back();
}
template <int dim>
void Solver<dim>::save(ArchiveWriter &out, const std::string &prefix) const
{
  self_->write(out, prefix);
}
template <int dim>
void Solver<dim>::load(const ArchiveReader &in, const std::string &prefix)
{
  self_->read(in, prefix);
}

template class Solver<1>;
template class Solver<2>;
template class Solver<3>;
} // namespace ogive::sph
