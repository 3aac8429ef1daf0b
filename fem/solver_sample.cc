// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/solver_implementation.h"

/// Copies of a body's state for those who look on.
namespace ogive::fem
{
namespace
{
template <class T>
void keep(std::vector<T> &values, const std::vector<bool> &wanted)
{
  if (values.empty())
    return;
  const std::size_t each = values.size() / wanted.size();
  std::size_t       kept = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (wanted[k / each])
      values[kept++] = values[k];
  values.resize(kept);
}

/// Takes dead elements out of a sample, and the nodes that have no others.
template <int dim>
void keep_the_living(const AllElements<dim> &all, std::size_t g, Sample &sample)
{
  std::vector<bool> alive(all.cells(g)), used(sample.mass.size(), false);
  for (std::size_t e = 0; e < alive.size(); ++e)
    alive[e] = all.alive(g, e);
  keep(sample.cells, alive);
  for (const std::uint32_t node : sample.cells)
    used[node] = true;
  std::vector<std::uint32_t> now(used.size());
  for (std::size_t a = 0, n = 0; a < used.size(); ++a)
    now[a] = used[a] ? static_cast<std::uint32_t>(n++) : 0;
  for (std::uint32_t &node : sample.cells)
    node = now[node];
  for (int i = 0; i < 3; ++i)
  {
    for (auto *field : {&sample.x[i], &sample.x0[i], &sample.v[i]})
      keep(*field, used);
    keep(sample.centre[i], alive);
    keep(sample.centre0[i], alive);
  }
  keep(sample.mass, used);
  keep(sample.radius, used);
  keep(sample.id, used);
  for (auto &component : sample.sigma)
    keep(component, alive);
  for (auto *field : {&sample.density, &sample.energy, &sample.plastic_strain, &sample.damage, &sample.temperature,
                      &sample.volume})
    keep(*field, alive);
}
/// Calls f(field) for all that a sample says of points.
template <class F>
void for_each_field(Sample &sample, F &&f)
{
  for (auto *fields : {&sample.centre, &sample.centre0})
    for (auto &component : *fields)
      f(component);
  for (auto &component : sample.sigma)
    f(component);
  for (auto *field : {&sample.density, &sample.energy, &sample.plastic_strain, &sample.damage, &sample.temperature,
                      &sample.volume})
    f(*field);
}

/// Points of the cells of all ranks from those of each.
template <int dim>
void gather_points(const Distribution<dim> &distribution, std::size_t b, Sample &sample)
{
  const auto              &body = distribution.bodies()[b];
  std::vector<double>      own;
  std::size_t              width = 0;
  for_each_field(sample, [&](std::vector<double> &) { ++width; });
  own.reserve(body.own.size() * body.cells_of * width);
  for (std::size_t k = 0; k < body.own.size() * body.cells_of; ++k)
    for_each_field(sample, [&](std::vector<double> &field) { own.push_back(field[k]); });
  std::vector<std::size_t> first;
  const auto               all = distribution.ranks().gather(own, &first);
  const std::size_t        n   = body.alive.size();
  for_each_field(sample, [&](std::vector<double> &field) { field.resize(n); });
  for (std::size_t cell = 0; cell < n; ++cell)
  {
    const double *from = &all[first[distribution.owner(b, cell)] + distribution.local(b, cell) * width];
    for_each_field(sample, [&](std::vector<double> &field) { field[cell] = *from++; });
  }
  sample.cells = body.mesh.cells;
}
} // namespace

template <int dim>
Sample Solver<dim>::sample(int body) const
{
  const auto &s = *self_;
  Sample      out;
  self_->complete_motion();
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    if (s.groups[g]->body() != body)
      continue;
    const std::size_t first = s.parts[g].first_node, last = s.parts[g].last_node;
    out.is_mesh             = true;
    for (int i = 0; i < 3; ++i)
      if (i < dim)
      {
        out.x[i].assign(s.nodes.x[i].begin() + first, s.nodes.x[i].begin() + last);
        out.x0[i].assign(s.nodes.x0[i].begin() + first, s.nodes.x0[i].begin() + last);
        out.v[i].assign(s.nodes.v[i].begin() + first, s.nodes.v[i].begin() + last);
      }
      else
        for (auto *field : {&out.x[i], &out.x0[i], &out.v[i]})
          field->assign(last - first, 0.);
    for (std::size_t a = first; a < last; ++a)
      out.mass.push_back(s.constraints.own_mass(s.nodes, a));
    out.radius.assign(last - first, 0.);
    out.id.assign(s.nodes.id.begin() + first, s.nodes.id.begin() + last);
    s.groups[g]->sample(s.nodes, out);
    if (!s.distribution.alone())
      gather_points(s.distribution, g, out);
    if (s.erosion.any())
      keep_the_living(s.all(), g, out);
  }
  return out;
}

template Sample Solver<1>::sample(int) const;
template Sample Solver<2>::sample(int) const;
template Sample Solver<3>::sample(int) const;
} // namespace ogive::fem
