// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/integrated_group.h"

#include "core/base/error.h"
#include "fem/elements/b_bar.h"
#include "fem/elements/spectral.h"
#include "fem/integrated_instances.h"

#include <algorithm>

namespace ogive::fem
{
/// Geometry and strains of a pack: from the strain half to the stress half.
template <class Element>
struct IntegratedGroup<Element>::Pack
{
  static constexpr std::size_t n = points_of * width;
  alignas(64) double strain[6][n], spin[3][n], density[n];
  Point   point[points_of];
  VDouble trace[points_of]; ///< increment of volume strain
};

template <class Element>
IntegratedGroup<Element>::IntegratedGroup(const BodyMesh<dim> &mesh, const GroupPlace &place,
                                          const input::FemOptions &options)
  : body_(mesh.body)
  , n_(mesh.n_elements())
  , padded_n_(padded(n_))
  , first_element_(place.first_element)
  , first_node_(place.first_node)
  , material_(mesh.material)
  , options_(options)
  , bulk_(bulk_viscosity(options))
  , shear_modulus_(mesh.material->shear_modulus())
{
  require(n_ > 0 || place.shared, "a body without elements");
  if constexpr (Element::collocated)
    line_ = line_eigenvalue(Element::degree);
  node_.resize(padded_n_ * nodes_of);
  node_mass_.resize(padded_n_ * nodes_of);
  node_force_.resize(padded_n_ * nodes_of * dim, 0.);
  for (auto &component : nodal_force_)
    component.resize(mesh.n_nodes(), 0.);
  for (auto *a : {&point_mass_, &viscous_pressure_, &half_work_, &half_viscous_, &viscous_heat_})
    a->resize(padded_n_ * points_of, 0.);
  points_.resize(padded_n_ * points_of);
  material_->initialise(points_, 0, padded_n_ * points_of);
  limit_ = {0., 0.};

  const std::vector<std::uint32_t> &elements = mesh.degree > 1 ? mesh.elements : mesh.cells;
  for (std::size_t e = 0; e < padded_n_; ++e)
  {
    const std::size_t element = std::min(e, n_ - 1);
    double            x[nodes_of][dim], share[nodes_of];
    for (int a = 0; a < nodes_of; ++a)
    {
      const std::uint32_t node    = elements[element * nodes_of + a];
      node_[slot(e, a, nodes_of)] = static_cast<std::uint32_t>(place.first_node + node);
      for (int i = 0; i < dim; ++i)
        x[a][i] = mesh.x[i][node];
    }
    node_volumes<Element>(x, share);
    for (int a = 0; a < nodes_of; ++a)
      node_mass_[slot(e, a, nodes_of)] = material_->density() * share[a];
    for (int q = 0; q < points_of; ++q)
    {
      PointGeometry<Element, double> g{};
      map_point(x, q, g);
      point_mass_[slot(e, q, points_of)] = material_->density() * g.volume;
    }
  }
  find_rows();
}

template <class Element>
void IntegratedGroup<Element>::initialise(const Nodes<dim> &nodes)
{
  if (options_.mass_scaling_step > 0)
  {
    scaling_ = 2 / options_.mass_scaling_step;
    start(nodes);
    scaling_ = 0;
    limit_   = {0., 0.};
  }
  start(nodes);
}

template <class Element>
void IntegratedGroup<Element>::start(const Nodes<dim> &nodes)
{
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    Field x;
    Pack  held;
    gather(nodes.x, pack, x);
    for (int q = 0; q < points_of; ++q)
    {
      map_point(x, q, held.point[q]);
      held.trace[q] = VDouble(0.);
    }
    stress(pack, x, held, 1.);
    scatter(pack);
  }
}

template <class Element>
VDouble IntegratedGroup<Element>::internal_work(std::size_t pack, const Field &v_mean, double kick) const
{
  const double *f = &node_force_[pack * nodes_of * dim * width];
  VDouble       power(0.);
  for (int a = 0; a < nodes_of; ++a)
    for (int i = 0; i < dim; ++i, f += width)
      power -= load(f) * v_mean[a][i];
  return power * kick;
}

template <class Element>
bool IntegratedGroup<Element>::strain(const Nodes<dim> &nodes, const TimeStep &step, std::size_t pack, Pack &held)
{
  Field x, v;
  gather(nodes.v_mean, pack, v);
  const VDouble work = internal_work(pack, v, step.kick);
  gather(nodes.x, pack, x);
  gather(nodes.v, pack, v);

  VDouble L[points_of][dim][dim], normal[points_of], volume(0.), growth(0.), mass(0.);
  auto    valid = VDouble(1.) > 0.;
  for (int q = 0; q < points_of; ++q)
  {
    Point &g = held.point[q];
    map_point(x, q, g);
    velocity_gradient(v, q, g, L[q]);
    normal[q] = VDouble(0.);
    if constexpr (Element::hoop)
      normal[q] = hoop_rate(v, q, g);
    valid = valid && g.volume > 0.;
    if constexpr (Element::mean_dilatation)
    {
      VDouble trace = normal[q];
      for (int i = 0; i < dim; ++i)
        trace += L[q][i][i];
      volume += g.volume;
      growth += g.volume * trace;
      mass += load(&point_mass_[at(pack, q)]);
    }
  }
  const VDouble mean = growth / volume, density = mass / volume;
  for (int q = 0; q < points_of; ++q)
  {
    if constexpr (Element::mean_dilatation)
    {
      VDouble trace = normal[q];
      for (int i = 0; i < dim; ++i)
        trace += L[q][i][i];
      const VDouble share = (mean - trace) * (1. / 3);
      for (int i = 0; i < dim; ++i)
        L[q][i][i] += share;
      normal[q] += share;
    }
    PointIncrement<VDouble> inc;
    increments_of<dim, VDouble>(L[q], normal[q], VDouble(step.drift), inc);
    held.trace[q] = inc.strain[0] + inc.strain[1] + inc.strain[2];
    for (int c = 0; c < 6; ++c)
      store(inc.strain[c], &held.strain[c][q * width]);
    for (int c = 0; c < 3; ++c)
      store(inc.spin[c], &held.spin[c][q * width]);
    store(Element::mean_dilatation ? density : load(&point_mass_[at(pack, q)]) / held.point[q].volume,
          &held.density[q * width]);
  }
  book_energy(pack, work, held);
  return stdx::all_of(valid) && stdx::all_of(work - work == 0.);
}

/// Stress and viscous pressure of t_n times strains, per volume.
template <class Element>
VDouble IntegratedGroup<Element>::stress_power(std::size_t pack, int q, const VDouble (&strain)[6]) const
{
  const std::size_t p = at(pack, q);
  VDouble           sum(0.);
  for (int c = 0; c < 6; ++c)
    sum += (c < 3 ? 1. : 2.) * load(&points_.sigma[c][p]) * strain[c];
  return sum - load(&viscous_pressure_[p]) * (strain[0] + strain[1] + strain[2]);
}

/// The element's work is exact; its points share it by the power of the stress
/// of t_n over half of the last and half of this step, and what is missing, of
/// second order, by their mass.
template <class Element>
void IntegratedGroup<Element>::book_energy(std::size_t pack, VDouble work, const Pack &held)
{
  VDouble known(0.), mass(0.), part[points_of];
  for (int q = 0; q < points_of; ++q)
  {
    const std::size_t p = at(pack, q);
    VDouble           strain[6];
    for (int c = 0; c < 6; ++c)
      strain[c] = load(&held.strain[c][q * width]);
    part[q] = load(&half_work_[p]) + .5 * held.point[q].volume * stress_power(pack, q, strain);
    known += part[q];
    mass += load(&point_mass_[p]);
    const VDouble heat =
      load(&half_viscous_[p]) - .5 * load(&viscous_pressure_[p]) * held.trace[q] * held.point[q].volume;
    store(load(&viscous_heat_[p]) + heat, &viscous_heat_[p]);
  }
  const VDouble missing = (work - known) / mass;
  for (int q = 0; q < points_of; ++q)
  {
    const std::size_t p = at(pack, q);
    store(load(&points_.energy[p]) + part[q] / load(&point_mass_[p]) + missing, &points_.energy[p]);
  }
}

template <class Element>
StepStatus IntegratedGroup<Element>::advance(const Nodes<dim> &nodes, const TimeStep &step)
{
  limit_ = {0., 0.};
  for (auto &component : nodal_force_)
    std::fill(component.begin(), component.end(), 0.);
  Pack held;
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    if (!strain(nodes, step, pack, held))
      return first_bad(nodes, pack);
    if ((pack + 1) * width < padded_n_)
      fetch(pack + 1);
    materials::Increments increments;
    for (int c = 0; c < 6; ++c)
      increments.strain[c] = held.strain[c];
    for (int c = 0; c < 3; ++c)
      increments.spin[c] = held.spin[c];
    increments.density = held.density;
    increments.dt      = step.drift;
    std::size_t             bad    = 0;
    const materials::Status status = material_->update(points_, at(pack, 0), at(pack + 1, 0), increments, bad);
    if (status != materials::Status::ok)
      return fail(nodes, std::min(bad / (points_of * width) * width + bad % width, n_ - 1), materials::describe(status));
    Field x;
    gather(nodes.x, pack, x);
    stress(pack, x, held, step.drift);
    scatter(pack);
    for (int q = 0; q < points_of; ++q)
    {
      VDouble inc[6];
      for (int c = 0; c < 6; ++c)
        inc[c] = load(&held.strain[c][q * width]);
      const VDouble half = .5 * held.point[q].volume;
      store(half * stress_power(pack, q, inc), &half_work_[at(pack, q)]);
      store(-half * load(&viscous_pressure_[at(pack, q)]) * held.trace[q], &half_viscous_[at(pack, q)]);
    }
  }
  return {};
}

template <class Element>
VDouble IntegratedGroup<Element>::inverse_node_masses(std::size_t pack, VDouble (&inverse)[nodes_of]) const
{
  VDouble least(std::numeric_limits<double>::infinity());
  for (int a = 0; a < nodes_of; ++a)
  {
    const VDouble mass = load(&node_mass_[(pack * nodes_of + a) * width]);
    inverse[a]         = 1. / mass;
    if constexpr (Element::collocated)
      least = stdx::min(least, mass * (1. / Element::weight(a)));
  }
  return least;
}

/// Viscous pressures of the points and the step bound
/// dt <= 2/(D/2 + sqrt(D^2/4 + w^2)), as in OnePointGroup.
template <class Element>
void IntegratedGroup<Element>::viscosity(std::size_t pack, const Field &x, const Pack &held, double dt,
                                         VDouble (&q_of)[points_of])
{
  VDouble                inverse[nodes_of];
  const VDouble          least = inverse_node_masses(pack, inverse);
  VDouble                damping(0.), frequency2(0.), stiffest(0.);
  ShapeBound<VDouble>    shape{};
  if constexpr (!Element::collocated)
    shape = shape_bound<Element, VDouble>(x, held.point, inverse);
  for (int q = 0; q < points_of; ++q)
  {
    const std::size_t p       = at(pack, q);
    const VDouble     density = load(&points_.density[p]), c = load(&points_.sound_speed[p]);
    VDouble           length;
    if constexpr (Element::collocated)
      length = point_length<Element, VDouble>(held.point[q]);
    else
      length = shape.length;
    const auto bulk =
      evaluate(bulk_, density, c, length, VDouble(stdx::min(held.trace[q], VDouble(0.)) * (-1. / dt)));
    q_of[q]         = bulk.pressure;
    store(bulk.pressure, &viscous_pressure_[p]);
    const VDouble lambda = stdx::max(VDouble(density * c * c - 2. * shear_modulus_), VDouble(0.));
    if constexpr (Element::collocated)
    {
      const VDouble unit = point_bound<Element, VDouble>(q, held.point[q], line_, least);
      frequency2         = stdx::max(frequency2, VDouble((lambda + 2. * shear_modulus_) * unit));
      damping            = stdx::max(damping, VDouble(bulk.damping * unit));
    }
    else
    {
      stiffest = stdx::max(stiffest, lambda);
      damping  = stdx::max(damping, bulk.damping);
    }
  }
  if constexpr (!Element::collocated)
  {
    frequency2 = shape.frequency2(stiffest, shear_modulus_, Element::mean_dilatation);
    damping    = damping * (Element::mean_dilatation ? shape.divergence :
                                                       VDouble(shape.divergence + shape.departures + 2. * shape.cross));
  }
  limit_by(pack, damping, frequency2);
}

template <class Element>
void IntegratedGroup<Element>::limit_by(std::size_t pack, VDouble damping, VDouble frequency2)
{
  if (scaling_ > 0)
    scale_mass(pack, damping, frequency2);
  const VDouble bound   = .5 * damping + stdx::sqrt(.25 * damping * damping + frequency2);
  const double  largest = stdx::hmax(bound);
  if (largest > limit_[0])
  {
    limit_[0] = largest;
    for (std::size_t lane = 0; lane < width; ++lane)
      if (bound[lane] == largest)
        limit_[1] = static_cast<double>(std::min(pack * width + lane, n_ - 1));
  }
}

template <class Element>
void IntegratedGroup<Element>::stress(std::size_t pack, const Field &x, const Pack &held, double dt)
{
  VDouble q_of[points_of];
  viscosity(pack, x, held, dt, q_of);
  // The transpose of the mean volume strain: every point presses with the mean.
  VDouble mean(0.), volume(0.);
  if constexpr (Element::mean_dilatation)
  {
    for (int q = 0; q < points_of; ++q)
    {
      const std::size_t p = at(pack, q);
      const VDouble     own =
        (load(&points_.sigma[0][p]) + load(&points_.sigma[1][p]) + load(&points_.sigma[2][p])) * (1. / 3) - q_of[q];
      mean += held.point[q].volume * own;
      volume += held.point[q].volume;
    }
    mean = mean / volume;
  }
  Field force;
  for (auto &node : force)
    std::fill(std::begin(node), std::end(node), VDouble(0.));
  for (int q = 0; q < points_of; ++q)
  {
    const std::size_t p = at(pack, q);
    VDouble           sigma[6];
    for (int c = 0; c < 6; ++c)
      sigma[c] = load(&points_.sigma[c][p]);
    const VDouble shift = Element::mean_dilatation ? VDouble(mean - (sigma[0] + sigma[1] + sigma[2]) * (1. / 3)) :
                                                     VDouble(-q_of[q]);
    for (int c = 0; c < 3; ++c)
      sigma[c] += shift;
    add_forces(sigma, q, held.point[q], force);
  }
  double *f = &node_force_[pack * nodes_of * dim * width];
  for (int a = 0; a < nodes_of; ++a)
    for (int i = 0; i < dim; ++i, f += width)
      store(force[a][i], f);
}

OGIVE_INSTANTIATE_INTEGRATED(template class, IntegratedGroup)
} // namespace ogive::fem
