// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/verification/coupling/support.h"

#include <cmath>

namespace ogive::coupling
{
namespace
{
using input::Method;

/// A block falls on a free slab and slides along it; steel that stays elastic,
/// so nothing ploughs and the impulses are those of Coulomb's law.
struct Slide
{
  double ratio = 0; ///< tangential over normal impulse on the slab
  double drift = 0, momentum = 0;
};

template <int dim>
Slide slide(Method slab, Method block, double friction, double spacing, double time)
{
  auto       scene = scenes::steel_scene(dim == 2 ? input::Dimension::plane_strain : input::Dimension::three_d);
  const Vec3 velocity = dim == 2 ? Vec3(200, -30, 0) : Vec3(200, 0, -30);
  const auto at       = [](double x, double y, double up) { return dim == 2 ? Vec3(x, up, 0) : Vec3(x, y, up); };
  scenes::add_box(scene, "slab", slab, at(-20e-3, -6e-3, 0), at(20e-3, 6e-3, 8e-3), spacing, Vec3::Zero());
  scenes::add_box(scene, "block", block, at(-15.3e-3, -2.7e-3, 8.2e-3), at(-7.3e-3, 3.3e-3, 14.2e-3), spacing,
                  velocity);
  scene.contacts.push_back({"touch", "slab", "block", friction, .1});
  scenes::Driver<dim> run(scene);
  Ledger      ledger;
  auto        row = run.model.ledger();
  ledger.enter(row);
  const Vec3 before = row.momentum;
  while (run.time < time)
    run.step();
  row = run.model.ledger();
  ledger.enter(row);
  const auto sample  = run.model.sample(0);
  Vec3       impulse = Vec3::Zero();
  for (std::size_t i = 0; i < sample.mass.size(); ++i)
    for (int a = 0; a < dim; ++a)
      impulse[a] += sample.mass[i] * sample.v[a][i];
  return {-impulse[0] / impulse[dim - 1], ledger.worst_drift(), (row.momentum - before).norm() / before.norm()};
}

/// For .2 of Coulomb's law in 40 us, during which the block falls, slides by
/// its own length and leaves.
template <int dim>
void expect_coulomb(Method slab, Method block, double spacing, double bound)
{
  for (const double friction : {0., .2})
  {
    const Slide found = slide<dim>(slab, block, friction, spacing, 40e-6);
    EXPECT_NEAR(found.ratio, friction, .2 * bound);
    EXPECT_LE(std::abs(found.drift), 1e-3);
    EXPECT_LE(found.momentum, 1e-12);
    testing::Test::RecordProperty(friction > 0 ? "ratio" : "smooth", std::to_string(found.ratio));
    testing::Test::RecordProperty(friction > 0 ? "drift" : "smooth_drift", std::to_string(found.drift));
  }
}
} // namespace

// Bounds: 1 % for all pairings; none may plough (.355 between particles that
// meet as balls, the run stopped between meshes that jam).
TEST(Sliding, MeshOnMesh) { expect_coulomb<2>(Method::fem, Method::fem, 1e-3, .01); }
TEST(Sliding, ParticlesOnMesh) { expect_coulomb<2>(Method::fem, Method::sph, 1e-3, .01); }
TEST(Sliding, MeshOnParticles) { expect_coulomb<2>(Method::sph, Method::fem, 1e-3, .01); }
TEST(Sliding, ParticlesOnParticles) { expect_coulomb<2>(Method::sph, Method::sph, 1e-3, .01); }
TEST(Sliding, MeshOnMeshInThreeDimensions) { expect_coulomb<3>(Method::fem, Method::fem, 2e-3, .01); }
TEST(Sliding, ParticlesOnParticlesInThreeDimensions)
{
  // At 2 mm the block is three particles high and the drift 1.3e-3.
  expect_coulomb<3>(Method::sph, Method::sph, 1e-3, .01);
}
} // namespace ogive::coupling
