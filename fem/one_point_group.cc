// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/one_point_group.h"

#include "core/base/error.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"

#include <algorithm>

namespace ogive::fem
{
template <class Element>
void OnePointGroup<Element>::start(const Nodes<dim> &nodes)
{
  Corners still;
  for (auto &corner : still)
    std::fill(std::begin(corner), std::end(corner), VDouble(0.));
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    Corners x;
    Shape   shape;
    Motion  motion;
    gather(nodes.x, pack, x);
    deform<Element, VDouble>(x, still, VDouble(1.), shape, motion);
    alignas(64) double scratch[corners * dim * width];
    double *const      forces = forces_of(pack, scratch);
    stress<false>(pack, shape, motion, 1., forces);
    if constexpr (!area_weighted)
      scatter(pack, 1, forces);
  }
  if constexpr (area_weighted)
    weigh(nodes);
}

template <class Element>
void OnePointGroup<Element>::gather(const std::array<AlignedVector<double>, dim> &field, std::size_t pack,
                                    Corners &out, std::size_t first) const
{
  for (int a = 0; a < corners; ++a)
  {
    const std::uint32_t *node = &node_[(pack * corners + a) * width];
    const std::uint32_t  row  = row_[pack * corners + a];
    if (row != no_row)
      for (int i = 0; i < dim; ++i)
        out[a][i] = VDouble(field[i].data() + (row - first), stdx::element_aligned);
    else
      for (int i = 0; i < dim; ++i)
      {
        const double *f = field[i].data();
        out[a][i]       = VDouble([&](auto lane) { return f[node[lane] - first]; });
      }
  }
}

/// Corner by corner and pack by pack: the same sums every time. Packs run inside,
/// since they seldom share a node at the same corner: an addition has reached the
/// memory before the next one to the node reads it.
template <class Element>
void OnePointGroup<Element>::scatter(std::size_t begin, std::size_t count, const double *forces)
{
  if (!share_.empty())
    return scatter_shares(begin, count, forces);
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
    {
      double *sum = nodal_force_[i].data();
      for (std::size_t pack = begin; pack < begin + count; ++pack)
      {
        const double       *force = &forces[(((pack - begin) * corners + a) * dim + i) * width];
        const std::uint32_t row   = row_[pack * corners + a];
        if (row != no_row)
        {
          double *to = sum + (row - first_node_);
          (VDouble(to, stdx::element_aligned) + load(force)).copy_to(to, stdx::element_aligned);
        }
        else
        {
          const std::uint32_t *node  = &node_[(pack * corners + a) * width];
          const std::size_t    lanes = std::min(width, n_ - pack * width);
          for (std::size_t lane = 0; lane < lanes; ++lane)
            if (const std::size_t at = node[lane] - first_node_; at < nodal_force_[i].size()) // else a grave
              sum[at] += force[lane];
        }
      }
    }
}

/// Power that the corner forces of t_n take from velocities v, W.
template <class Element>
VDouble OnePointGroup<Element>::power_of_forces(std::size_t pack, const Corners &v) const
{
  const double *f = &corner_force_[pack * corners * dim * width];
  VDouble       power(0.);
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i, f += width)
      power -= load(f) * v[a][i];
  return power;
}

/// The same from the stress of t_n in the shape of t_n, where the velocities came
/// from: cheaper than to keep the forces of all elements from step to step.
template <class Element>
VDouble OnePointGroup<Element>::power_of_stress(std::size_t pack, const VDouble (&X)[7][3],
                                                const VDouble (&V)[7][3], double drift) const
{
  const std::size_t e = pack * width;
  VDouble           last[7][3], sigma[6], Q[4][3];
  for (int m = 0; m < 7; ++m)
    for (int i = 0; i < 3; ++i)
      last[m][i] = X[m][i] - drift * V[m][i];
  VDouble q = load(&viscous_pressure_[e]);
  if (corrected_)
    q -= load(&weak_pressure_[e]);
  for (int k = 0; k < 6; ++k)
    sigma[k] = load(&points_.sigma[k][e]) - (k < 3 ? q : VDouble(0.));
  for (int k = 0; k < 6 && !damping_share_.empty(); ++k)
    sigma[k] += load(&damping_stress_[k][e]);
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
      Q[m][i] = load(&Q_[((pack * 4 + m) * 3 + i) * width]);
  return power_taken(last, V, sigma, Q);
}

template <class Element>
void OnePointGroup<Element>::book_energy(std::size_t pack, VDouble work, VDouble correction,
                                         const Shape &shape, const Motion &motion)
{
  // Hourglass forces and viscous pressure of t_n work over half of the last and
  // half of this step: trapezoidal, while `work`, the whole, is exact.
  const std::size_t e = pack * width;
  VDouble           patterns = load(&half_hourglass_[e]);
  for (int m = 0; m < modes; ++m)
    for (int i = 0; i < dim; ++i)
      patterns += .5 * load(&Q_[((pack * modes + m) * dim + i) * width]) * motion.rate[m][i];
  VDouble q = load(&viscous_pressure_[e]);
  if (corrected_)
    q -= load(&weak_pressure_[e]);
  VDouble heat = load(&half_viscous_[e]) - .5 * q * motion.trace * shape.volume + correction;
  if (!damping_share_.empty())
    heat += half_damping(pack, motion) * shape.volume;
  store(load(&hourglass_energy_[e]) + patterns, &hourglass_energy_[e]);
  store(load(&viscous_heat_[e]) + heat, &viscous_heat_[e]);
  store(load(&points_.energy[e]) + (work - patterns) / load(&mass_[e]), &points_.energy[e]);
}

template <class Element>
template <bool corrected>
bool OnePointGroup<Element>::strain(const Nodes<dim> &nodes, const TimeStep &step, std::size_t pack,
                                    Block &block, std::size_t held)
{
  Corners x, v;
  gather(nodes.x, pack, x);
  gather(nodes.v, pack, v);
  Shape  &shape  = block.shape[held];
  Motion &motion = block.motion[held];
  VDouble power, correction(0.);
  if constexpr (modal)
  {
    VDouble X[7][3], V[7][3];
    modes_of(x, X);
    modes_of(v, V);
    power = keeps_forces() ? power_of_forces(pack, v) : power_of_stress(pack, X, V, step.drift);
    deform_modes(X, V, VDouble(step.drift), shape, motion);
  }
  else
  {
    power = power_of_forces(pack, v);
    deform<Element, VDouble>(x, v, VDouble(step.drift), shape, motion);
  }
  VDouble work = (load(&half_power_[pack * width]) + .5 * power) * step.kick;
  if constexpr (corrected)
  {
    correction = correction_work(pack, v, step.kick);
    work += correction;
  }
  for (auto &row : motion.rate)
    for (auto &rate : row)
      rate *= step.drift;
  const std::size_t at = held * width;
  for (int c = 0; c < 6; ++c)
    store(motion.strain[c], &block.strain[c][at]);
  for (int c = 0; c < 3; ++c)
    store(motion.spin[c], &block.spin[c][at]);
  // At rest the density is that of the undeformed material, and nothing presses.
  VDouble density = load(&mass_[pack * width]) / shape.volume;
  stdx::where(stdx::abs(density - rest_) <= 8e-16 * rest_, density) = VDouble(rest_);
  store(density, &block.density[at]);
  book_energy(pack, work, correction, shape, motion);
  const VDouble energy = load(&points_.energy[pack * width]);
  return stdx::all_of(shape.volume > 0.) && stdx::all_of(energy - energy == 0.);
}

template <class Element>
StepStatus OnePointGroup<Element>::advance(const Nodes<dim> &nodes, const TimeStep &step)
{
  const StepStatus status = take(nodes, step);
  if (!agreed(status.ok))
    return status;
  if constexpr (area_weighted)
    weigh(nodes);
  if (corrected_)
    correct(nodes);
  return {};
}

template <class Element>
StepStatus OnePointGroup<Element>::take(const Nodes<dim> &nodes, const TimeStep &step)
{
  const std::size_t packs = padded_n_ / width;
  limit_                  = {0., 0.};
  skipped_                = 0;
  for (auto *field : {&nodal_force_, &weak_force_})
    for (auto &component : *field)
      std::fill(component.begin(), component.end(), 0.);
  Block block;
  for (std::size_t begin = 0; begin < packs; begin += block_packs)
  {
    const std::size_t count  = std::min(block_packs, packs - begin);
    const StepStatus  status = quiet(nodes, begin, count) ? take_quiet(nodes, step, begin, count, block) :
                                                            take_block(nodes, step, begin, count, block);
    if (!status.ok)
      return status;
  }
  return {};
}

template <class Element>
StepStatus OnePointGroup<Element>::take_block(const Nodes<dim> &nodes, const TimeStep &step, std::size_t begin,
                                              std::size_t count, Block &block)
{
  for (std::size_t k = 0; k < count; ++k)
    if (!(corrected_ ? strain<true>(nodes, step, begin + k, block, k) :
                       strain<false>(nodes, step, begin + k, block, k)))
      return first_bad(nodes, begin + k);

  if (const std::size_t next = begin + count, packs = padded_n_ / width; next < packs)
    fetch(next, std::min(block_packs, packs - next));
  materials::Increments increments;
  for (int c = 0; c < 6; ++c)
    increments.strain[c] = block.strain[c];
  for (int c = 0; c < 3; ++c)
    increments.spin[c] = block.spin[c];
  increments.density = block.density;
  increments.dt      = step.drift;
  std::size_t             bad = 0;
  const materials::Status status =
    material_->update(points_, begin * width, (begin + count) * width, increments, bad);
  if (status != materials::Status::ok)
    return fail(nodes, std::min(bad, n_ - 1), materials::describe(status));

  double *const forces = forces_of(begin, block.force);
  for (std::size_t k = 0; k < count; ++k)
  {
    double *const own = forces + k * corners * dim * width;
    if (corrected_)
      stress<true>(begin + k, block.shape[k], block.motion[k], step.drift, own);
    else
      stress<false>(begin + k, block.shape[k], block.motion[k], step.drift, own);
  }
  if constexpr (!area_weighted)
    scatter(begin, count, forces);
  return {};
}

template <class Element>
Gram<Element, VDouble> OnePointGroup<Element>::inverse_mass_gram(std::size_t pack, const Shape &shape,
                                                                 const Gram<Element, VDouble> &unit) const
{
  if constexpr (Element::hoop && !area_weighted)
  {
    VDouble weight[corners];
    for (int a = 0; a < corners; ++a)
      weight[a] = 1. / load(&corner_mass_[(pack * corners + a) * width]);
    return gram<Element, VDouble>(shape, weight);
  }
  else
  {
    const VDouble weight = double(corners) / load(&(inertia_.empty() ? mass_ : inertia_)[pack * width]);
    return {unit.largest * weight, unit.divergence * weight, unit.trace * weight};
  }
}

/// Bulk viscosity, hourglass forces, corner forces and the step bound
/// dt <= 2/(D/2 + sqrt(D^2/4 + w^2)), which is L/(Q + sqrt(Q^2 + c^2)) for one
/// element in uniaxial strain. w^2 bounds the elastic and hourglass frequency of
/// the element with its own corner masses, D its damping; the assembled mesh
/// lies below the largest element (Irons and Treharne, 1971).
template <class Element>
template <bool corrected>
void OnePointGroup<Element>::stress(std::size_t pack, const Shape &shape, const Motion &motion, double dt,
                                    double *f)
{
  const std::size_t e = pack * width;
  VDouble           ones[corners];
  std::fill(std::begin(ones), std::end(ones), VDouble(1.));
  const Gram<Element, VDouble> unit   = gram<Element, VDouble>(shape, ones);
  const Gram<Element, VDouble> weight = inverse_mass_gram(pack, shape, unit);
  const VDouble length  = length_of<Element, VDouble>(unit.trace);
  const VDouble density = load(&points_.density[e]), c = load(&points_.sound_speed[e]);

  const VDouble rate   = stdx::min(motion.trace, VDouble(0.)) * (-1. / dt);
  const auto    bulk = evaluate(bulk_, density, c, length, rate);
  VDouble       q    = bulk.pressure;
  store(q, &viscous_pressure_[e]);
  if constexpr (corrected)
  {
    const VDouble weak = weak_share(length, rate, c) * q;
    store(weak, &weak_pressure_[e]);
    add_weak(pack, shape, weak);
    q -= weak;
  }
  store(-.5 * q * motion.trace * shape.volume, &half_viscous_[e]);
  VDouble damping = shape.volume * bulk.damping * weight.divergence;

  const double  shear     = shear_modulus_;
  const VDouble stiffness = density * c * c - 2. * shear;
  VDouble frequency2 =
    shape.volume * (stdx::max(stiffness, VDouble(0.)) * weight.divergence + 2. * shear * weight.largest);

  VDouble Q[Shape::modes][dim];
  if constexpr (Element::modes > 0)
  {
    const double  coefficient = options_.hourglass_coefficient;
    VDouble       skewness(0.), half(0.);
    double       *stored = &Q_[pack * modes * dim * width];
    const VDouble alive  = 1. - load(&points_.damage[e]);
    for (int m = 0; m < modes; ++m)
      for (int i = 0; i < dim; ++i)
        Q[m][i] = load(stored + (m * dim + i) * width);
    const VDouble resistance =
      viscous_hourglass_ ? coefficient * .25 * density * c * shape.volume / length
                         : coefficient * hourglass_modulus_ / corners * shape.volume * unit.trace;
    if (!viscous_hourglass_)
      turn<Element, VDouble>(motion.spin, Q);
    for (int m = 0; m < modes; ++m)
      for (int i = 0; i < dim; ++i)
      {
        VDouble next = viscous_hourglass_ ? resistance / dt * motion.rate[m][i]
                                          : Q[m][i] + resistance * motion.rate[m][i];
        stdx::where(alive <= 0., next) = VDouble(0.); // a failed element resists no pattern
        Q[m][i]                        = next;
        store(next, stored + (m * dim + i) * width);
        half += next * motion.rate[m][i];
        skewness += shape.skew[m][i] * shape.skew[m][i];
      }
    store(.5 * half, &half_hourglass_[e]);
    // |gamma| <= |Gamma| + |skew| |B/V|
    const VDouble pattern =
      std::sqrt(double(corners)) * stdx::sqrt(weight.trace / unit.trace) + stdx::sqrt(skewness * weight.trace);
    (viscous_hourglass_ ? damping : frequency2) += resistance * pattern * pattern;
  }
  else
    std::fill(&Q[0][0], &Q[0][0] + Shape::modes * dim, VDouble(0.));

  VDouble sigma[6], power(0.);
  for (int k = 0; k < 6; ++k)
    sigma[k] = load(&points_.sigma[k][e]) - (k < 3 ? q : VDouble(0.));
  if (!damping_share_.empty())
  {
    const VDouble share = add_damping(pack, length, motion, sigma);
    store(load(&half_viscous_[e]) + half_damping(pack, motion) * shape.volume, &half_viscous_[e]);
    damping += share * shape.volume * (stdx::max(stiffness, VDouble(0.)) * weight.divergence + 2. * shear * weight.largest);
  }
  for (int k = 0; k < 6; ++k)
    power += sigma[k] * motion.dual[k];
  store(.5 * shape.volume * power + load(&half_hourglass_[e]) * (1. / dt), &half_power_[e]);
  VDouble force[corners][dim];
  fem::corner_forces<Element, VDouble>(shape, sigma, Q, force);
  if constexpr (area_weighted)
    Element::to_section(shape, sigma, force);
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i, f += width)
      store(force[a][i], f);

  if (scaling_ > 0)
    scale_mass(pack, damping, frequency2);
  const VDouble bound   = .5 * damping + stdx::sqrt(.25 * damping * damping + frequency2);
  if (by_step_)
    store(bound, &bound_[e]);
  if (stdx::any_of(bound > limit_[0]))
  {
    const double largest = stdx::hmax(bound);
    limit_[0]            = largest;
    for (std::size_t lane = 0; lane < width; ++lane)
      if (bound[lane] == largest)
        limit_[1] = static_cast<double>(std::min(e + lane, n_ - 1));
  }
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;

} // namespace ogive::fem
