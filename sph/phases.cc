// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/agree.h"
#include "sph/corrector.h"
#include "sph/implementation.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>

namespace ogive::sph
{
namespace
{
template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;

constexpr std::size_t block_size = 256;

/// Strain, spin and density of a block, in the form that materials read.
struct Block
{
  std::array<std::array<double, block_size>, 6> strain{};
  std::array<std::array<double, block_size>, 3> spin{};
  std::array<double, block_size>                density;

  materials::Increments increments(double dt) const
  {
    materials::Increments inc;
    for (int c = 0; c < 6; ++c)
      inc.strain[c] = strain[c].data();
    for (int c = 0; c < 3; ++c)
      inc.spin[c] = spin[c].data();
    inc.density = density.data();
    inc.dt      = dt;
    return inc;
  }
};

/// Increments over dt from the gradient l and the hoop rate at the end of the
/// step: measured at its middle, so that a rigid turn strains nothing.
template <int dim>
void middle(const Matrix<dim> &l, double hoop, double dt, std::size_t k, Block &block)
{
  const Matrix<dim> half = Matrix<dim>::Identity() - .5 * dt * l;
  const Matrix<dim> mid  = dt * (l * half.inverse());
  constexpr int     pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (int a = 0; a < dim; ++a)
    block.strain[a][k] = mid(a, a);
  if (dim == 2)
    block.strain[2][k] = dt * hoop / (1 - .5 * dt * hoop);
  for (int c = 0; c < 3; ++c)
  {
    const auto [a, b] = pair[c];
    if (a < dim && b < dim)
    {
      block.strain[3 + c][k] = .5 * (mid(a, b) + mid(b, a));
      block.spin[c][k]       = .5 * (mid(a, b) - mid(b, a));
    }
  }
}
} // namespace

template <int dim>
StepStatus Solver<dim>::Implementation::advance_material(double dt)
{
  pack_motion();
  if (reference.on)
    sweep_all(&SweepFunctions::reference_gradient, gradient_sums, L::gradient_stride, 0);
  else
  {
    std::vector<char> awake;
    if (rest.on)
    {
      awake = who_sees(rest.changed);
      for (std::size_t k = 0; k < awake.size(); ++k)
        awake[k] |= rest.bound[k];
      std::fill(rest.changed.begin(), rest.changed.end(), 0);
    }
    sweep_riders_too(&SweepFunctions::gradient, gradient_sums, L::gradient_stride, L::n_gradient, &awake);
  }
  if (summation)
    sum_masses();
  if (dt > 0)
    take_rider_states();
  auto       &points = store.points;
  Block       block;
  std::int64_t fallbacks = 0, broken = 0;
  const auto  take = [&](const Body &body, std::size_t first, std::size_t last, bool rides) -> StepStatus {
    for (std::size_t begin = first; begin < last; begin += block_size)
    {
      const std::size_t end = std::min(begin + block_size, last);
      std::array<Matrix, block_size> corrected;
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t k    = i - begin;
        const double     *sums = &gradient_sums[i * L::gradient_stride];
        Matrix       l;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            l(a, b) = sums[L::g_sum + a * dim + b];
        corrected[k].setIdentity();
        if (reference.on)
        {
          if (!deform(i, dt, l, corrected[k]))
            return {false, culprit(i, "its lattice is turned inside out")};
        }
        else if (!standard)
        {
          fallbacks += !corrector<dim>(moment(i), corrected[k]) && !rides;
          l = (l * corrected[k]).eval();
        }
        const Eigen::Map<const Eigen::Matrix<double, dim, 1>> normal(sums + L::normal_sum);
        wave_number[i] = corrected[k].cwiseAbs().rowwise().sum().maxCoeff() * sums[L::stiffness_sum] +
                         surface_share * (corrected[k] * normal).norm();
        std::copy(l.data(), l.data() + dim * dim, &velocity_gradient[i * dim * dim]);
        double *record     = &force_records[i * L::force_stride];
        for (int a = 0; a < dim; ++a)
          for (int b = a; b < dim; ++b)
            record[L::rate + L::sym(a, b)] = .5 * (l(a, b) + l(b, a));
        if (dt > 0 && !rides)
        {
          const double hoop = hoop_rate(i), rho = points.density[i];
          middle<dim>(l, hoop, dt, k, block);
          for (int a = 0; a < dim; ++a)
            store.half_cell[a][i] *= (2 + block.strain[a][k]) / (2 - block.strain[a][k]);
          block.density[k] = summation ? store.density_scale[i] * mass_sum(body, i) :
                             standard  ? rho * (1 - dt * hoop) + dt * sums[L::continuity_sum] / ring(i) :
                                         rho * (1 - dt * hoop) * (Matrix::Identity() - dt * l).determinant();
        }
      }
      if (dt > 0 && !rides)
      {
        std::size_t bad = 0;
        for (std::size_t i = begin; reference.on && i < end; ++i)
          block.density[i - begin] = reference.density[i] / deformation(i).determinant();
        const auto  status = body.material->update(points, begin, end, block.increments(dt), bad);
        if (status != materials::Status::ok)
          return {false, culprit(bad, materials::describe(status))};
      }
      for (std::size_t i = begin; i < end; ++i)
      {
        double      *record = &force_records[i * L::force_stride];
        record[L::sound]  = points.sound_speed[i] * (rides || seam_pairs(body, i) ? body.seam_hourglass : 1.) * shared(i);
        record_damage[i] = points.damage[i];
        broken += points.damage[i] >= 1 && !rides;
        if (reference.on)
        {
          pack_reference(body, i, corrected[i - begin]);
          continue;
        }
        const Mat3   sigma  = points.stress(i).matrix();
        Matrix  p      = ring(i) * axis_share(body, i) * sigma.template topLeftCorner<dim, dim>() * corrected[i - begin];
        if (standard)
          p /= ring(i) * ring(i) * points.density[i] * points.density[i];
        p *= shared(i);
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            record[L::p + a * dim + b] = p(a, b);
      }
    }
    return {};
  };
  StepStatus status;
  for (const auto &body : bodies)
    if (status = take(body, body.first, body.last, false); !status.ok)
      break;
  if (status.ok)
    for_each_rider_range([&](const Body &body, std::size_t first, std::size_t last) { take(body, first, last, true); });
  std::array<std::int64_t, 2> counts{fallbacks, broken};
  if (status = agree(ranks, status, counts); !status.ok)
    return status;
  diagnostics.fallbacks = counts[0] + reference.fallbacks;
  surface_stale |= counts[1] != failed;
  failed = counts[1];
  reflect_forces();
  if (reference.on)
    reflect_reference();
  return {};
}

template <int dim>
void Solver<dim>::Implementation::energy(double kick)
{
  const std::size_t n = store.size();
  for (std::size_t i = 0; reference.on && i < n; ++i)
    energy_records[i * L::energy_stride + L::weight] = reference.volume[i];
  exchange(energy_records, L::energy_stride, 0, L::energy_stride);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &energy_records[ghosts.parent[g] * L::energy_stride];
    double       *to   = &energy_records[(n + g) * L::energy_stride];
    for (int a = 0; a < dim; ++a)
    {
      to[L::x + a] = ghosts.sign[g][a] * from[L::x + a] + shift(g, a, time);
      to[L::v + a] = ghosts.turn[g] * ghosts.sign[g][a] * from[L::v + a] + shift_rate(g, a);
    }
    to[L::weight] = share(g) * from[L::weight];
    to[L::last_p] = ghosts.turn[g] * from[L::last_p];
  }
  const auto awake = rest.on ? blocks_with(energy_records, L::energy_stride, L::v) : std::vector<char>();
  sweep_all(&SweepFunctions::energy, power_sums, L::powers_stride, 3, &SweepFunctions::half_energy, &awake);
  add_power_at_seam(true, kick);
  for (const auto power : {&SweepFunctions::artificial_stress_power, &SweepFunctions::viscous_power,
                           &SweepFunctions::correction_power, &SweepFunctions::weak_power})
    if (is_used(power))
    {
      add_all(power, power_sums, L::powers_stride, 3);
      add_power_at_seam(false, kick);
    }
  if (parameters.axisymmetric)
    heat_hoops();
  if (parameters.options.correction == "shepard")
    share_heat();
  for (std::size_t i = 0; i < n_own(); ++i)
  {
    const double *sums      = &power_sums[i * L::powers_stride];
    const double  per_mass  = kick / (shared(i) * store.mass[i]);
    const double  viscous   = .5 * per_mass * sums[L::viscous_power];
    const double  hourglass = .5 * per_mass * sums[L::hourglass_power];
    const double  stress    = per_mass * energy_records[i * L::energy_stride + L::weight] * sums[L::stress_power];
    store.viscosity_heat[i] += viscous;
    store.hourglass_heat[i] += hourglass;
    store.points.energy[i] += stress + viscous + hourglass;
  }
}

template <int dim>
void Solver<dim>::Implementation::sum_masses()
{
  sweep_all(&SweepFunctions::density, mass_sums, padded(1), 1);
  if (!store.density_scale.empty() && store.density_scale[0] > 0)
    return;
  for (const auto &body : bodies)
    for (std::size_t i = body.first; i < body.last; ++i)
      store.density_scale[i] = store.points.density[i] / mass_sum(body, i);
}

template <int dim>
Culprit Solver<dim>::Implementation::culprit(std::size_t i, const char *why) const
{
  Culprit c;
  c.entity = "particle";
  c.body   = store.body[i];
  c.id     = store.id[i];
  for (int a = 0; a < dim; ++a)
    c.where[a] = store.x[a][i];
  c.why = why;
  return c;
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template StepStatus Solver<d>::Implementation::advance_material(double);                                   \
  template void       Solver<d>::Implementation::energy(double);                                             \
  template void       Solver<d>::Implementation::sum_masses();                                               \
  template Culprit    Solver<d>::Implementation::culprit(std::size_t, const char *) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
