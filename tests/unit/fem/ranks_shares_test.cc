// SPDX-License-Identifier: LGPL-2.1-or-later
// How evenly elements are shared out, and what ranks tell each other in a step. Prints a table:
// mpirun -n 4 build/release/tests/unit/fem/unit_fem_ranks --gtest_filter=RankedShares.*
#include "tests/unit/fem/twins.h"

#include <cstdio>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
template <int dim>
BodyMesh<dim> from_file(const std::string &name, input::Dimension dimension)
{
  input::Scene scene;
  scene.dimension = dimension;
  input::Body body;
  body.name            = "mesh";
  body.shape.kind      = input::ShapeKind::mesh;
  body.shape.mesh_file = std::string(OGIVE_SOURCE_DIR) + "/meshes/" + name;
  return make_mesh<dim>(body, scene, 0, make(copper()));
}

/// Cubes that a cubic share of n of them has on its surface: the least that a share must tell of.
double bound(double n, int dim)
{
  return 2 * dim * std::pow(n, (dim - 1.) / dim);
}

template <int dim>
void share(const char *name, const BodyMesh<dim> &mesh, const std::string &how)
{
  Parameters p;
  p.ranks              = Ranks::world();
  p.parallel.partition = how;
  auto         solver  = solver_with<dim>(mesh, p);
  const Ranks &ranks   = p.ranks;
  for (int k = 0; k < 2; ++k) // what starts costs more
    ASSERT_TRUE(solver->step({k * 1e-9, k == 0 ? .5e-9 : 1e-9, 1e-9}).ok);
  const Traffic before = ranks.traffic();
  constexpr int steps  = 10;
  for (int k = 2; k < 2 + steps; ++k)
    ASSERT_TRUE(solver->step({k * 1e-9, 1e-9, 1e-9}).ok);
  const Traffic after = ranks.traffic();

  const auto   s    = solver->share();
  const double n    = static_cast<double>(solver->size()) / ranks.size();
  const double most = ranks.max(s.work), mean = ranks.sum(s.work) / ranks.size();
  const double shared   = ranks.max(double(s.shared)),
               bytes    = ranks.max(double(after.bytes - before.bytes)) / steps;
  const double messages = ranks.max(double(after.messages - before.messages)) / steps;
  EXPECT_EQ(ranks.sum(static_cast<std::int64_t>(s.elements)), static_cast<std::int64_t>(solver->size()));
  // Of one kind of elements none can be divided: one more than the mean, and 2 % of cuts that
  // meet several at once.
  EXPECT_LE(most, mean * 1.02 + 1 + (dim == 1 ? 0. : std::pow(n, (dim - 1.) / dim)));
  if (ranks.first())
    std::printf(
        "%-16s %-6s ranks %d elements %6zu most/mean %.3f shared nodes %5.0f bound %5.0f neighbours %zu "
        "messages %4.1f bytes %8.0f a step\n",
        name, how.c_str(), ranks.size(), solver->size(), most / mean, shared, bound(n, dim), s.neighbours,
        messages, bytes);
}

TEST(RankedShares, EvenAndSmall)
{
  const auto square = block<2>({0, 0, 0}, {64e-3, 64e-3, 0}, 1e-3);
  const auto cube   = block<3>({0, 0, 0}, {16e-3, 16e-3, 16e-3}, 1e-3);
  for (const std::string how : {"rcb", "p4est"})
  {
    share<2>("block 64 x 64", square, how);
    share<3>("block 16^3", cube, how);
    share<2>("plate-41.msh", from_file<2>("plate-41.msh", input::Dimension::plane_strain), how);
    share<3>("target.msh", from_file<3>("target.msh", input::Dimension::three_d), how);
  }
}
} // namespace
