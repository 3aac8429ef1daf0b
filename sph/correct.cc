// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

namespace ogive::sph
{
template <int dim>
void Solver<dim>::Implementation::correct()
{
  pack_correction();
  if (variable)
  {
    choose_support();
    pack_correction();
    set_kappa();
  }
  reflect_correction(false);
  const bool keep = !corrected.empty();
  for (std::size_t i = 0; keep && i < store.size(); ++i)
    for (int a = 0; a < dim; ++a)
      corrected[i * dim + a] = -force_sums[i * L::forces_stride + L::f_sum + a];
  const auto awake = rest.on ? blocks_with(correction_records, L::correction_stride, L::da) : std::vector<char>();
  sweep_awake(&SweepFunctions::correction, force_sums, &awake);
  sweep_images(&SweepFunctions::correction, &Images::forces);
  for (std::size_t i = 0; keep && i < store.size(); ++i)
    for (int a = 0; a < dim; ++a)
      corrected[i * dim + a] += force_sums[i * L::forces_stride + L::f_sum + a];
}

template <int dim>
void Solver<dim>::Implementation::pack_correction()
{
  const std::size_t stride = variable ? L::wide_correction_stride : L::correction_stride;
  const auto        pack   = [&](const Body &b, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      const double *motion = &force_records[i * L::force_stride];
      const double  rho = motion[L::density], volume = store.mass[i] / rho;
      double       *r = &correction_records[i * stride];
      for (int a = 0; a < dim; ++a)
      {
        r[L::x + a]  = motion[L::x + a];
        r[L::da + a] = (joint ? force_sums[i * L::forces_stride + L::weak_sum + a] :
                                viscous_sums[i * V::sums_stride + V::weak_sum + a]) /
                       store.mass[i];
      }
      r[L::volume] = volume;
      r[L::kappa]  = rho / (gradient_sums[i * L::gradient_stride + L::shepard_sum] + volume * b.self_value);
      if (variable)
        r[L::reach] = reach[i];
    }
  };
  for (const auto &b : bodies)
    pack(b, b.first, b.last);
  for_each_rider_range(pack);
}

/// `is_velocity`: the vector moves with the wall that reflects it.
template <int dim>
void Solver<dim>::Implementation::reflect_correction(bool is_velocity)
{
  const std::size_t stride = variable ? L::wide_correction_stride : L::correction_stride;
  exchange(correction_records, stride, 0, stride);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &correction_records[ghosts.parent[g] * stride];
    double       *to   = image_record(correction_records, stride, g);
    if (from != to)
      std::copy(from, from + stride, to);
    for (int a = 0; a < dim; ++a)
    {
      to[L::x + a]  = force_records[(store.size() + g) * L::force_stride + L::x + a];
      to[L::da + a] = ghosts.turn[g] * ghosts.sign[g][a] * from[L::da + a] + (is_velocity ? shift_rate(g, a) : 0.);
    }
    to[L::volume] = share(g) * from[L::volume];
  }
}

/// The pairs' heat is by now that of the viscosity before the correction, which
/// takes m <da> away: its work v.<da> closes the books (working), or as much heat
/// goes as its mean over the neighbours (averaged; the books do not close).
template <int dim>
void Solver<dim>::Implementation::share_heat()
{
  const std::size_t n = store.size(), stride = variable ? L::wide_correction_stride : L::correction_stride;
  if (parameters.options.energy_form == "working")
  {
    for (std::size_t i = 0; i < n; ++i)
      for (int a = 0; a < dim; ++a)
      {
        const double mean = viscous_sums[i * V::sums_stride + V::weak_sum + a] - corrected[i * dim + a];
        // Twice: the power sums hold both ends' heat.
        power_sums[i * L::powers_stride + L::viscous_power] += 2 * mean * energy_records[i * L::energy_stride + L::v + a];
      }
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    correction_records[i * stride + L::da] = power_sums[i * L::powers_stride + L::viscous_power] / store.mass[i];
  exchange(correction_records, stride, L::da, L::da + 1);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    image_record(correction_records, stride, g)[L::da] = correction_records[ghosts.parent[g] * stride + L::da];
  AlignedVector<double> rest(n * L::forces_stride, 0.);
  add_all(&SweepFunctions::correction, rest, L::forces_stride, 1);
  for (std::size_t i = 0; i < n; ++i)
    power_sums[i * L::powers_stride + L::viscous_power] = rest[i * L::forces_stride + L::f_sum];
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::correct();                                                        \
  template void Solver<d>::Implementation::pack_correction();                                                \
  template void Solver<d>::Implementation::reflect_correction(bool);                                         \
  template void Solver<d>::Implementation::share_heat();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
