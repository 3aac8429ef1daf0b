// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

/// Axial symmetry: x = r, y = z, each particle a whole ring. To the sweeps the
/// rings are a plane body of density 2 pi r rho, kg/m^2 (ring()), so that their
/// weights are the areas of the r-z plane; beyond the axis lie mirror images as
/// behind a plane of symmetry. What the plane does not know is added here: hoop
/// stress and hoop viscosity, each with its heating.
namespace ogive::sph
{
namespace
{
/// Response of the pair viscosity to compression along one line, in units of
/// alpha rho c h |D|: int -W' r cos^4 dA/2 = 3/8 in a plane. The hoop's is the same.
constexpr double hoop_share = 3. / 8;

/// Share of its radius by which a particle may near the axis in one step.
constexpr double inward_share = .25;
} // namespace

template <int dim>
double Solver<dim>::Implementation::ring(std::size_t i) const
{
  return parameters.axisymmetric ? 2 * std::numbers::pi * store.x[0][i] : 1.;
}

template <int dim>
double Solver<dim>::Implementation::axis_share(const Body &b, std::size_t i) const
{
  return axis_factor ? (*axis_factor)(store.x[0][i] / b.h) : 1.;
}

template <int dim>
double Solver<dim>::Implementation::hoop_rate(std::size_t i) const
{
  return parameters.axisymmetric ? store.v[0][i] / store.x[0][i] : 0.;
}

/// The exact transpose of the hoop strain v_r/r, over the volume that the stress
/// of the plane has.
template <int dim>
void Solver<dim>::Implementation::add_hoop_stress()
{
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      const double area = store.mass[i] / force_records[i * L::force_stride + L::density];
      hoop_force[i]     = -2 * std::numbers::pi * area * axis_share(b, i) * store.points.sigma[2][i];
      force_sums[i * L::forces_stride + L::f_sum] += hoop_force[i];
    }
}

/// Linear and quadratic viscosity of rings that shrink, split as that of the
/// pairs is. The limited part of a ring is none: its rate goes over smoothly
/// into that along r.
template <int dim>
void Solver<dim>::Implementation::add_hoop_viscosity()
{
  const auto &o = parameters.options;
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      const double *record = &viscous_records[i * viscous_stride];
      const double  r = store.x[0][i], shrinks = std::max(0., -hoop_rate(i));
      const double  per_rate = store.mass[i] / r * hoop_share * b.h * record[V::strength] *
                              (o.alpha * store.points.sound_speed[i] + o.beta * b.h * shrinks);
      const double raw = record[V::split], rest = o.limiter == "none" ? 1 - raw : 0.;
      double      *sums = &viscous_sums[i * V::sums_stride];
      const double kept = raw + (correction ? 0. : rest), given = correction ? rest : 0.;
      hoop_viscosity[i] = kept * per_rate * shrinks;
      hoop_weak[i]      = given * per_rate * shrinks;
      sums[V::direct_sum] += hoop_viscosity[i];
      sums[V::weak_sum] += hoop_weak[i];
      // Counted in full: the split may give it all in the next step.
      sums[V::direct_rate] += (o.shock_split == "none" ? kept : 1.) * per_rate / r;
      sums[V::weak_rate] += given * per_rate / r;
    }
}

template <int dim>
void Solver<dim>::Implementation::heat_hoops()
{
  for (std::size_t i = 0; i < store.size(); ++i)
  {
    double      *sums = &power_sums[i * L::powers_stride];
    const double v    = energy_records[i * L::energy_stride + L::v];
    sums[L::stress_power] -= hoop_force[i] * v / energy_records[i * L::energy_stride + L::weight];
    // Twice: the power sums hold both ends' heat.
    sums[L::viscous_power] -= 2 * hoop_viscosity[i] * v;
    if (is_used(&SweepFunctions::weak_power))
      sums[L::viscous_power] -= 2 * hoop_weak[i] * v;
  }
}

/// Highest frequency of particle i from that of the plane, rad/s. Near the axis
/// the rings of the neighbours, |r + x_ij|, are larger than its own, on the mean
/// .6 h; hoop stress adds its share.
template <int dim>
double Solver<dim>::Implementation::ring_frequency(const Body &b, std::size_t i, double plane) const
{
  const double r = store.x[0][i], c = store.points.sound_speed[i];
  return std::sqrt(plane * plane * std::max(1., .6 * b.h / r) + axis_share(b, i) * c * c / (r * r));
}

template <int dim>
double Solver<dim>::Implementation::inward_step(std::size_t i) const
{
  const double v = store.v[0][i];
  return v < 0 ? inward_share * store.x[0][i] / -v : std::numeric_limits<double>::infinity();
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template double Solver<d>::Implementation::ring(std::size_t) const;                                        \
  template double Solver<d>::Implementation::axis_share(const Body &, std::size_t) const;                    \
  template double Solver<d>::Implementation::hoop_rate(std::size_t) const;                                   \
  template void   Solver<d>::Implementation::add_hoop_stress();                                              \
  template void   Solver<d>::Implementation::add_hoop_viscosity();                                           \
  template void   Solver<d>::Implementation::heat_hoops();                                                   \
  template double Solver<d>::Implementation::ring_frequency(const Body &, std::size_t, double) const;        \
  template double Solver<d>::Implementation::inward_step(std::size_t) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
