// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/correction/sensor.h"
#include "sph/corrector.h"
#include "sph/half/half.h"
#include "sph/implementation.h"
#include "sph/viscosity/viscosities.h"

#include <Eigen/Dense>

namespace ogive::sph
{
template <int dim>
void Solver<dim>::Implementation::forces()
{
  if (sensed)
    sense();
  if (joint)
    return join_forces();
  pack_viscosity();
  for (const auto &b : bodies)
    b.sweeps.force(sweep_of(b, pairs, force_sums.data()));
  sweep_images(&SweepFunctions::force, &Images::forces);
  if (parameters.axisymmetric)
    add_hoop_stress();
  if (parameters.options.artificial_stress > 0)
    stress_artificially();
  sweep_viscosity();
  add_images(&Images::forces, L::forces_stride, L::hourglass_rate, L::n_forces, force_sums);
  if (correction)
    correct();
  add_images(&Images::forces, L::forces_stride, L::f_sum, L::f_sum + dim, force_sums);
}

/// Sweeps of half/ are there for what is usual, in space.
template <int dim>
bool Solver<dim>::Implementation::joint_possible() const
{
  const auto &o = parameters.options;
  return dim == 3 && !standard && !reference.on && o.viscosity == "monaghan" && o.viscosity_switch == "none" &&
         o.correction == "pairwise" && !variable;
}

template <int dim>
void Solver<dim>::Implementation::join_forces()
{
  const auto pack = [&](const Body &b, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      force_records[i * L::force_stride + L::sound] =
        SoundAndShare::pack(store.points.sound_speed[i], shock_share(b, i, viscous_point(b, i)));
  };
  for (const auto &b : bodies)
    pack(b, b.first, b.last);
  for_each_rider_range(pack);
  reflect_shares();
  std::fill(force_sums.begin(), force_sums.end(), 0.);
  for (const auto &b : bodies)
    b.sweeps.half_force(sweep_of(b, pairs, force_sums.data()));
  for_each_rider_range(
    [&](const Body &b, std::size_t, std::size_t) { b.sweeps.joint_force(rider_sweep_of(b, force_sums.data())); });
  sweep_images(&SweepFunctions::joint_force, &Images::forces);
  if (parameters.options.artificial_stress > 0)
    stress_artificially();
  add_images(&Images::forces, L::forces_stride, L::damping, L::n_joint, force_sums);
  correct();
  add_images(&Images::forces, L::forces_stride, L::f_sum, L::f_sum + dim, force_sums);
}

template <int dim>
ViscousPoint<dim> Solver<dim>::Implementation::viscous_point(const Body &b, std::size_t i) const
{
  ViscousPoint<dim> p;
  p.gradient = Eigen::Map<const Matrix>(&velocity_gradient[i * dim * dim]);
  if (sensed)
    for (int a = 0; a < dim; ++a)
      p.divergence_gradient[a] = sensor_sums[i * SensorLayout<dim>::sums_stride + SensorLayout<dim>::slope + a];
  if (reference.on) // the slope is that of the lattice
    p.divergence_gradient = (deformation(i).inverse().transpose() * p.divergence_gradient).eval();
  p.density = reference.on ? store.swept_density[i] : force_records[i * L::force_stride + L::density];
  p.sound   = store.points.sound_speed[i];
  p.hoop    = hoop_rate(i);
  p.h       = b.h;
  return p;
}

template <int dim>
void Solver<dim>::Implementation::sense()
{
  using S             = SensorLayout<dim>;
  const std::size_t n = store.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const double *motion = &force_records[i * L::force_stride];
    double       *r      = &sensor_records[i * S::stride];
    for (int a = 0; a < dim; ++a)
      r[S::x + a] = motion[L::x + a];
    r[S::volume]     = store.mass[i] / motion[L::density];
    r[S::divergence] = Eigen::Map<const Matrix>(&velocity_gradient[i * dim * dim]).trace() + hoop_rate(i);
  }
  exchange(sensor_records, S::stride, 0, S::n_fields);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &sensor_records[ghosts.parent[g] * S::stride];
    double       *to   = image_record(sensor_records, S::stride, g);
    for (int a = 0; a < dim; ++a)
      to[S::x + a] = force_records[(n + g) * L::force_stride + L::x + a];
    to[S::volume]     = share(g) * from[S::volume];
    to[S::divergence] = from[S::divergence];
  }
  sweep_riders_too(&SweepFunctions::sensor, sensor_sums, S::sums_stride, S::n_sums);
}

/// The switch with a memory, once a step.
template <int dim>
void Solver<dim>::Implementation::advance_switch(double dt)
{
  if (parameters.options.viscosity_switch != "cullen-dehnen")
    return;
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      const auto p           = viscous_point(b, i);
      store.switch_factor[i] = cullen_dehnen(p, store.switch_factor[i], store.divergence[i], dt);
      store.divergence[i]    = p.divergence();
    }
}

template <int dim>
double Solver<dim>::Implementation::strength(std::size_t i, const ViscousPoint<dim> &p) const
{
  const auto &name = parameters.options.viscosity_switch;
  return name == "balsara"             ? balsara(p) :
         name == "divergence-gradient" ? divergence_gradient(p) :
         name == "cullen-dehnen"       ? store.switch_factor[i] :
                                         1.;
}

template <int dim>
double Solver<dim>::Implementation::shock_share(const Body &b, std::size_t i, const ViscousPoint<dim> &p) const
{
  using S       = SensorLayout<dim>;
  const auto &o = parameters.options;
  if (o.shock_split == "compression")
    return compression_sensor(p, o.split_compression);
  if (o.shock_split == "none" || !(p.divergence() < 0))
    return 0;
  const double *sums = &sensor_sums[i * S::sums_stride];
  double        cell = 1;
  for (int a = 0; a < dim; ++a)
    cell *= b.spacing;
  Unevenness    u{sums[S::jump], sums[S::size], shares.weight / cell,
               o.split_ratio * shares.offset, 0, 0};
  if (o.shock_split == "curvature")
  {
    const Eigen::Map<const Vector> slope(sums + S::slope), offset(sums + S::offset);
    Matrix                         inverse;
    corrector<dim>(moment(i), inverse);
    u.bend   = std::abs(sums[S::bend] - offset.dot(inverse.transpose() * slope));
    u.r_bend = o.split_bend * shares.offset * shares.offset * shares.offset;
  }
  return uneven_sensor(p, u);
}

template <int dim>
void Solver<dim>::Implementation::pack_viscosity()
{
  const auto       &o = parameters.options;
  with_viscosity<dim>(o.viscosity, [&](auto law) {
    using Law          = decltype(law);
    constexpr int rate = V::extra + Law::n_fields;
    const bool    limited = o.limiter != "none";
    const auto    pack    = [&](const Body &b, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        const auto    p      = viscous_point(b, i);
        const double *motion = &force_records[i * L::force_stride];
        double       *r      = &viscous_records[i * viscous_stride];
        for (int a = 0; a < dim; ++a)
        {
          r[V::x + a] = store.x[a][i];
          r[V::v + a] = store.v[a][i];
        }
        r[V::mass]     = store.mass[i];
        r[V::density]  = p.density;
        r[V::sound]    = p.sound;
        r[V::strength] = strength(i, p) * shared(i);
        r[V::split]    = shock_share(b, i, p);
        Law{o.alpha, o.beta, b.h}.prepare(p, r + V::extra);
        if (limited)
          std::copy(motion + L::rate, motion + L::rate + L::n_sym, r + rate);
      }
    };
    for (const auto &b : bodies)
      pack(b, b.first, b.last);
    for_each_rider_range(pack);
    exchange(viscous_records, viscous_stride, 0, viscous_stride);
    for (std::size_t g = 0; g < ghosts.size(); ++g)
    {
      const double *from = &viscous_records[ghosts.parent[g] * viscous_stride];
      double       *to   = image_record(viscous_records, viscous_stride, g);
      const auto   &s    = ghosts.sign[g];
      if (from != to)
        std::copy(from, from + viscous_stride, to);
      for (int a = 0; a < dim; ++a)
      {
        to[V::x + a] = s[a] * from[V::x + a] + shift(g, a, time);
        to[V::v + a] = ghosts.turn[g] * s[a] * from[V::v + a] + shift_rate(g, a);
      }
      to[V::mass] *= share(g);
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
        {
          if (Law::n_fields == dim * dim && dim > 1)
            to[V::extra + a * dim + c] = ghosts.turn[g] * s[a] * s[c] * from[V::extra + a * dim + c];
          if (limited)
            to[rate + L::sym(a, c)] = ghosts.turn[g] * s[a] * s[c] * from[rate + L::sym(a, c)];
        }
    }
  });
}

template <int dim>
void Solver<dim>::Implementation::sweep_viscosity()
{
  for (const auto &b : bodies)
    b.sweeps.viscous(sweep_of(b, pairs, viscous_sums.data()));
  for_each_rider_range([&](const Body &b, std::size_t, std::size_t) { b.sweeps.viscous(rider_sweep_of(b, viscous_sums.data())); });
  sweep_images(&SweepFunctions::viscous, &Images::sums);
  // What images press directly belongs to the forces on the walls.
  for (auto &m : images)
    for (std::size_t i = 0; i < m.forces.size() / L::forces_stride; ++i)
      for (int a = 0; a < dim; ++a)
        m.forces[i * L::forces_stride + L::f_sum + a] += m.sums[i * V::sums_stride + V::direct_sum + a];
  add_images(&Images::sums, V::sums_stride, V::weak_sum, V::n_sums, viscous_sums);
  if (parameters.axisymmetric)
    add_hoop_viscosity();
  for (std::size_t i = 0; i < n_own(); ++i)
    for (int a = 0; a < dim; ++a)
      force_sums[i * L::forces_stride + L::f_sum + a] += viscous_sums[i * V::sums_stride + V::direct_sum + a];
}

template <int dim>
void Solver<dim>::Implementation::stress_artificially()
{
  using S             = StressLayout<dim>;
  const std::size_t n = store.size();
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      const double *motion = &force_records[i * L::force_stride];
      double       *r      = &stress_records[i * S::stride];
      const double  scale  = parameters.options.artificial_stress * ring(i) * axis_share(b, i);
      std::copy(motion, motion + dim, r + S::x);
      r[S::volume] = store.mass[i] / motion[L::density];
      Eigen::SelfAdjointEigenSolver<Matrix> solver;
      solver.computeDirect(store.points.stress(i).matrix().template topLeftCorner<dim, dim>());
      const Matrix tension = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.).asDiagonal() *
                             solver.eigenvectors().transpose();
      for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c)
          r[S::r + L::sym(a, c)] = -scale * tension(a, c);
    }
  exchange(stress_records, S::stride, 0, S::n_fields);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &stress_records[ghosts.parent[g] * S::stride];
    double       *to   = image_record(stress_records, S::stride, g);
    const auto   &s    = ghosts.sign[g];
    const double *motion = &force_records[(n + g) * L::force_stride];
    std::copy(motion, motion + dim, to + S::x);
    to[S::volume] = share(g) * from[S::volume];
    for (int a = 0; a < dim; ++a)
      for (int c = a; c < dim; ++c)
        to[S::r + L::sym(a, c)] = ghosts.turn[g] * s[a] * s[c] * from[S::r + L::sym(a, c)];
  }
  for (const auto &b : bodies)
    b.sweeps.artificial_stress(sweep_of(b, pairs, force_sums.data()));
  sweep_images(&SweepFunctions::artificial_stress, &Images::forces);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template bool   Solver<d>::Implementation::joint_possible() const;                                         \
  template void   Solver<d>::Implementation::forces();                                                       \
  template void   Solver<d>::Implementation::advance_switch(double);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
