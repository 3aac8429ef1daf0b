// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/verification/coupling/support.h"

#include <cmath>
#include <sstream>

/// Bodies of elements that meet rim on rim. Both bulge alike, so a rim node
/// comes and goes past the other's rim while it is deep behind the face. Before
/// faces went on past their rims each coming and going made a jump of the total:
/// +4.7 % (blocks), +10.5 % (cylinders), +28 % (boxes in three dimensions).
namespace ogive::coupling
{
namespace
{
using input::Dimension;

/// Elements of a body that the other meets, m, and how they stand to each other.
struct Meeting
{
  double size     = .5e-3; ///< of the second body's elements
  double aside    = 0;     ///< of the second body, along x, m
  double wider    = 0;     ///< by how much the second body is wider (on each side), m
  double friction = 0;
};

/// Two bodies of 6 mm, 8 mm wide (3-D: 6 mm), close at 20 m/s for as long as it
/// takes a wave (1.16 mm/us) to run through both and back, and apart again.
scenes::Slide meet(Dimension dimension, const Meeting &m)
{
  auto  scene            = scenes::steel_scene(dimension);
  auto &steel            = scene.materials.front(); // E 1 GPa, nu .3
  steel.density          = 1000;
  steel.shear_modulus    = 1e9 / 2.6;
  steel.eos.bulk_modulus = 1e9 / 1.2;
  const bool   space     = dimension == Dimension::three_d;
  const double half = space ? 3e-3 : 4e-3, left = dimension == Dimension::axisymmetric ? 0 : -half;
  const auto   at = [&](double x, double y, double up) { return space ? Vec3(x, y, up) : Vec3(x, up, 0); };
  const Vec3   velocity = at(0, 0, 10);
  const double more     = dimension == Dimension::axisymmetric ? 0 : -m.wider;
  scenes::add_box(scene, "low", input::Method::fem, at(left, -half, 0), at(half, half, 6e-3),
                  space ? .75e-3 : .5e-3, velocity);
  scenes::add_box(scene, "high", input::Method::fem,
                  at(left + m.aside + more, -half + .3 * m.aside - m.wider, 6.6e-3),
                  at(half + m.aside + m.wider, half + .3 * m.aside + m.wider, 12.6e-3), m.size, -velocity);
  scene.contacts.push_back({"touch", "low", "high", m.friction, .1});
  return space ? scenes::run<3>(scene, 60e-6) : scenes::run<2>(scene, 60e-6);
}

/// The bar: 3e-3 of the energy, momentum at rounding. Records the worst.
class Books
{
public:
  ~Books()
  {
    std::ostringstream drift, momentum;
    drift << drift_;
    momentum << momentum_;
    testing::Test::RecordProperty("drift", drift.str());
    testing::Test::RecordProperty("momentum", momentum.str());
  }
  void expect(Dimension dimension, const Meeting &meeting)
  {
    const scenes::Slide found = meet(dimension, meeting);
    EXPECT_LE(std::abs(found.drift), 3e-3) << "elements of " << meeting.size << " m, " << meeting.aside
                                           << " m aside, " << meeting.wider << " m wider";
    EXPECT_LE(found.momentum, 1e-12);
    drift_    = std::max(drift_, std::abs(found.drift));
    momentum_ = std::max(momentum_, found.momentum);
  }

private:
  double drift_ = 0, momentum_ = 0;
};
} // namespace

TEST(Rims, EqualBodiesKeepTheBooks)
{
  Books books;
  for (const double friction : {0., .2})
  {
    books.expect(Dimension::plane_strain, {.5e-3, 0, 0, friction});
    books.expect(Dimension::axisymmetric, {.5e-3, 0, 0, friction});
    books.expect(Dimension::three_d, {.75e-3, 0, 0, friction});
  }
}

// Offsets in elements: too small to matter, within and past the reach of a rim.
TEST(Rims, BodiesThatStandAsideKeepTheBooks)
{
  Books books;
  for (const double share : {1e-4, 1e-3, .1, .3, .5, .7, 1.})
  {
    books.expect(Dimension::plane_strain, {.5e-3, share * .5e-3, 0, 0});
    books.expect(Dimension::plane_strain, {.5e-3, share * .5e-3, 0, .2});
    books.expect(Dimension::plane_strain, {.5e-3, 0, share * .5e-3, 0});
    books.expect(Dimension::axisymmetric, {.5e-3, 0, share * .5e-3, 0});
    books.expect(Dimension::three_d, {.75e-3, share * .75e-3, 0, 0});
  }
}

TEST(Rims, OtherSizesOfElementsKeepTheBooks)
{
  Books books;
  for (const double size : {.25e-3, .3e-3, .4e-3, .6e-3, .75e-3, 1e-3})
  {
    books.expect(Dimension::plane_strain, {size, 0, 0, 0});
    books.expect(Dimension::axisymmetric, {size, 0, 0, 0});
    if (size > .4e-3)
      books.expect(Dimension::three_d, {size, 0, 0, 0});
  }
}
} // namespace ogive::coupling
