// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/solver.h"

#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <cmath>

namespace ogive::fem
{
template <int dim>
Solver<dim>::Solver(const Parameters &parameters, std::vector<BodyMesh<dim>> meshes)
  : self_(std::make_unique<Implementation>())
{
  self_->parameters = parameters;
  self_->build(std::move(meshes));
}
template <int dim>
Solver<dim>::~Solver() = default;

template <int dim>
void Solver<dim>::Implementation::build(std::vector<BodyMesh<dim>> meshes)
{
  std::vector<std::size_t> first_node;
  std::vector<GroupPlace>  place;
  std::size_t              n_nodes = 0, n_elements = 0;
  for (const auto &mesh : meshes)
  {
    require(mesh.axisymmetric == parameters.axisymmetric, "mesh and solver disagree about axial symmetry");
    first_node.push_back(n_nodes);
    parts.push_back({n_nodes, n_nodes + mesh.n_nodes(), n_elements, {}});
    n_nodes += mesh.n_nodes();
    n_elements += mesh.n_cells();
  }
  std::size_t n_all = n_nodes; // with the graves of eroding bodies
  for (std::size_t b = 0; b < meshes.size(); ++b)
  {
    place.push_back({first_node[b], parts[b].first_element, n_all});
    n_all += meshes[b].erosion.on ? ElementGroup<dim>::corners : 0;
  }
  nodes.resize(n_all);
  std::fill(nodes.body.begin() + static_cast<std::ptrdiff_t>(n_nodes), nodes.body.end(), -1);
  for (int i = 0; i < dim; ++i)
  {
    v_old[i].resize(n_all, 0.);
    load[i].resize(n_all, 0.);
  }
  for (std::size_t b = 0; b < meshes.size(); ++b)
  {
    const auto &mesh = meshes[b];
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    {
      const std::size_t node = first_node[b] + a;
      nodes.body[node]       = mesh.body;
      nodes.id[node]         = static_cast<std::int64_t>(node);
      for (int i = 0; i < dim; ++i)
      {
        nodes.x0[i][node] = nodes.x[i][node] = mesh.x[i][a];
        nodes.v[i][node]                     = mesh.v[i].at(a);
      }
    }
    groups.push_back(make_one_point_group(mesh, place[b], parameters.options));
    groups.back()->lump_mass(nodes);
    groups.back()->initialise(nodes);
    if (mesh.erosion.on)
      groups.back()->prepare_erosion(nodes);
  }
  for (std::size_t a = 0; a < n_nodes; ++a)
    if (!(nodes.mass[a] > 0))
      throw InputError("node " + std::to_string(a) + " of the mesh belongs to no element");
  prescribed = PrescribedMotion<dim>(parameters, meshes, first_node);
  prescribed.start(nodes);
  pressures = Pressures<dim>(parameters, meshes, first_node);
  erosion = Erosion<dim>(meshes, place, parameters.axisymmetric);
  face.n  = nodes.size();
  review_erosion();
  walls = RigidWalls<dim>(parameters, wall_nodes(meshes));
}

// Nodes of eroding bodies may come to the surface.
template <int dim>
std::vector<std::uint32_t>
Solver<dim>::Implementation::wall_nodes(const std::vector<BodyMesh<dim>> &meshes) const
{
  std::vector<std::uint32_t> touching = face.contact_points;
  for (std::size_t b = 0; b < meshes.size(); ++b)
    for (std::size_t a = parts[b].first_node; meshes[b].erosion.on && a < parts[b].last_node; ++a)
      touching.push_back(static_cast<std::uint32_t>(a));
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

/// Forces and surface of those who live.
template <int dim>
void Solver<dim>::Implementation::review_erosion()
{
  erosion.review(groups, face);
  for (std::size_t g = 0; g < groups.size(); ++g)
    parts[g].sum = CornerSum<dim>(parts[g].first_node, parts[g].last_node, *groups[g]);
}

template <int dim>
StepLimit Solver<dim>::stable_dt() const
{
  const auto &s = *self_;
  StepLimit   limit;
  for (const auto &group : s.groups)
    limit.tighten(group->stable_dt());
  if (limit.culprit.id >= 0)
    for (std::size_t g = 0; g < s.groups.size(); ++g)
      if (s.groups[g]->body() == limit.culprit.body)
        for (const std::uint32_t node : s.groups[g]->nodes(limit.culprit.id - s.parts[g].first_element))
          for (int i = 0; i < dim; ++i)
            limit.culprit.where[i] += s.nodes.x[i][node] / ElementGroup<dim>::corners;
  limit.dt *= s.parameters.options.step_factor;
  return limit;
}

template <int dim>
StepStatus Solver<dim>::step(const TimeStep &step)
{
  auto &s = *self_;
  s.kick(step);
  s.prescribed.apply(s.nodes, s.v_old, s.work);
  s.walls.apply(step, s.prescribed, s.nodes, s.v_old, s.work);
  s.drift(step.drift);
  s.book_pressure(step.kick);
  for (std::size_t g = 0; g < s.groups.size(); ++g)
  {
    const StepStatus status = s.groups[g]->advance(s.nodes, step);
    if (!status.ok)
      return status;
    s.updates += s.groups[g]->size();
  }
  if (s.erosion.any() && s.erosion.kill_failed(s.groups, s.nodes))
    s.review_erosion();
  return s.check_nodes();
}

template <int dim>
void Solver<dim>::Implementation::kick(const TimeStep &step)
{
  if (!pressures.empty())
  {
    for (auto &component : load)
      std::fill(component.begin(), component.end(), 0.);
    pressures.add(nodes, load);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const double *corner = groups[g]->corner_forces().data();
    for (std::size_t a = parts[g].first_node; a < parts[g].last_node; ++a)
    {
      double f[dim];
      parts[g].sum.at(a, corner, f);
      const double per_mass = nodes.mass[a] > 0 ? step.kick / nodes.mass[a] : 0; // without elements: none
      for (int i = 0; i < dim; ++i)
      {
        v_old[i][a] = nodes.v[i][a];
        nodes.v[i][a] += per_mass * (f[i] + nodes.force[i][a] + load[i][a]);
        nodes.force[i][a] = 0;
      }
    }
  }
}

template <int dim>
void Solver<dim>::Implementation::drift(double dt)
{
  for (int i = 0; i < dim; ++i)
  {
    double       *x = nodes.x[i].data(), *mean = nodes.v_mean[i].data();
    const double *v = nodes.v[i].data(), *old = v_old[i].data();
    for (std::size_t a = 0; a < nodes.size(); ++a)
    {
      mean[a] = .5 * (v[a] + old[a]);
      x[a] += dt * v[a];
    }
  }
}

template <int dim>
void Solver<dim>::Implementation::book_pressure(double kick)
{
  if (!pressures.empty())
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < nodes.size(); ++a)
      {
        work.external += kick * load[i][a] * nodes.v_mean[i][a];
        work.impulse[i] += kick * load[i][a];
      }
}

template <int dim>
StepStatus Solver<dim>::Implementation::check_nodes() const
{
  double sum = 0; // one NaN or infinity among the velocities shows in the sum of 0 v
  for (int i = 0; i < dim; ++i)
    for (const double v : nodes.v[i])
      sum += 0. * v;
  if (sum == 0)
    return {};
  StepStatus status;
  status.ok = false;
  for (std::size_t a = 0; a < nodes.size() && status.culprit.id < 0; ++a)
    for (int i = 0; i < dim; ++i)
      if (!std::isfinite(nodes.v[i][a]))
      {
        status.culprit.entity = "node";
        status.culprit.body   = nodes.body[a];
        status.culprit.id     = nodes.id[a];
        status.culprit.why    = "its velocity is not a finite number";
        for (int k = 0; k < dim; ++k)
          status.culprit.where[k] = nodes.x0[k][a];
        break;
      }
  return status;
}

template class Solver<1>;
template class Solver<2>;
template class Solver<3>;
} // namespace ogive::fem
