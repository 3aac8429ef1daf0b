// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

/// What one-point elements tell others: nodes, masses, books, samples, state.
namespace ogive::fem
{
template <class Element>
auto OnePointGroup<Element>::nodes(std::size_t e) const -> std::array<std::uint32_t, corners>
{
  std::array<std::uint32_t, corners> n;
  for (int a = 0; a < corners; ++a)
    n[a] = (own_.empty() ? node_ : own_)[slot(e, a, corners)];
  return n;
}

template <class Element>
void OnePointGroup<Element>::for_each_node(const typename ElementGroup<dim>::NodeVisitor &visit) const
{
  for (std::size_t e = 0; e < n_; ++e)
    for (int a = 0; a < corners; ++a)
      visit(node_[slot(e, a, corners)], slot(e, a * dim, corners * dim));
}

template <class Element>
void OnePointGroup<Element>::lump_mass(Nodes<dim> &nodes) const
{
  for (std::size_t e = 0; e < n_; ++e)
    for (int a = 0; a < corners; ++a)
    {
      const std::size_t k = slot(e, a, corners);
      nodes.mass[node_[k]] += Element::hoop ? corner_mass_[k] : (inertia_.empty() ? mass_ : inertia_)[e] / corners;
    }
}

template <class Element>
void OnePointGroup<Element>::scale_mass(std::size_t pack, VDouble damping, VDouble frequency2)
{
  const VDouble factor = mass_factor(damping, frequency2, scaling_);
  for (std::size_t e = pack * width; e < (pack + 1) * width; ++e)
  {
    inertia_[e] = mass_[e] * factor[e % width];
    if (e < n_)
      added_mass_ += inertia_[e] - mass_[e];
    if constexpr (Element::hoop)
      for (int a = 0; a < corners; ++a)
        corner_mass_[slot(e, a, corners)] *= factor[e % width];
  }
}

template <class Element>
StepStatus OnePointGroup<Element>::fail(const Nodes<dim> &nodes, std::size_t e, const char *why) const
{
  StepStatus status;
  status.ok             = false;
  status.culprit.entity = "element";
  status.culprit.body   = body_;
  status.culprit.id     = static_cast<std::int64_t>(first_element_ + e);
  status.culprit.why    = why;
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
      status.culprit.where[i] += nodes.x[i][node_[slot(e, a, corners)]] / corners;
  return status;
}

template <class Element>
StepStatus OnePointGroup<Element>::first_bad(const Nodes<dim> &nodes, std::size_t pack) const
{
  for (std::size_t lane = 0; lane < width; ++lane)
  {
    const std::size_t         e = std::min(pack * width + lane, n_ - 1);
    Geometry<Element, double> g;
    double                    x[corners][dim];
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i)
        x[a][i] = nodes.x[i][node_[slot(e, a, corners)]];
    Element::gradient(x, g);
    if (!(g.volume == g.volume))
      return fail(nodes, e, "not a number");
    if (!(g.volume > 0))
      return fail(nodes, e, "the element turned inside out");
    if (!(points_.energy[e] - points_.energy[e] == 0))
      return fail(nodes, e, "its energy is not a finite number");
  }
  return fail(nodes, std::min(pack * width, n_ - 1), "not a number");
}

template <class Element>
StepLimit OnePointGroup<Element>::stable_dt() const
{
  StepLimit limit;
  if (limit_[0] > 0)
    limit.dt = 2 / limit_[0];
  limit.culprit.entity = "element";
  limit.culprit.body   = body_;
  limit.culprit.id     = static_cast<std::int64_t>(first_element_) + static_cast<std::int64_t>(limit_[1]);
  limit.culprit.why    = "the stability bound of the element";
  return limit;
}

template <class Element>
void OnePointGroup<Element>::add_energies(Balance &balance) const
{
  double internal = 0, plastic = 0, heat = 0, patterns = 0;
  for (std::size_t e = 0; e < n_; ++e)
  {
    if (!alive(e))
      continue;
    internal += share(e) * mass_[e] * points_.energy[e];
    plastic += share(e) * mass_[e] * points_.plastic_work[e];
    heat += share(e) * viscous_heat_[e];
    patterns += share(e) * hourglass_energy_[e];
  }
  balance.plastic_work += plastic;
  balance.thermal += plastic * material_->parameters().thermal.heated_share();
  balance.bulk_viscosity_heat += heat;
  balance.hourglass_fem += patterns;
  balance.elastic += internal - plastic - heat;
}

template <class Element>
void OnePointGroup<Element>::sample(const Nodes<dim> &nodes, Sample &sample) const
{
  sample.nodes_per_cell = corners;
  for (int i = 0; i < 3; ++i)
  {
    sample.centre[i].assign(n_, 0.);
    sample.centre0[i].assign(n_, 0.);
  }
  sample.volume.resize(n_);
  sample.cells.resize(n_ * corners);
  const std::size_t first = std::find(nodes.body.begin(), nodes.body.end(), body_) - nodes.body.begin();
  for (std::size_t e = 0; e < n_; ++e)
  {
    for (int a = 0; a < corners; ++a)
    {
      const std::uint32_t node       = (own_.empty() ? node_ : own_)[slot(e, a, corners)];
      sample.cells[e * corners + a]  = static_cast<std::uint32_t>(node - first);
      for (int i = 0; i < dim; ++i)
      {
        sample.centre[i][e] += nodes.x[i][node] / corners;
        sample.centre0[i][e] += nodes.x0[i][node] / corners;
      }
    }
    sample.volume[e] = mass_[e] / points_.density[e];
  }
  const auto copy = [this](std::vector<double> &to, const AlignedVector<double> &from) {
    to.assign(from.begin(), from.begin() + n_);
  };
  for (int c = 0; c < 6; ++c)
    copy(sample.sigma[c], points_.sigma[c]);
  copy(sample.density, points_.density);
  copy(sample.energy, points_.energy);
  copy(sample.plastic_strain, points_.plastic_strain);
  copy(sample.damage, points_.damage);
  copy(sample.temperature, points_.temperature);
}

template <class Element>
void OnePointGroup<Element>::for_each_state(const Visitor &visit)
{
  points_.for_each_array([&](const char *name, AlignedVector<double> &a) { visit(name, a); });
  if (keeps_forces())
    visit("corner_force", corner_force_);
  for (int i = 0; i < dim; ++i)
    visit(std::string("nodal_force_") + "xyz"[i], nodal_force_[i]);
  visit("hourglass_force", Q_);
  visit("viscous_pressure", viscous_pressure_);
  if (corrected_)
  {
    visit("weak_pressure", weak_pressure_);
    visit("half_correction", half_correction_);
    for (int i = 0; i < dim; ++i)
      visit(std::string("weak_acceleration_") + "xyz"[i], weak_acceleration_[i]);
  }
  visit("half_hourglass", half_hourglass_);
  visit("half_viscous", half_viscous_);
  visit("half_power", half_power_);
  visit("hourglass_energy", hourglass_energy_);
  visit("viscous_heat", viscous_heat_);
  visit("limit", limit_);
  static constexpr const char *component[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  if (!damping_share_.empty())
    visit("damping_share", damping_share_);
  for (int c = 0; c < 6 && !damping_share_.empty(); ++c)
    visit(std::string("damping_stress_") + component[c], damping_stress_[c]);
  if (alive_.empty() && !bound_.empty())
    visit("bound", bound_);
  if (!alive_.empty())
  {
    visit("alive", alive_);
    visit("element_mass", mass_);
    visit("inertia", inertia_);
    visit("corner_mass", corner_mass_);
    visit("bound", bound_);
  }
}

template <class Element>
void OnePointGroup<Element>::copy_state(std::size_t e, materials::Points &to, std::size_t k) const
{
  std::vector<AlignedVector<double> *> fields;
  to.for_each_array([&](const char *, AlignedVector<double> &field) { fields.push_back(&field); });
  std::size_t f = 0;
  const_cast<materials::Points &>(points_).for_each_array(
    [&](const char *, AlignedVector<double> &field) { (*fields[f++])[k] = field[e]; });
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
