// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <Eigen/Dense>

namespace ogive::sph
{
namespace
{
// The smallest eigenvalue of the moment matrix is 1 inside and falls near a
// free surface; with h = 1.3 spacings the second layer still shows.
constexpr double inside = .97;
} // namespace

template <int dim>
void Solver<dim>::Implementation::find_surface()
{
  for (std::size_t i = 0; i < n_own(); ++i)
  {
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(moment(i), Eigen::EigenvaluesOnly);
    near_surface[i] = !(solver.eigenvalues()[0] > inside) || store.points.damage[i] > 0;
  }
  list_contact_points();
  surface_stale = false;
  ++topology;
}

template <int dim>
void Solver<dim>::Implementation::list_contact_points()
{
  contact_points.clear();
  for (std::size_t i = 0; i < n_own(); ++i)
    if (near_surface[i])
      contact_points.push_back(static_cast<std::uint32_t>(i));
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::find_surface();                                                   \
  template void Solver<d>::Implementation::list_contact_points();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
