// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/integrated_group.h"
#include "fem/integrated_instances.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

/// What elements with several points tell others: nodes, masses, books, samples,
/// state.
namespace ogive::fem
{
namespace
{
/// Node of the element at corner c (VTK order) of its cell k.
template <class Element>
int corner_of(std::size_t k, int c)
{
  if constexpr (!Element::collocated)
    return c;
  else
  {
    int node = 0, cell = static_cast<int>(k);
    for (int i = 0; i < Element::dim; ++i)
    {
      node += (cell % Element::degree + (Full<Element::dim, false>::sign(i, c) > 0)) * Element::stride(i);
      cell /= Element::degree;
    }
    return node;
  }
}

template <int degree>
double largest_of_line()
{
  constexpr Lobatto<degree> line{};
  Eigen::MatrixXd           K = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; b <= degree; ++b)
      for (int q = 0; q <= degree; ++q)
        K(a, b) += line.weight[q] * line.slope[q][a] * line.slope[q][b] /
                   std::sqrt(line.weight[a] * line.weight[b]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}
} // namespace

double line_eigenvalue(int degree)
{
  return degree == 2 ? largest_of_line<2>() : degree == 3 ? largest_of_line<3>() : largest_of_line<4>();
}

template <class Element>
std::size_t IntegratedGroup<Element>::cells() const
{
  return n_ * cells_of;
}

template <class Element>
auto IntegratedGroup<Element>::nodes(std::size_t cell) const -> std::array<std::uint32_t, Base::corners>
{
  std::array<std::uint32_t, Base::corners> n;
  for (int c = 0; c < Base::corners; ++c)
    n[c] = node_[slot(cell / cells_of, corner_of<Element>(cell % cells_of, c), nodes_of)];
  return n;
}

template <class Element>
void IntegratedGroup<Element>::for_each_node(const NodeVisitor &visit) const
{
  for (std::size_t e = 0; e < n_; ++e)
    for (int a = 0; a < nodes_of; ++a)
      visit(node_[slot(e, a, nodes_of)], slot(e, a * dim, nodes_of * dim));
}

template <class Element>
void IntegratedGroup<Element>::lump_mass(Nodes<dim> &nodes) const
{
  for (std::size_t e = 0; e < n_; ++e)
    for (int a = 0; a < nodes_of; ++a)
      nodes.mass[node_[slot(e, a, nodes_of)]] += node_mass_[slot(e, a, nodes_of)];
}

template <class Element>
void IntegratedGroup<Element>::scale_mass(std::size_t pack, VDouble damping, VDouble frequency2)
{
  const VDouble factor = mass_factor(damping, frequency2, scaling_);
  for (std::size_t e = pack * width; e < (pack + 1) * width; ++e)
    for (int a = 0; a < nodes_of; ++a)
    {
      double &mass = node_mass_[slot(e, a, nodes_of)];
      if (e < n_)
        added_mass_ += mass * (factor[e % width] - 1);
      mass *= factor[e % width];
    }
}

template <class Element>
StepStatus IntegratedGroup<Element>::fail(const Nodes<dim> &nodes, std::size_t e, const char *why) const
{
  StepStatus status;
  status.ok             = false;
  status.culprit.entity = "element";
  status.culprit.body   = body_;
  status.culprit.id     = static_cast<std::int64_t>(first_element_ + e * cells_of);
  status.culprit.why    = why;
  for (int a = 0; a < nodes_of; ++a)
    for (int i = 0; i < dim; ++i)
      status.culprit.where[i] += nodes.x[i][node_[slot(e, a, nodes_of)]] / nodes_of;
  return status;
}

template <class Element>
StepStatus IntegratedGroup<Element>::first_bad(const Nodes<dim> &nodes, std::size_t pack) const
{
  for (std::size_t lane = 0; lane < width; ++lane)
  {
    const std::size_t e = std::min(pack * width + lane, n_ - 1);
    double            x[nodes_of][dim];
    for (int a = 0; a < nodes_of; ++a)
      for (int i = 0; i < dim; ++i)
        x[a][i] = nodes.x[i][node_[slot(e, a, nodes_of)]];
    for (int q = 0; q < points_of; ++q)
    {
      PointGeometry<Element, double> g{};
      map_point(x, q, g);
      if (!(g.volume == g.volume))
        return fail(nodes, e, "not a number");
      if (!(g.volume > 0))
        return fail(nodes, e, "the element turned inside out");
      if (!(points_.energy[slot(e, q, points_of)] - points_.energy[slot(e, q, points_of)] == 0))
        return fail(nodes, e, "its energy is not a finite number");
    }
  }
  return fail(nodes, std::min(pack * width, n_ - 1), "not a number");
}

template <class Element>
StepLimit IntegratedGroup<Element>::stable_dt() const
{
  StepLimit limit;
  if (limit_[0] > 0)
    limit.dt = 2 / limit_[0];
  limit.culprit.entity = "element";
  limit.culprit.body   = body_;
  limit.culprit.id =
    static_cast<std::int64_t>(first_element_) + static_cast<std::int64_t>(limit_[1]) * static_cast<std::int64_t>(cells_of);
  limit.culprit.why = "the stability bound of the element";
  return limit;
}

template <class Element>
void IntegratedGroup<Element>::add_energies(Balance &balance) const
{
  double internal = 0, plastic = 0, heat = 0;
  for (std::size_t e = 0; e < n_; ++e)
    for (int q = 0; q < points_of; ++q)
    {
      const std::size_t p = slot(e, q, points_of);
      internal += point_mass_[p] * points_.energy[p];
      plastic += point_mass_[p] * points_.plastic_work[p];
      heat += viscous_heat_[p];
    }
  balance.plastic_work += plastic;
  balance.thermal += plastic * material_->parameters().thermal.heated_share();
  balance.bulk_viscosity_heat += heat;
  balance.elastic += internal - plastic - heat;
}

/// Cells of a spectral element lie between its nodes and show the mean of their
/// corners; other elements show the mean of their points.
template <class Element>
void IntegratedGroup<Element>::copy_state(std::size_t cell, materials::Points &to, std::size_t k) const
{
  std::vector<AlignedVector<double> *> fields;
  to.for_each_array([&](const char *, AlignedVector<double> &field) { fields.push_back(&field); });
  std::size_t f = 0;
  const_cast<materials::Points &>(points_).for_each_array([&](const char *, AlignedVector<double> &field) {
    double &mean = (*fields[f++])[k];
    mean         = 0;
    for (int c = 0; c < Base::corners; ++c)
      mean += field[slot(cell / cells_of, corner_of<Element>(cell % cells_of, c), points_of)] / Base::corners;
  });
}

template <class Element>
void IntegratedGroup<Element>::sample(const Nodes<dim> &all, Sample &sample) const
{
  const std::size_t count = cells(), first = std::find(all.body.begin(), all.body.end(), body_) - all.body.begin();
  sample.nodes_per_cell   = Base::corners;
  for (int i = 0; i < 3; ++i)
  {
    sample.centre[i].assign(count, 0.);
    sample.centre0[i].assign(count, 0.);
  }
  sample.volume.assign(count, 0.);
  sample.cells.resize(count * Base::corners);
  const auto mean = [&](std::vector<double> &to, const AlignedVector<double> &from) {
    to.assign(count, 0.);
    for (std::size_t k = 0; k < count; ++k)
      for (int c = 0; c < Base::corners; ++c)
        to[k] += from[slot(k / cells_of, corner_of<Element>(k % cells_of, c), points_of)] / Base::corners;
  };
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto corner = nodes(k);
    for (int c = 0; c < Base::corners; ++c)
    {
      sample.cells[k * Base::corners + c] = static_cast<std::uint32_t>(corner[c] - first);
      for (int i = 0; i < dim; ++i)
      {
        sample.centre[i][k] += all.x[i][corner[c]] / Base::corners;
        sample.centre0[i][k] += all.x0[i][corner[c]] / Base::corners;
      }
    }
    double mass = 0;
    for (int q = 0; q < points_of; ++q)
      mass += point_mass_[slot(k / cells_of, q, points_of)] / cells_of;
    sample.volume[k] = mass;
  }
  for (int c = 0; c < 6; ++c)
    mean(sample.sigma[c], points_.sigma[c]);
  mean(sample.density, points_.density);
  mean(sample.energy, points_.energy);
  mean(sample.plastic_strain, points_.plastic_strain);
  mean(sample.damage, points_.damage);
  mean(sample.temperature, points_.temperature);
  for (std::size_t k = 0; k < count; ++k)
    sample.volume[k] /= sample.density[k];
}

template <class Element>
void IntegratedGroup<Element>::for_each_state(const Visitor &visit)
{
  points_.for_each_array([&](const char *name, AlignedVector<double> &a) { visit(name, a); });
  visit("node_force", node_force_);
  for (int i = 0; i < dim; ++i)
    visit(std::string("nodal_force_") + "xyz"[i], nodal_force_[i]);
  visit("viscous_pressure", viscous_pressure_);
  visit("half_work", half_work_);
  visit("half_viscous", half_viscous_);
  visit("viscous_heat", viscous_heat_);
  visit("limit", limit_);
}

OGIVE_INSTANTIATE_INTEGRATED(template class, IntegratedGroup)
} // namespace ogive::fem
