// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ogive::sph
{
namespace
{
// The smallest eigenvalue of the moment matrix is 1 inside and falls near a
// free surface; with h = 1.3 spacings the second layer still shows.
constexpr double inside = .97;
// A particle is in the outermost layer if none of its body lies within this
// cosine of its normal, closer than two spacings; concave edges, at 45
// degrees, still count.
constexpr double ahead = .75;
// Spread of the outermost particles around across their plane over their least
// spread within it, at which a surface counts as smooth and as an edge (.58 at
// a right one, .23 at a bend of 45 degrees).
constexpr double smooth = .2, edge = .4;
} // namespace

template <int dim>
auto Solver<dim>::Implementation::outward(std::size_t i) const -> Vector
{
  const Eigen::Map<const Vector> inward(&gradient_sums[i * L::gradient_stride + L::normal_sum]);
  const double                   length = inward.norm();
  return length > 0 ? Vector(-inward / length) : Vector(Vector::Zero());
}

template <int dim>
void Solver<dim>::Implementation::find_surface()
{
  for (std::size_t i = 0; i < store.size(); ++i)
  {
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(moment(i), Eigen::EigenvaluesOnly);
    near_surface[i] = !(solver.eigenvalues()[0] > inside) || store.points.damage[i] > 0;
  }
  list_contact_points();
  measure_flatness();
  surface_stale = false;
  ++topology;
}

template <int dim>
void Solver<dim>::Implementation::list_contact_points()
{
  contact_points.clear();
  for (std::size_t i = 0; i < store.size(); ++i)
    if (near_surface[i])
      contact_points.push_back(static_cast<std::uint32_t>(i));
}

template <int dim>
void Solver<dim>::Implementation::measure_flatness()
{
  const std::size_t n = store.size();
  const auto        at = [&](std::size_t record) {
    return Eigen::Map<const Vector>(&force_records[record * L::force_stride + L::x]);
  };
  // Visits the neighbours of i closer than `reach` spacings, images included.
  const auto around = [&](std::size_t i, double reach, auto &&visit) {
    const double spacing = std::pow(store.mass[i] / store.points.density[i], 1. / dim);
    for (std::size_t p = pairs.rows.row[i]; p < pairs.rows.row[i + 1]; ++p)
    {
      const std::size_t j = pairs.rows.index[p];
      if (j >= n + ghosts.size())
        continue;
      const Vector line = at(j) - at(i);
      if (line.squaredNorm() < reach * reach * spacing * spacing)
        visit(j, line);
    }
  };
  std::vector<char> outermost(n, 0);
  for (const std::uint32_t i : contact_points)
  {
    const Vector normal = outward(i);
    bool         clear  = !normal.isZero() && store.points.damage[i] < 1;
    around(i, 2, [&](std::size_t, const Vector &line) { clear &= !(normal.dot(line) > ahead * line.norm()); });
    outermost[i] = clear;
  }
  store.flatness.assign(n, 0.);
  for (auto &component : store.tilt)
    component.assign(n, 0.);
  for (const std::uint32_t i : contact_points)
  {
    if (!outermost[i])
      continue;
    Vector sum   = Vector::Zero();
    Matrix outer = Matrix::Zero();
    int    count = 1;
    around(i, 1.5, [&](std::size_t j, const Vector &line) {
      if (!outermost[j < n ? j : ghosts.parent[j - n]])
        return;
      sum += line;
      outer += line * line.transpose();
      ++count;
    });
    // A plane needs points on all sides of its own.
    if (count < 2 * dim - 1)
      continue;
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(outer - sum * sum.transpose() / count);
    const auto  &spread = solver.eigenvalues();
    const double within = dim > 1 ? std::sqrt(std::max(0., spread[0]) / spread[dim > 1]) : 0;
    Vector       normal = solver.eigenvectors().col(0);
    normal *= normal.dot(outward(i)) < 0 ? -1 : 1;
    store.flatness[i] = std::clamp((edge - within) / (edge - smooth), 0., 1.);
    for (int a = 0; a < dim; ++a)
      store.tilt[a][i] = normal[a] - outward(i)[a];
  }
}

template <int dim>
void Solver<dim>::Implementation::point_normals()
{
  for (auto &component : normal)
    component.assign(store.size(), 0.);
  for (const std::uint32_t i : contact_points)
    if (store.flatness[i] > 0)
    {
      Vector n = outward(i);
      for (int a = 0; a < dim; ++a)
        n[a] += store.tilt[a][i];
      n *= store.flatness[i] / n.norm();
      for (int a = 0; a < dim; ++a)
        normal[a][i] = n[a];
    }
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template Solver<d>::Implementation::Vector Solver<d>::Implementation::outward(std::size_t) const;          \
  template void                              Solver<d>::Implementation::find_surface();                      \
  template void                              Solver<d>::Implementation::list_contact_points();               \
  template void                              Solver<d>::Implementation::point_normals();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
