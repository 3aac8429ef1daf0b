// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/healing.h"

namespace ogive::coupling
{
namespace
{
// The solvers number their points body by body.
template <int dim, class Body, class Count>
void move_points_of(Party party, const std::vector<Move> &moves, std::vector<Body> &bodies, const Count &count,
                    const auto &place)
{
  std::int64_t first = 0;
  for (Body &body : bodies)
  {
    const auto n = static_cast<std::int64_t>(count(body));
    for (const Move &move : moves)
      if (move.party == party && move.id >= first && move.id < first + n)
        for (int a = 0; a < dim; ++a)
          place(body, static_cast<std::size_t>(move.id - first), a) += move.by[a];
    first += n;
  }
}
} // namespace

template <int dim>
void move_points(const std::vector<Move> &moves, const input::Scene &scene,
                 std::vector<fem::BodyMesh<dim>> &meshes, std::vector<sph::BodyParticles<dim>> &clouds)
{
  move_points_of<dim>(
    mesh_party, moves, meshes, [](const auto &mesh) { return mesh.n_nodes(); },
    [](auto &mesh, std::size_t k, int a) -> double & { return mesh.x[a][k]; });
  move_points_of<dim>(
    particle_party, moves, clouds, [](const auto &cloud) { return cloud.x.size(); },
    [](auto &cloud, std::size_t k, int a) -> double & { return cloud.x[k][a]; });
  for (auto &mesh : meshes)
  {
    fem::straighten(mesh);
    fem::check_quality(mesh, scene.bodies[mesh.body].name);
  }
}

template void move_points(const std::vector<Move> &, const input::Scene &, std::vector<fem::BodyMesh<1>> &,
                          std::vector<sph::BodyParticles<1>> &);
template void move_points(const std::vector<Move> &, const input::Scene &, std::vector<fem::BodyMesh<2>> &,
                          std::vector<sph::BodyParticles<2>> &);
template void move_points(const std::vector<Move> &, const input::Scene &, std::vector<fem::BodyMesh<3>> &,
                          std::vector<sph::BodyParticles<3>> &);
} // namespace ogive::coupling
