// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/solver.h"

#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  place_bodies(meshes);
  if (!distribution.alone())
    share_out();
  for (std::size_t b = 0; b < meshes.size(); ++b)
    start_body(meshes[b], b);
  const std::size_t n_nodes = parts.empty() ? 0 : parts.back().last_node;
  for (std::size_t a = 0; a < n_nodes; ++a)
    if (!(nodes.mass[a] > 0))
      throw InputError("node " + std::to_string(a) + " of the mesh belongs to no element");
  std::vector<std::size_t> first_node;
  for (const Part &part : parts)
    first_node.push_back(part.first_node);
  constraints.fold_mass(nodes);
  prescribed = PrescribedMotion<dim>(parameters, meshes, first_node, constraints);
  prescribed.start(nodes);
  constraints.follow(nodes);
  loads     = Loads<dim>(parameters, meshes, first_node, constraints);
  absorbing = AbsorbingFaces<dim>(parameters, meshes, first_node, constraints);
  erosion   = Erosion<dim>(meshes, places, parameters.axisymmetric);
  face.n    = nodes.size();
  review_erosion();
  walls    = RigidWalls<dim>(parameters, wall_nodes(meshes));
  critical = CriticalStep<dim>(nodes.size());
  for (int i = 0; i < dim; ++i)
    for (std::size_t a = 0; a < n_nodes; ++a)
      nodes.held[i][a] = prescribed.prescribed(a, i);
  if (parameters.options.step_bound == "power-iteration")
    sharpening[0] = std::max(1., find_critical(1e-6, 5000).dt / element_limit().dt);
}

/// Numbers bodies, nodes and elements, and puts the nodes in their places.
template <int dim>
void Solver<dim>::Implementation::place_bodies(std::vector<BodyMesh<dim>> &meshes)
{
  std::vector<std::size_t> first_node;
  std::size_t              n_nodes = 0, n_elements = 0;
  for (const auto &mesh : meshes)
  {
    require(mesh.axisymmetric == parameters.axisymmetric, "mesh and solver disagree about axial symmetry");
    first_node.push_back(n_nodes);
    parts.push_back({n_nodes, n_nodes + mesh.n_nodes(), n_elements});
    n_nodes += mesh.n_nodes();
    n_elements += mesh.n_cells();
  }
  constraints  = Constraints<dim>(parameters, meshes, first_node);
  distribution = Distribution<dim>(parameters.ranks, meshes, first_node);
  std::size_t n_all = n_nodes; // with the graves of eroding bodies
  for (std::size_t b = 0; b < meshes.size(); ++b)
  {
    places.push_back({first_node[b], parts[b].first_element, n_all});
    if (!distribution.alone())
    {
      places[b].shared = &distribution.shared();
      places[b].own    = &distribution.bodies()[b].own;
    }
    n_all += meshes[b].loses_elements() ? ElementGroup<dim>::corners : 0;
  }
  nodes.resize(n_all);
  std::fill(nodes.body.begin() + static_cast<std::ptrdiff_t>(n_nodes), nodes.body.end(), -1);
  for (int i = 0; i < dim; ++i)
  {
    v_old[i].resize(n_all, 0.);
    load[i].resize(n_all, 0.);
  }
  for (std::size_t b = 0; b < meshes.size(); ++b)
    for (std::size_t a = 0; a < meshes[b].n_nodes(); ++a)
    {
      const std::size_t node = first_node[b] + a;
      nodes.body[node]       = meshes[b].body;
      nodes.id[node]         = static_cast<std::int64_t>(node);
      for (int i = 0; i < dim; ++i)
      {
        nodes.x0[i][node] = nodes.x[i][node] = meshes[b].x[i][a];
        nodes.v[i][node]                     = meshes[b].v[i].at(a);
      }
    }
}

/// The elements of a body and the masses of its nodes.
template <int dim>
void Solver<dim>::Implementation::start_body(const BodyMesh<dim> &mesh, std::size_t b)
{
  groups.push_back(make_element_group<dim>(distribution.alone() ? mesh : distribution.own_mesh(b), places[b],
                                           parameters.options));
  groups.back()->initialise(nodes);
  groups.back()->lump_mass(nodes);
  add_up(parts[b].first_node, parts[b].last_node);
  if (const double added = sum(groups.back()->added_mass()); added > 0)
  {
    double mass = 0;
    for (std::size_t a = parts[b].first_node; a < parts[b].last_node; ++a)
      mass += nodes.mass[a];
    added_masses.push_back({mesh.body, added, added / (mass - added)});
  }
  if (mesh.loses_elements())
    groups.back()->prepare_erosion(nodes);
}

// Nodes of bodies that lose elements may come to the surface.
template <int dim>
std::vector<std::uint32_t>
Solver<dim>::Implementation::wall_nodes(const std::vector<BodyMesh<dim>> &meshes) const
{
  std::vector<std::uint32_t> touching = face.contact_points;
  for (std::size_t b = 0; b < meshes.size(); ++b)
    for (std::size_t a = parts[b].first_node; meshes[b].loses_elements() && a < parts[b].last_node; ++a)
      touching.push_back(static_cast<std::uint32_t>(a));
  // Slaves stop where their masters do.
  std::erase_if(touching, [this](std::uint32_t a) { return constraints.is_slave(a); });
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

/// The surface of those who live.
template <int dim>
void Solver<dim>::Implementation::review_erosion()
{
  erosion.review(all(), face);
  find_shown();
}

template <int dim>
void Solver<dim>::Implementation::find_shown()
{
  if (distribution.alone())
    return;
  std::vector<bool> seen(nodes.size(), false);
  for (const auto &[name, asked] : followed)
    for (const std::uint32_t a : asked)
      seen[a] = true;
  for (const auto &facet : face.facets) // the whole elements: others may ride in them
  {
    const auto at = find(facet.element);
    for (const std::uint32_t a : distribution.nodes(at.group, at.element))
      seen[a] = true;
  }
  std::vector<std::uint32_t> at_surface;
  for (std::uint32_t a = 0; a < seen.size(); ++a)
    if (seen[a])
      at_surface.push_back(a);
  shown = distribution.list(at_surface);
}

template <int dim>
void Solver<dim>::follow(const std::string &who, std::span<const std::uint32_t> nodes)
{
  self_->followed[who].assign(nodes.begin(), nodes.end());
  self_->find_shown();
}

template <int dim>
StepLimit Solver<dim>::Implementation::element_limit() const
{
  StepLimit limit;
  for (const auto &group : groups)
    limit.tighten(group->stable_dt());
  if (limit.culprit.id >= 0 && limit.dt < std::numeric_limits<double>::infinity())
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g]->body() == limit.culprit.body)
        for (const std::uint32_t node : groups[g]->nodes(limit.culprit.id - parts[g].first_element))
          for (int i = 0; i < dim; ++i)
            limit.culprit.where[i] += nodes.x[i][node] / ElementGroup<dim>::corners;
  return agree(limit);
}

template <int dim>
StepLimit Solver<dim>::stable_dt() const
{
  StepLimit limit = self_->element_limit();
  limit.dt *= self_->sharpening[0] * self_->parameters.options.step_factor;
  // The bound of elements holds for their own corner masses; where tied particles
  // take mass from a node, w^2 grows by no more than that node's loss.
  limit.dt *= std::sqrt(self_->least_factor);
  return limit;
}

template <int dim>
typename CriticalStep<dim>::Answer Solver<dim>::Implementation::find_critical(double tolerance, int most)
{
  typename CriticalStep<dim>::Groups all;
  for (const auto &group : groups)
    all.push_back(group.get());
  return critical.estimate(all, nodes, {prescribed, constraints, distribution.alone() ? nullptr : &distribution.shared()},
                           tolerance, most);
}

template <int dim>
StepLimit Solver<dim>::critical_dt()
{
  const auto found = self_->find_critical(1e-6, 5000);
  StepLimit  limit;
  limit.dt             = found.dt;
  limit.culprit.entity = "node";
  limit.culprit.body   = self_->nodes.body[found.node];
  limit.culprit.id     = self_->nodes.id[found.node];
  limit.culprit.why    = "the fastest motion of the mesh, by power iteration";
  for (int i = 0; i < dim; ++i)
    limit.culprit.where[i] = self_->nodes.x[i][found.node];
  return limit;
}

/// A look at the assembled mesh now and then: its critical step lies above the
/// bound of its worst element by a factor that changes slowly.
template <int dim>
void Solver<dim>::Implementation::sharpen()
{
  constexpr double every = 20; // steps
  sharpening[1] += 1;
  if (sharpening[1] < every)
    return;
  sharpening[1] = 0;
  sharpening[0] = std::max(1., find_critical(1e-4, 200).dt / element_limit().dt);
}

template <int dim>
StepStatus Solver<dim>::step(const TimeStep &step)
{
  self_->kick(step);
  self_->place(step, step);
  return self_->conclude(self_->advance_elements(step));
}

/// From kicked nodes to v_{n+1/2} and positions at the end of the first part.
template <int dim>
void Solver<dim>::Implementation::place(const TimeStep &whole, const TimeStep &part)
{
  absorbing.apply(whole, prescribed, constraints, nodes, v_old);
  prescribed.apply(part, nodes, v_old, work);
  walls.apply(whole, prescribed, nodes, v_old, work);
  constraints.follow(nodes);
  drift(part.drift);
  absorbing.book(nodes, work);
  book_loads(whole.kick);
  show();
}

template <int dim>
StepStatus Solver<dim>::Implementation::advance_elements(const TimeStep &step)
{
  StepStatus first;
  for (auto &group : groups)
  {
    const StepStatus status = group->advance(nodes, step);
    if (!status.ok && distribution.alone())
      return status;
    if (!status.ok && first.ok) // other ranks wait for the rest of the step
      first = status;
    updates += group->size();
    skipped += group->skipped();
  }
  complete_forces();
  return first;
}

/// Who died, how long the next step may be, and whether all is sound.
template <int dim>
StepStatus Solver<dim>::Implementation::review()
{
  if (erosion.any() && erosion.kill_failed(groups, nodes))
    review_erosion();
  if (parameters.options.step_bound == "power-iteration")
    sharpen();
  return check_nodes();
}

template <int dim>
void Solver<dim>::Implementation::kick(const TimeStep &step)
{
  if (!loads.empty())
    loads.gather(nodes, constraints, step.time, load);
  fold_forces();
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int i = 0; i < dim; ++i)
    {
      const double *elements = element_forces(g, i);
      for_each_run(g, [&](std::size_t first, std::size_t last) {
        const std::size_t n    = last - first;
        const double     *mass = &nodes.mass[first];
        const double     *element = elements + (first - parts[g].first_node), *press = &load[i][first];
        double           *v = &nodes.v[i][first], *old = &v_old[i][first], *force = &nodes.force[i][first];
        for (std::size_t a = 0; a < n; ++a)
        {
          old[a] = v[a];
          v[a] += (mass[a] > 0 ? step.kick / mass[a] : 0.) * (element[a] + force[a] + press[a]); // no elements: none
          force[a] = 0;
        }
      });
    }
  for (int i = 0; i < dim && !distribution.alone(); ++i) // those of other ranks' nodes
    std::fill(nodes.force[i].begin(), nodes.force[i].end(), 0.);
}

template <int dim>
void Solver<dim>::Implementation::fold_forces()
{
  constraints.fold_forces(nodes, [this](std::uint32_t slave, double (&f)[dim]) {
    std::size_t g = 0;
    while (slave >= parts[g].last_node)
      ++g;
    for (int i = 0; i < dim; ++i)
      f[i] = element_forces(g, i)[slave - parts[g].first_node] + nodes.force[i][slave] + load[i][slave];
  });
}

template <int dim>
void Solver<dim>::Implementation::drift(double dt)
{
  for (int i = 0; i < dim; ++i)
  {
    double       *x = nodes.x[i].data(), *mean = nodes.v_mean[i].data();
    const double *v = nodes.v[i].data(), *old = v_old[i].data();
    for_each_run([=](std::size_t first, std::size_t last) {
      for (std::size_t a = first; a < last; ++a)
      {
        mean[a] = .5 * (v[a] + old[a]);
        x[a] += dt * v[a];
      }
    });
  }
}

template <int dim>
void Solver<dim>::Implementation::book_loads(double kick)
{
  if (!loads.empty())
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < nodes.size(); ++a)
      {
        if (!nodes.counts(a))
          continue;
        work.external += kick * load[i][a] * nodes.v_mean[i][a];
        work.impulse[i] += kick * load[i][a];
      }
}

template <int dim>
StepStatus Solver<dim>::Implementation::check_nodes() const
{
  double sum = 0; // one NaN or infinity among the velocities shows in the sum of 0 v
  for (int i = 0; i < dim; ++i)
    for_each_run([&, v = nodes.v[i].data()](std::size_t first, std::size_t last) {
      for (std::size_t a = first; a < last; ++a)
        sum += 0. * v[a];
    });
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
