// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "sph/agree.h"
#include "sph/implementation.h"

/// A step of the particles in parts: their forces act once, as one impulse at
/// t_n; what the coupling layer pushes, and the motion of slaves, comes in every
/// part. Within the step the velocity of a particle that is pushed jumps: it is
/// strained by its mean over the step, and pairs work with the mean of two such
/// means; the difference to the work at the velocities of the push is booked.
namespace ogive::sph
{
template <int dim>
void Solver<dim>::allow_parts()
{
  auto &s          = *self_;
  s.store.in_parts = true;
  s.store.v_strain = s.store.v;
}

template <int dim>
StepStatus Solver<dim>::begin(const TimeStep &whole, const TimeStep &part)
{
  auto &s = *self_;
  require(s.store.in_parts, "a step in parts was not announced");
  const double share = part.kick / whole.kick;
  for (int a = 0; a < dim; ++a)
  {
    s.part_shift[a] = s.store.v_strain[a];
    for (std::size_t i = 0; i < s.store.size(); ++i)
    {
      s.part_shift[a][i] -= s.store.v[a][i];
      s.store.external[a][i] *= share;
    }
    s.part_path[a].assign(s.store.size(), 0.);
  }
  s.kick(whole);
  s.part_first = s.store.v;
  return agree(s.ranks, s.drift(part.drift));
}

template <int dim>
StepStatus Solver<dim>::go_on(const TimeStep &part)
{
  auto &s = *self_;
  s.for_each_rider_range([&](const auto &b, std::size_t first, std::size_t last) {
    for (int a = 0; a < dim; ++a)
      for (std::size_t i = first; i < last; ++i)
      {
        s.store.v[a][i] = b.rider_velocity[a][static_cast<std::size_t>(-1 - s.store.id[i])];
        s.part_path[a][i] += part.drift * (s.store.v[a][i] - s.part_first[a][i]);
      }
  });
  for (std::size_t i = 0; i < s.n_own(); ++i)
    for (int a = 0; a < dim; ++a)
    {
      const double f  = s.store.external[a][i];
      const auto   id = s.store.id[i];
      if (!s.is_slave.empty() && s.is_slave[id])
        s.store.v[a][i] = s.slave_velocity[a][id];
      else if (s.store.fixed[i] >> a & 1)
      {
        s.works.external -= part.kick * f * s.store.v[a][i];
        s.works.impulse[a] -= part.kick * f;
      }
      else if (f != 0)
        s.store.v[a][i] += part.kick * f / s.store.mass[i];
      s.part_path[a][i] += part.drift * (s.store.v[a][i] - s.part_first[a][i]);
    }
  return agree(s.ranks, s.drift(part.drift));
}

template <int dim>
StepStatus Solver<dim>::finish(const TimeStep &whole)
{
  using L = Layout<dim>;
  auto &s = *self_;
  for (std::size_t i = 0; i < s.store.size(); ++i)
    for (int a = 0; a < dim; ++a)
    {
      const double beyond = s.part_path[a][i] / whole.drift, more = .5 * (s.part_shift[a][i] + beyond);
      if (i < s.n_own())
        s.works.parts_error -= whole.kick * s.force_sums[i * L::forces_stride + L::f_sum + a] * more;
      s.energy_records[i * L::energy_stride + L::v + a] += more;
      s.store.v_strain[a][i] = s.part_first[a][i] + beyond;
    }
  s.energy(whole.kick);
  s.store.v.swap(s.store.v_strain);
  const StepStatus status = s.arrive(whole);
  s.store.v.swap(s.store.v_strain);
  return status;
}

template <int dim>
double Solver<dim>::parts_error() const
{
  return self_->ranks.sum(self_->works.parts_error);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void       Solver<d>::allow_parts();                                                              \
  template StepStatus Solver<d>::begin(const TimeStep &, const TimeStep &);                                  \
  template StepStatus Solver<d>::go_on(const TimeStep &);                                                    \
  template StepStatus Solver<d>::finish(const TimeStep &);                                                   \
  template double     Solver<d>::parts_error() const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
