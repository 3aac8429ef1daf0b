// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <array>
#include <cmath>
#include <limits>

/// Rules that choose the support of the correction. All smooth their choice
/// over the neighbours and let a pair use the mean of its ends: a choice applied
/// raw and one-sided drains energy.
namespace ogive::sph
{
namespace
{
/// Supports tried, as shares of the greatest.
constexpr std::array candidates{.4, .6, .8, 1.};
/// Time over which variation may not grow, in h/c: about a step.
constexpr double usual_step = .3;
} // namespace

/// Shepard sums at the pair's support, self included, into kappa = rho/s.
template <int dim>
void Solver<dim>::Implementation::set_kappa()
{
  reflect_correction(false);
  sweep_all(&SweepFunctions::mean, mean_sums, L::means_stride, L::n_means);
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      double      *r    = &correction_records[i * L::wide_correction_stride];
      const double self = b.centre_value * std::pow(b.h / r[L::reach], dim);
      r[L::kappa]       = force_records[i * L::force_stride + L::density] /
                    (mean_sums[i * L::means_stride + L::share_mean] + r[L::volume] * self);
    }
}

template <int dim>
void Solver<dim>::Implementation::choose_support()
{
  const auto           &o = parameters.options;
  const std::size_t     n = store.size(), stride = L::wide_correction_stride;
  const auto            record = [&](std::size_t i) { return &correction_records[i * stride]; };
  const auto            set_reach = [&](auto &&share_of) {
    for (const auto &b : bodies)
      for (std::size_t i = b.first; i < b.last; ++i)
        reach[i] = share_of(i) * o.correction_support * b.h;
  };
  // Variation of a vector field over the neighbours, at the plain support.
  const auto variation = [&](auto &&component, bool is_velocity, int which, AlignedVector<double> &result) {
    for (const auto &b : bodies)
      for (std::size_t i = b.first; i < b.last; ++i)
      {
        for (int a = 0; a < dim; ++a)
          record(i)[L::da + a] = component(i, a);
        record(i)[L::reach] = b.h;
      }
    reflect_correction(is_velocity);
    sweep_all(&SweepFunctions::mean, mean_sums, L::means_stride, L::n_means);
    for (std::size_t i = 0; i < n; ++i)
      result[i] = mean_sums[i * L::means_stride + which];
  };
  const auto speed = [&](std::size_t i, int a) { return store.v[a][i]; };

  AlignedVector<double> chosen(n, 1.), now(n), size(n);
  if (o.support_rule == "monotonicity")
  {
    // 1 where all neighbours approach, or all recede; 0 in a saw-tooth.
    variation(speed, true, L::along, now);
    variation(speed, true, L::along_size, size);
    for (std::size_t i = 0; i < n; ++i)
      chosen[i] = 1 - (1 - candidates.front()) * (size[i] > 0 ? std::abs(now[i]) / size[i] : 1.);
  }
  else
  {
    const bool            minimal = o.support_rule == "minimal-dissipation";
    AlignedVector<double> least(n, std::numeric_limits<double>::infinity()), forces, ahead(n);
    for (const auto &b : bodies)
      for (std::size_t i = b.first; i < b.last; ++i)
        ahead[i] = usual_step * b.h / store.points.sound_speed[i];
    if (minimal)
      variation(speed, true, L::variation, least);
    std::vector<char> settled(n, 0);
    for (const double candidate : candidates)
    {
      set_reach([&](std::size_t) { return candidate; });
      pack_correction();
      set_kappa();
      reflect_correction(false);
      forces = force_sums;
      add_images(&Images::forces, L::forces_stride, L::f_sum, L::f_sum + dim, forces);
      add_all(&SweepFunctions::correction, forces, L::forces_stride, dim);
      const auto acceleration = [&](std::size_t i, int a) {
        return forces[i * L::forces_stride + L::f_sum + a] / store.mass[i];
      };
      if (minimal)
        variation([&](std::size_t i, int a) { return speed(i, a) + ahead[i] * acceleration(i, a); }, true, L::variation,
                  now);
      else
        variation(acceleration, false, L::variation, now);
      for (std::size_t i = 0; i < n; ++i)
        if (minimal ? !settled[i] && now[i] <= least[i] : now[i] < least[i])
        {
          chosen[i]  = candidate;
          settled[i] = 1;
          if (!minimal)
            least[i] = now[i];
        }
    }
  }
  // Smoothed: the mean over the neighbours and itself.
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      record(i)[L::kappa] = chosen[i];
      record(i)[L::reach] = b.h;
    }
  reflect_correction(false);
  sweep_all(&SweepFunctions::mean, mean_sums, L::means_stride, L::n_means);
  for (const auto &b : bodies)
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      const double *sums = &mean_sums[i * L::means_stride];
      const double  self = record(i)[L::volume] * b.centre_value;
      now[i] = (sums[L::field_mean] + self * chosen[i]) / (sums[L::share_mean] + self);
    }
  set_reach([&](std::size_t i) { return now[i]; });
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::set_kappa();                                                      \
  template void Solver<d>::Implementation::choose_support();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
