// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_quality.h"

#include "core/base/log.h"
#include "fem/element_group.h"
#include "fem/embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogive::fem
{
namespace
{
constexpr double worst_jacobian = .2, worst_aspect = 10;

template <int dim>
using Corners = std::array<Eigen::Matrix<double, dim, 1>, 1 << dim>;

/// Nodes of an element at its corners, VTK order.
template <int dim>
std::array<std::uint32_t, 1 << dim> corner_nodes(const BodyMesh<dim> &mesh, std::size_t e)
{
  std::array<std::uint32_t, 1 << dim> node;
  for (int a = 0; a < mesh.corners; ++a)
    if (mesh.degree == 1)
      node[a] = mesh.cells[e * mesh.corners + a];
    else
    {
      std::size_t at = 0, of = 1;
      for (int i = 0; i < dim; ++i, of *= mesh.degree + 1)
        at += corner_sign[a][i] > 0 ? of * mesh.degree : 0;
      node[a] = mesh.elements[e * of + at];
    }
  return node;
}

/// The corner at the other end of the edge from corner a along coordinate i.
template <int dim>
int neighbour(int a, int i)
{
  for (int b = 0; b < 1 << dim; ++b)
  {
    bool is = true;
    for (int k = 0; k < dim; ++k)
      is = is && (corner_sign[a][k] != corner_sign[b][k]) == (k == i);
    if (is)
      return b;
  }
  return a;
}

template <int dim>
struct Shape
{
  double jacobian = 1, shortest = std::numeric_limits<double>::infinity(), longest = 0;
};

template <int dim>
Shape<dim> shape_of(const Corners<dim> &x)
{
  Shape<dim> s;
  for (int a = 0; a < 1 << dim; ++a)
  {
    Eigen::Matrix<double, dim, dim> edges;
    double                          lengths = 1;
    for (int i = 0; i < dim; ++i)
    {
      edges.col(i)        = -corner_sign[a][i] * (x[neighbour<dim>(a, i)] - x[a]);
      const double length = edges.col(i).norm();
      lengths *= length;
      s.shortest = std::min(s.shortest, length);
      s.longest  = std::max(s.longest, length);
    }
    s.jacobian = std::min(s.jacobian, lengths > 0 ? edges.determinant() / lengths : 0.);
  }
  return s;
}

/// A mesh of one element of the given one, at nodes of its own.
template <int dim>
BodyMesh<dim> alone(const BodyMesh<dim> &mesh, std::size_t e)
{
  BodyMesh<dim> one;
  one.body               = mesh.body;
  one.material           = mesh.material;
  one.axisymmetric       = mesh.axisymmetric;
  one.element            = mesh.element;
  one.degree             = mesh.degree;
  const std::size_t each = mesh.n_cells() / mesh.n_elements() * mesh.corners;
  std::map<std::uint32_t, std::uint32_t> local;
  const auto                             node_of = [&](std::uint32_t node) {
    const auto [at, fresh] = local.try_emplace(node, static_cast<std::uint32_t>(local.size()));
    if (fresh)
      for (int i = 0; i < dim; ++i)
      {
        one.x[i].push_back(mesh.x[i][node]);
        one.v[i].push_back(0);
      }
    return at->second;
  };
  const std::size_t points = mesh.elements.size() / mesh.n_elements();
  for (std::size_t k = 0; k < points; ++k)
    one.elements.push_back(node_of(mesh.elements[e * points + k]));
  for (std::size_t k = 0; k < each; ++k)
    one.cells.push_back(node_of(mesh.cells[e * each + k]));
  return one;
}

template <int dim>
double step_of(const BodyMesh<dim> &mesh, std::size_t e, const input::FemOptions &options)
{
  const BodyMesh<dim> one   = alone(mesh, e);
  const auto          group = make_element_group<dim>(one, {}, options);
  Nodes<dim>          nodes;
  nodes.resize(one.n_nodes());
  for (int i = 0; i < dim; ++i)
  {
    std::copy(one.x[i].begin(), one.x[i].end(), nodes.x[i].begin());
    nodes.x0[i] = nodes.x[i];
  }
  group->lump_mass(nodes);
  group->initialise(nodes);
  return group->stable_dt().dt;
}

void warn(MeshQuality &q)
{
  const auto place = [](const MeshQuality::Worst &w) {
    return w.number < 0 ? "element " + std::to_string(w.element) : "element " + std::to_string(w.number) + " of the file";
  };
  if (q.jacobian.value < worst_jacobian)
    q.warnings.push_back("the least scaled Jacobian is " + engineering(q.jacobian.value) + " (" + place(q.jacobian) +
                         "), below " + engineering(worst_jacobian) + ": a corner is nearly flat");
  if (q.aspect.value > worst_aspect)
    q.warnings.push_back("the largest aspect ratio is " + engineering(q.aspect.value) + " (" + place(q.aspect) +
                         "), above " + engineering(worst_aspect));
}
} // namespace

template <int dim>
MeshQuality measure_quality(const BodyMesh<dim> &mesh, const std::string &body, const input::FemOptions &options)
{
  MeshQuality q;
  q.body     = body;
  q.elements = mesh.n_elements();
  q.nodes    = mesh.n_nodes();
  q.notes    = mesh.notes;
  q.shortest = q.jacobian.value = q.step.value = std::numeric_limits<double>::infinity();
  std::vector<double> steps;
  for (std::size_t e = 0; e < q.elements; ++e)
  {
    Corners<dim> x;
    Vec3         middle = Vec3::Zero();
    const auto   node   = corner_nodes(mesh, e);
    for (int a = 0; a < mesh.corners; ++a)
      for (int i = 0; i < dim; ++i)
      {
        x[a][i] = mesh.x[i][node[a]];
        middle[i] += x[a][i] / mesh.corners;
      }
    const auto worst = [&](double value) {
      return MeshQuality::Worst{value, e, mesh.file_numbers.empty() ? -1 : mesh.file_numbers[e], middle};
    };
    const Shape<dim> s = shape_of<dim>(x);
    q.shortest         = std::min(q.shortest, s.shortest);
    q.longest          = std::max(q.longest, s.longest);
    if (s.jacobian < q.jacobian.value)
      q.jacobian = worst(s.jacobian);
    if (s.longest > q.aspect.value * s.shortest)
      q.aspect = worst(s.longest / s.shortest);
    steps.push_back(step_of(mesh, e, options));
    if (steps.back() < q.step.value)
      q.step = worst(steps.back());
  }
  std::sort(steps.begin(), steps.end());
  const auto quantile = [&](double share) {
    return steps[static_cast<std::size_t>(std::max(std::ceil(share * steps.size()), 1.)) - 1];
  };
  q.step_twentieth = quantile(.05);
  q.step_median    = quantile(.5);
  q.share_near     = static_cast<double>(std::upper_bound(steps.begin(), steps.end(), 2 * q.step.value) - steps.begin()) /
                 static_cast<double>(steps.size());
  for (const auto &facet : mesh.facets)
    ++q.faces[mesh.boundary_names[facet.boundary]];
  warn(q);
  return q;
}

template MeshQuality measure_quality<1>(const BodyMesh<1> &, const std::string &, const input::FemOptions &);
template MeshQuality measure_quality<2>(const BodyMesh<2> &, const std::string &, const input::FemOptions &);
template MeshQuality measure_quality<3>(const BodyMesh<3> &, const std::string &, const input::FemOptions &);
} // namespace ogive::fem
