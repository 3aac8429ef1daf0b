// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/boundary.h"

#include "core/base/error.h"
#include "fem/boundary_facets.h"

#include <algorithm>
#include <cmath>

namespace ogive::fem
{
namespace
{
template <int dim>
double extent(const BodyMesh<dim> &mesh)
{
  double size = 0;
  for (int i = 0; i < dim; ++i)
  {
    const auto [low, high] = std::minmax_element(mesh.x[i].begin(), mesh.x[i].end());
    size                   = std::max(size, *high - *low);
  }
  return size;
}

} // namespace

template <int dim>
PrescribedMotion<dim>::PrescribedMotion(const Parameters &p, const std::vector<BodyMesh<dim>> &meshes,
                                        const std::vector<std::size_t> &first_node,
                                        const Constraints<dim> &constraints)
  : boundaries_(p.boundaries)
{
  std::size_t n = 0;
  for (const auto &mesh : meshes)
    n += mesh.n_nodes();
  mask_.assign(n, 0);
  entry_of_.assign(n, -1);
  for (std::size_t b = 0; b < p.boundaries.size(); ++b)
  {
    const input::Boundary &boundary = p.boundaries[b];
    if (!boundary.prescribes_motion())
      continue;
    const Vec3 amount = boundary.kind == input::BoundaryKind::displacement ? boundary.displacement : boundary.velocity;
    const int  name   = boundary.kind == input::BoundaryKind::fixed ? held : static_cast<int>(b);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (meshes[m].body == p.boundary_bodies.at(b))
        for_each_facet(boundary, meshes[m], constraints, m, [&](const auto &facet) {
          for (const std::uint32_t node : facet.node)
            for (int i = 0; i < dim; ++i)
              if (boundary.fix[i] && !constraints.is_slave(first_node[m] + node))
                set(static_cast<std::uint32_t>(first_node[m] + node), i, name, amount[i]);
        });
  }
  for (std::size_t m = 0; m < meshes.size(); ++m)
    hold_planes(p, meshes[m], first_node[m], constraints);
}

template <int dim>
void PrescribedMotion<dim>::hold_planes(const Parameters &p, const BodyMesh<dim> &mesh, std::size_t first_node,
                                        const Constraints<dim> &constraints)
{
  const double tolerance = 1e-9 * extent(mesh);
  const auto   hold      = [&](int axis) {
    for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
      if (std::abs(mesh.x[axis][a]) <= tolerance && !constraints.is_slave(first_node + a))
        set(static_cast<std::uint32_t>(first_node + a), axis, held, 0.);
  };
  for (const auto &plane : p.symmetry)
    if (plane.axis < dim)
      hold(plane.axis);
  if (mesh.axisymmetric)
    hold(0);
}

template <int dim>
void PrescribedMotion<dim>::set(std::uint32_t node, int component, int boundary, double amount)
{
  if (entry_of_[node] < 0)
  {
    entry_of_[node] = static_cast<std::int64_t>(entries_.size());
    entries_.push_back({node, {}, {}});
  }
  mask_[node] |= static_cast<unsigned char>(1 << component);
  entries_[entry_of_[node]].amount[component]   = amount;
  entries_[entry_of_[node]].boundary[component] = boundary;
}

template <int dim>
void PrescribedMotion<dim>::start(Nodes<dim> &nodes) const
{
  for (const Entry &entry : entries_)
    for (int i = 0; i < dim; ++i)
      if (prescribed(entry.node, i))
      {
        const int b = entry.boundary[i];
        const bool driven = b != held && boundaries_[b].kind == input::BoundaryKind::velocity;
        nodes.v[i][entry.node] = driven ? entry.amount[i] * boundaries_[b].history.at(0) : 0.;
      }
}

template <int dim>
void PrescribedMotion<dim>::apply(const TimeStep &step, Nodes<dim> &nodes,
                                  const std::array<AlignedVector<double>, dim> &v_old, BoundaryWork &work,
                                  const Turn *turn) const
{
  std::vector<double> factor;
  for (const input::Boundary &b : boundaries_)
    factor.push_back(
      b.history.at(step.time + (b.kind == input::BoundaryKind::displacement ? 1 : .5) * step.drift));
  for (const Entry &entry : entries_)
    for (int i = 0; i < dim; ++i)
      if (prescribed(entry.node, i) && (!turn || turn->takes(entry.node)))
      {
        const std::uint32_t a = entry.node;
        if (!nodes.keeps(a))
          continue;
        const int           b = entry.boundary[i];
        double              v = b == held ? 0. : entry.amount[i] * factor[b];
        if (b != held && boundaries_[b].kind == input::BoundaryKind::displacement)
          v = (nodes.x0[i][a] + v - nodes.x[i][a]) / step.drift;
        const double impulse = nodes.mass[a] * (v - nodes.v[i][a]);
        nodes.v[i][a]        = v;
        if (!nodes.counts(a))
          continue;
        work.external += impulse * .5 * (v + v_old[i][a]);
        work.impulse[i] += impulse;
      }
}

template <int dim>
RigidWalls<dim>::RigidWalls(const Parameters &p, std::vector<std::uint32_t> nodes)
  : walls_(p.walls)
  , nodes_(std::move(nodes))
{
  force_.resize(walls_.size(), 0.);
  for (auto &wall : walls_)
  {
    for (int i = dim; i < 3; ++i)
      if (std::abs(wall.normal[i]) > 1e-12)
        throw InputError({"", 0, wall.name}, "the wall's normal leaves the space of the scene");
    wall.normal.normalize();
  }
}

template <int dim>
void RigidWalls<dim>::apply(const TimeStep &step, const PrescribedMotion<dim> &prescribed, Nodes<dim> &nodes,
                            const std::array<AlignedVector<double>, dim> &v_old, BoundaryWork &work, const Turn *turn)
{
  touches_.clear();
  for (std::size_t w = 0; w < walls_.size(); ++w)
  {
    if (!turn || turn->first)
      force_[w] = 0;
    for (const std::uint32_t node : nodes_)
      if (Touch t; nodes.keeps(node) && (!turn || turn->takes(node)) && touch(w, node, step, prescribed, nodes, t) &&
          nodes.counts(node))
      {
        touches_.push_back(t);
        for (int i = 0; i < dim; ++i)
          force_[w] += t.normal[i] * walls_[w].normal[i] / (turn ? turn->whole_kick : step.kick);
      }
  }
  // Booked when all walls have had their say: work is impulse times the mean of
  // the old and the final velocity.
  for (const Touch &t : touches_)
    for (int i = 0; i < dim; ++i)
    {
      const double wall = walls_[t.wall].velocity[i];
      const double slip = .5 * (nodes.v[i][t.node] + v_old[i][t.node]) - wall;
      work.external += (t.normal[i] + t.friction[i]) * wall;
      work.wall_loss -= t.normal[i] * slip;
      work.friction -= t.friction[i] * slip;
      work.impulse[i] += t.normal[i] + t.friction[i];
    }
}

template <int dim>
bool RigidWalls<dim>::touch(std::size_t w, std::uint32_t node, const TimeStep &step,
                            const PrescribedMotion<dim> &prescribed, Nodes<dim> &nodes, Touch &touch) const
{
  const input::RigidWall &wall = walls_[w];
  double                  gap  = 0; // where the node would be at t_{n+1}
  const double            time = step.time + step.drift;
  if (!(nodes.mass[node] > 0)) // its elements are dead
    return false;
  for (int i = 0; i < dim; ++i)
    gap += wall.normal[i] * (nodes.x[i][node] + step.drift * nodes.v[i][node] -
                             (wall.point[i] + wall.velocity[i] * time));
  if (gap >= 0)
    return false;
  double free[dim], reach = 0; // prescribed components do not yield to the wall
  for (int i = 0; i < dim; ++i)
  {
    free[i] = prescribed.prescribed(node, i) ? 0. : wall.normal[i];
    reach += free[i] * wall.normal[i];
  }
  if (reach < 1e-12)
    return false;
  touch             = {node, w, {}, {}};
  const double mass = nodes.mass[node], push = -mass * gap / (step.drift * reach);
  double       along = 0, slip[dim], slip_speed = 0;
  for (int i = 0; i < dim; ++i)
  {
    touch.normal[i] = push * free[i];
    nodes.v[i][node] += touch.normal[i] / mass;
    along += wall.normal[i] * (nodes.v[i][node] - wall.velocity[i]);
  }
  for (int i = 0; i < dim; ++i)
  {
    slip[i] = prescribed.prescribed(node, i) ? 0. : nodes.v[i][node] - wall.velocity[i] - along * wall.normal[i];
    slip_speed += slip[i] * slip[i];
  }
  slip_speed = std::sqrt(slip_speed);
  if (wall.friction > 0 && slip_speed > 0)
    for (int i = 0; i < dim; ++i)
    {
      touch.friction[i] = -std::min(wall.friction * push / slip_speed, mass) * slip[i];
      nodes.v[i][node] += touch.friction[i] / mass;
    }
  return true;
}

template class PrescribedMotion<1>;
template class PrescribedMotion<2>;
template class PrescribedMotion<3>;
template class RigidWalls<1>;
template class RigidWalls<2>;
template class RigidWalls<3>;
} // namespace ogive::fem
