// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tests/unit/fem/support.h"

#include <random>
#include <vector>

/// Blocks with boundaries for the tests of what acts at the edges.
namespace ogive::fem::test
{
inline input::Dimension dimension_of(int dim, bool axisymmetric)
{
  return axisymmetric ? input::Dimension::axisymmetric
         : dim == 1   ? input::Dimension::uniaxial
         : dim == 2   ? input::Dimension::plane_strain
                      : input::Dimension::three_d;
}

/// Nodes moved by up to `distortion` m (those on the axis or of `keep` not), and
/// set in random motion of up to `speed` m/s.
template <int dim>
void shake(
    BodyMesh<dim> &mesh, double distortion, double speed,
    const std::function<bool(std::size_t)> &keep = [](std::size_t) { return false; })
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    for (int i = 0; i < dim; ++i)
    {
      const double shift = distortion * u(random);
      mesh.v[i][a] += speed * u(random);
      if (!keep(a) && !(mesh.axisymmetric && mesh.x[0][a] == 0 && i == 0))
        mesh.x[i][a] += shift;
    }
}

template <int dim>
BodyMesh<dim> block(const Vec3 &lower, const Vec3 &upper, double h, bool axisymmetric = false, int body = 0,
                    const materials::Parameters &p = copper())
{
  input::Scene scene;
  scene.dimension = dimension_of(dim, axisymmetric);
  return make_mesh<dim>(box(lower, upper, h), scene, body, make(p));
}

inline input::Boundary boundary(const std::string &face, input::BoundaryKind kind)
{
  input::Boundary b;
  b.name = b.face = face;
  b.kind          = kind;
  return b;
}

/// A solver of bodies 0, 1, ...; the boundaries act on body 0.
template <int dim>
std::unique_ptr<Solver<dim>> solver_with(std::vector<BodyMesh<dim>> meshes, Parameters p = {})
{
  p.axisymmetric = meshes.front().axisymmetric;
  p.boundary_bodies.resize(p.boundaries.size(), 0);
  return std::make_unique<Solver<dim>>(p, std::move(meshes));
}

template <int dim>
std::unique_ptr<Solver<dim>> solver_with(BodyMesh<dim> mesh, Parameters p = {})
{
  std::vector<BodyMesh<dim>> meshes;
  meshes.push_back(std::move(mesh));
  return solver_with<dim>(std::move(meshes), std::move(p));
}

/// Largest |closed - first| and |momentum - impulse - first| over some steps.
struct Books
{
  double energy = 0, momentum = 0;
};
template <int dim>
Books books_over(Solver<dim> &solver, int steps, double fixed_dt = 0)
{
  Driver<dim>   driver{solver};
  const Balance b0 = solver.balance();
  Books         worst;
  driver.fixed_dt = fixed_dt;
  for (int k = 0; k < steps; ++k)
  {
    const StepStatus status = driver.once();
    if (!status.ok)
      return {1e300, 1e300};
    const Balance b = solver.balance();
    worst.energy    = std::max(worst.energy, std::abs(closed(b) - closed(b0)));
    worst.momentum  = std::max(worst.momentum,
                               (b.momentum - b.external_impulse - b0.momentum + b0.external_impulse).norm());
  }
  return worst;
}
} // namespace ogive::fem::test
