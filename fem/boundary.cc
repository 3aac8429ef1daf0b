// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/boundary.h"

#include "core/base/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Calls f(facet) for the facets of a scene boundary.
template <int dim, class F>
void for_each_facet(const input::Boundary &boundary, const BodyMesh<dim> &mesh, F &&f)
{
  bool found = false;
  for (const auto &facet : mesh.facets)
    if (mesh.is_called(facet.boundary, boundary.face))
    {
      found = true;
      f(facet);
    }
  if (!found)
  {
    std::string names;
    for (const auto &name : mesh.boundary_names)
      names += (names.empty() ? "" : ", ") + name;
    throw InputError({"", 0, boundary.name}, "the body has no face \"" + boundary.face + "\"",
                     "one of: all, " + names);
  }
}
} // namespace

template <int dim>
PrescribedMotion<dim>::PrescribedMotion(const Parameters &p, const std::vector<BodyMesh<dim>> &meshes,
                                        const std::vector<std::size_t> &first_node)
{
  std::size_t n = 0;
  for (const auto &mesh : meshes)
    n += mesh.n_nodes();
  mask_.assign(n, 0);
  entry_of_.assign(n, -1);
  for (std::size_t b = 0; b < p.boundaries.size(); ++b)
  {
    const input::Boundary &boundary = p.boundaries[b];
    if (boundary.kind == input::BoundaryKind::pressure)
      continue;
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (meshes[m].body == p.boundary_bodies.at(b))
        for_each_facet(boundary, meshes[m], [&](const auto &facet) {
          for (const std::uint32_t node : facet.node)
            for (int i = 0; i < dim; ++i)
              if (boundary.fix[i])
                set(static_cast<std::uint32_t>(first_node[m] + node), i,
                    boundary.kind == input::BoundaryKind::fixed ? 0. : boundary.velocity[i]);
        });
  }
  for (std::size_t m = 0; m < meshes.size(); ++m)
  {
    const double tolerance = 1e-9 * extent(meshes[m]);
    const auto   hold      = [&](int axis) {
      for (std::size_t a = 0; a < meshes[m].n_nodes(); ++a)
        if (std::abs(meshes[m].x[axis][a]) <= tolerance)
          set(static_cast<std::uint32_t>(first_node[m] + a), axis, 0.);
    };
    for (const auto &plane : p.symmetry)
      if (plane.axis < dim)
        hold(plane.axis);
    if (meshes[m].axisymmetric)
      hold(0);
  }
}

template <int dim>
void PrescribedMotion<dim>::set(std::uint32_t node, int component, double velocity)
{
  if (entry_of_[node] < 0)
  {
    entry_of_[node] = static_cast<std::int64_t>(entries_.size());
    entries_.push_back({node, {}});
  }
  mask_[node] |= static_cast<unsigned char>(1 << component);
  entries_[entry_of_[node]].velocity[component] = velocity;
}

template <int dim>
void PrescribedMotion<dim>::start(Nodes<dim> &nodes) const
{
  for (const Entry &entry : entries_)
    for (int i = 0; i < dim; ++i)
      if (prescribed(entry.node, i))
        nodes.v[i][entry.node] = entry.velocity[i];
}

template <int dim>
void PrescribedMotion<dim>::apply(Nodes<dim> &nodes, const std::array<AlignedVector<double>, dim> &v_old,
                                  BoundaryWork &work) const
{
  for (const Entry &entry : entries_)
    for (int i = 0; i < dim; ++i)
      if (prescribed(entry.node, i))
      {
        double      &v       = nodes.v[i][entry.node];
        const double impulse = nodes.mass[entry.node] * (entry.velocity[i] - v);
        v                    = entry.velocity[i];
        work.external += impulse * .5 * (v + v_old[i][entry.node]);
        work.impulse[i] += impulse;
      }
}

template <int dim>
Pressures<dim>::Pressures(const Parameters &p, const std::vector<BodyMesh<dim>> &meshes,
                          const std::vector<std::size_t> &first_node)
{
  for (std::size_t b = 0; b < p.boundaries.size(); ++b)
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (p.boundaries[b].kind == input::BoundaryKind::pressure &&
          meshes[m].body == p.boundary_bodies.at(b))
        for_each_facet(p.boundaries[b], meshes[m], [&](auto facet) {
          for (auto &node : facet.node)
            node += static_cast<std::uint32_t>(first_node[m]);
          loads_.push_back({facet, p.boundaries[b].pressure});
          axisymmetric_ = meshes[m].axisymmetric;
        });
}

template <int dim>
void Pressures<dim>::add(const Nodes<dim> &nodes, std::array<AlignedVector<double>, dim> &force) const
{
  for (const Load &load : loads_)
  {
    const auto &node = load.facet.node;
    const auto  x    = [&](int a, int i) { return nodes.x[i][node[a]]; };
    if constexpr (dim == 1)
      force[0][node[0]] -= load.pressure * load.facet.outward;
    else if constexpr (dim == 2)
    {
      // Outside is on the right of a -> b: n = (dy, -dx).
      const double n[2] = {x(1, 1) - x(0, 1), x(0, 0) - x(1, 0)};
      for (int a = 0; a < 2; ++a)
      {
        const double share = axisymmetric_
                               ? std::numbers::pi / 3 * (2 * x(a, 0) + x(1 - a, 0)) // int N_a 2 pi r
                               : .5;
        for (int i = 0; i < 2; ++i)
          force[i][node[a]] -= load.pressure * share * n[i];
      }
    }
    else
    {
      Vec3 d1, d2;
      for (int i = 0; i < 3; ++i)
      {
        d1[i] = x(2, i) - x(0, i);
        d2[i] = x(3, i) - x(1, i);
      }
      const Vec3 quarter = .125 * load.pressure * d1.cross(d2); // a quarter of p A n
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < 4; ++a)
          force[i][node[a]] -= quarter[i];
    }
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
                            const std::array<AlignedVector<double>, dim> &v_old, BoundaryWork &work)
{
  touches_.clear();
  for (std::size_t w = 0; w < walls_.size(); ++w)
  {
    force_[w] = 0;
    for (const std::uint32_t node : nodes_)
      if (Touch t; touch(w, node, step, prescribed, nodes, t))
      {
        touches_.push_back(t);
        for (int i = 0; i < dim; ++i)
          force_[w] += t.normal[i] * walls_[w].normal[i] / step.kick;
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
template class Pressures<1>;
template class Pressures<2>;
template class Pressures<3>;
template class RigidWalls<1>;
template class RigidWalls<2>;
template class RigidWalls<3>;
} // namespace ogive::fem
