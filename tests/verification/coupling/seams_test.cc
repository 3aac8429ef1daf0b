// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/certificate.h"
#include "tests/verification/coupling/support.h"

#include <gtest/gtest.h>

/// Seams beside each other, at walls, around circles: the books of each.
namespace ogive::coupling
{
namespace
{
using scenes::add_box;
using scenes::Driver;
using scenes::steel_scene;

constexpr double dx = 1e-3;
} // namespace

// Two separate bars with a seam each, one of them at rest: what the interfaces
// book is what the total gains, and no more for there being two.
TEST(Seams, EachBooksItsOwnWork)
{
  auto scene = steel_scene(input::Dimension::plane_strain);
  for (const double y : {0., 40 * dx})
  {
    const std::string n = y > 0 ? "2" : "1";
    add_box(scene, "zone" + n, input::Method::sph, {-10 * dx, y, 0}, {0, y + 6 * dx, 0}, dx, Vec3::Zero());
    add_box(scene, "rest" + n, input::Method::fem, {0, y, 0}, {10 * dx, y + 6 * dx, 0}, dx, Vec3::Zero());
    scene.interfaces.push_back({"seam" + n, "pair-flux", "zone" + n, "rest" + n});
  }
  scene.bodies[0].velocity = {10, 0, 0}; // its particles press on its elements
  Driver<2> run(scene);
  const auto first = run.model.ledger();
  for (int n = 0; n < 200; ++n)
    run.step();
  const auto last = run.model.ledger();
  EXPECT_GT(std::abs(last.interface_work), 1e-8 * first.kinetic);
  EXPECT_NEAR(last.interface_work, last.total - first.total, 1e-12 * first.kinetic);
}

// A bar on a wall whose squeezed elements turn into particles: the wall, at
// rest, gives no energy. (Landed at their rest gap, newcomers got a quarter of
// the kinetic energy at the start.)
TEST(Seams, NewcomersAtAWallGetNoBlow)
{
  auto scene = steel_scene(input::Dimension::plane_strain);
  add_box(scene, "bar", input::Method::automatic, {-3 * dx, 0, 0}, {3 * dx, 12 * dx, 0}, dx, {0, -100, 0});
  scene.walls.push_back({"wall", Vec3::Zero(), Vec3::UnitY(), Vec3::Zero(), 0});
  scene.bodies[0].conversion.step = 1; // all of it, when asked
  Driver<2>  converting(scene);
  const auto first = converting.model.ledger();
  double    least = 0, most = 0;
  for (int n = 0; n < 60; ++n)
  {
    if (n == 12)
    {
      EXPECT_FALSE(converting.model.convert(n, converting.time).empty());
    }
    converting.step();
    const auto row = converting.model.ledger();
    least          = std::min(least, row.wall_loss);
    most           = std::max(most, row.kinetic);
  }
  EXPECT_GT(converting.model.particles(), 0u);
  EXPECT_GT(least, -1e-6 * first.kinetic);
  EXPECT_LE(most, first.kinetic * (1 + 1e-9));
}

// A disc of particles in a ring of elements of the same size, tied, in uniform
// flight: nothing acts. The particles take mass from the nodes behind the seam;
// a step that does not know it feeds rounding until the bodies burst.
TEST(Seams, TiedDiscFliesOnAlike)
{
  auto scene = steel_scene(input::Dimension::plane_strain);
  const Vec3 v(30, 20, 0);
  add_box(scene, "zone", input::Method::sph, Vec3::Zero(), Vec3::Zero(), dx, v);
  add_box(scene, "rest", input::Method::fem, Vec3::Zero(), Vec3::Zero(), dx, v);
  auto &zone = scene.bodies[0].shape, &rest = scene.bodies[1].shape;
  zone.kind         = input::ShapeKind::disc;
  rest.kind         = input::ShapeKind::ring;
  zone.radius       = 6 * dx;
  rest.inner_radius = 6 * dx;
  rest.radius       = 12 * dx;
  scene.fem.bulk_linear = scene.fem.bulk_quadratic = 0;
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  Driver<2>  run(scene);
  const auto first = run.model.ledger();
  for (int n = 0; n < 1500; ++n)
    run.step();
  const auto last = run.model.ledger();
  EXPECT_LT(last.elastic, 1e-12 * first.kinetic);
  EXPECT_NEAR(last.kinetic, first.kinetic, 1e-10 * first.kinetic);
}

// Waves that neither side carries, or that need no measuring, are refused and
// not passed.
TEST(Seams, CertificateKnowsWhatItCannotMeasure)
{
  auto scene = steel_scene(input::Dimension::uniaxial);
  add_box(scene, "zone", input::Method::sph, {-20 * dx, 0, 0}, Vec3::Zero(), dx, Vec3::Zero());
  add_box(scene, "rest", input::Method::fem, Vec3::Zero(), {20 * dx, 0, 0}, 2 * dx, Vec3::Zero());
  scene.interfaces.push_back({"seam", "tied", "zone", "rest"});
  for (const double wave : {1e-30, 3 * dx, 7.9 * dx, 600 * dx, 1e30})
  {
    scene.interfaces[0].certificate_wavelength = wave;
    try
    {
      seams_of(scene);
      ADD_FAILURE() << wave;
    }
    catch (const InputError &e)
    {
      EXPECT_EQ(e.where().entry, "Interfaces/seam/certificate wavelength");
    }
  }
  scene.interfaces[0].certificate_wavelength = 16 * dx;
  EXPECT_EQ(seams_of(scene).size(), 1u);
}
} // namespace ogive::coupling
