// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface_pair_flux.h"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <algorithm>
#include <map>
#include <numbers>

/// The areas that go along the edges of a seam.
namespace ogive::coupling
{
namespace
{
/// Integrals of the shape functions times the outward normal over a facet, of
/// the whole ring in axial symmetry.
template <int dim>
std::array<Point<dim>, Surface<dim>::Facet::n_nodes> nodal_areas(const Faces<dim>                    &faces,
                                                                 const typename Surface<dim>::Facet &facet,
                                                                 bool                                axisymmetric)
{
  std::array<Point<dim>, Surface<dim>::Facet::n_nodes> share;
  const auto corner = [&](int k) { return faces.position(mesh_party, facet.node[k]); };
  if constexpr (dim == 1)
    share[0] = Point<1>(facet.outward);
  else if constexpr (dim == 2)
  {
    const Point<2> along = corner(1) - corner(0), normal(along[1], -along[0]);
    const double   r[2]  = {corner(0)[0], corner(1)[0]};
    for (int k = 0; k < 2; ++k)
      share[k] = axisymmetric ? Point<2>(normal * std::numbers::pi * (2 * r[k] + r[1 - k]) / 3.) : Point<2>(.5 * normal);
  }
  else
  {
    // Two-point Gauss rule each way: exact for the bilinear map.
    const double g = 1 / std::sqrt(3.);
    for (auto &s : share)
      s.setZero();
    static constexpr double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const double xi : {-g, g})
      for (const double eta : {-g, g})
      {
        Point<3> a = Point<3>::Zero(), b = Point<3>::Zero();
        for (int k = 0; k < 4; ++k)
        {
          a += .25 * sign[k][0] * (1 + sign[k][1] * eta) * corner(k);
          b += .25 * sign[k][1] * (1 + sign[k][0] * xi) * corner(k);
        }
        for (int k = 0; k < 4; ++k)
          share[k] += .25 * (1 + sign[k][0] * xi) * (1 + sign[k][1] * eta) * a.cross(b);
      }
  }
  return share;
}
/// Nodes where the seam ends, but not those where a plane of symmetry cuts it.
template <int dim>
std::vector<std::uint32_t> rim_nodes(const Faces<dim> &faces, const std::vector<typename Surface<dim>::Facet> &seam,
                                     const std::vector<int> &symmetry_axes)
{
  using Ends = std::array<std::uint32_t, 2>;
  std::map<Ends, int> met; // ends of facets: edges in space, nodes in a plane
  for (const auto &facet : seam)
    for (std::size_t k = 0; k < facet.node.size(); ++k)
    {
      Ends ends{facet.node[k], dim == 3 ? facet.node[(k + 1) % facet.node.size()] : facet.node[k]};
      std::sort(ends.begin(), ends.end());
      ++met[ends];
    }
  std::vector<std::uint32_t> nodes;
  for (const auto &[ends, times] : met)
  {
    const Point<dim> a = faces.position(mesh_party, ends[0]), b = faces.position(mesh_party, ends[1]);
    const double     size = (b - a).norm() + facet_size(faces[mesh_party], seam.front());
    const bool       cut  = std::any_of(symmetry_axes.begin(), symmetry_axes.end(), [&](int axis) {
      return std::max(std::abs(a[axis]), std::abs(b[axis])) < 1e-9 * size;
    });
    if (times == 1 && !cut)
      nodes.insert(nodes.end(), ends.begin(), ends.end());
  }
  return nodes;
}
} // namespace

template <int dim>
void PairFluxInterface<dim>::balance_areas(const Faces<dim> &faces)
{
  edges_.clear();
  // At the corners of a seam that conversion leaves behind it drives light nodes
  // unstable (plate-weldox-blunt/auto.prm turned elements inside out).
  if (dim == 1 || seam_.empty() || spec_.per_edge > 0)
    return;
  std::map<std::uint32_t, Point<dim>> lack; // of area, by node
  const auto                          add = [&](std::uint32_t node, const Point<dim> &area) {
    lack.try_emplace(node, Point<dim>(Point<dim>::Zero())).first->second += area;
  };
  using Ends = std::array<std::uint32_t, 2>;
  std::map<Ends, Edge> edges;
  for (const auto &facet : seam_)
  {
    const auto share = nodal_areas<dim>(faces, facet, spec_.axisymmetric);
    for (int k = 0; k < n_nodes; ++k)
    {
      add(facet.node[k], share[k]);
      Ends ends{facet.node[k], facet.node[(k + 1) % n_nodes]};
      if (dim == 2 && k == 1)
        continue;
      std::sort(ends.begin(), ends.end());
      const auto [at, is_new] = edges.try_emplace(ends);
      at->second.node         = ends;
      at->second.element[1]   = facet.element;
      if (is_new)
        at->second.element[0] = facet.element;
    }
  }
  std::array<std::vector<double>, dim> sums;
  std::array<std::span<double>, dim>   view;
  for (int a = 0; a < dim; ++a)
  {
    sums[a].assign(faces[particle_party].n, 0.);
    view[a] = sums[a];
  }
  particles_.seam_normals(spec_.particles, view);
  for (const auto &foot : feet_)
    for (int k = 0; k < n_nodes; ++k)
      for (int a = 0; a < dim; ++a)
        lack.at(foot.node[k])[a] += foot.weight[k] * sums[a][faces.particle_index[foot.id]];

  std::map<std::uint32_t, int> number;
  for (const auto &[node, area] : lack)
    number.emplace(node, static_cast<int>(number.size()));
  // Next to a free surface particles see less of the seam: its rim keeps what
  // cannot be balanced, the nodes within are exact.
  std::vector<bool> rim(number.size(), false);
  for (const std::uint32_t node : rim_nodes<dim>(faces, seam_, spec_.symmetry_axes))
    rim[static_cast<std::size_t>(number.at(node))] = true;
  const bool closed = std::find(rim.begin(), rim.end(), true) == rim.end();
  const auto                          n = static_cast<Eigen::Index>(number.size());
  Eigen::MatrixXd                     right(n, dim);
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto &[node, area] : lack)
    right.row(number.at(node)) = area.transpose();
  if (closed) // only differences matter
    right.rowwise() -= right.colwise().mean().eval();
  for (Eigen::Index i = 0; i < n; ++i)
    if (rim[static_cast<std::size_t>(i)])
    {
      right.row(i).setZero();
      entries.emplace_back(i, i, 1.);
    }
  for (const auto &[ends, edge] : edges)
  {
    const int i = number.at(ends[0]), j = number.at(ends[1]);
    const bool fixed[2] = {rim[static_cast<std::size_t>(i)], rim[static_cast<std::size_t>(j)]};
    if (!fixed[0])
      entries.emplace_back(i, i, 1.);
    if (!fixed[1])
      entries.emplace_back(j, j, 1.);
    if (!fixed[0] && !fixed[1])
      entries.insert(entries.end(), {{i, j, -1.}, {j, i, -1.}});
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-14);
  solver.setMaxIterations(10 * n + 100);
  solver.compute(laplacian);
  const Eigen::MatrixXd potential = solver.solve(right);
  if (!potential.allFinite())
    return;
  for (auto &[ends, edge] : edges)
  {
    edge.area = (potential.row(number.at(ends[0])) - potential.row(number.at(ends[1]))).transpose();
    edges_.push_back(edge);
  }
}

template void PairFluxInterface<1>::balance_areas(const Faces<1> &);
template void PairFluxInterface<2>::balance_areas(const Faces<2> &);
template void PairFluxInterface<3>::balance_areas(const Faces<3> &);
} // namespace ogive::coupling
