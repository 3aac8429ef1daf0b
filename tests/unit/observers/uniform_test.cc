// SPDX-License-Identifier: LGPL-2.1-or-later
// Observers of uniform stretching on samples made by hand.
#include "tests/unit/observers/synthetic.h"

#include <gtest/gtest.h>

namespace ogive::coupling
{
namespace
{
using namespace synthetic;

constexpr double bulk = 7, shear = 3, speed = .2; // of the body of 2 m: a rate of .2/s

input::Scene stretched()
{
  input::Scene s               = scene("linear", "elastic");
  s.materials[0].eos.bulk_modulus = bulk;
  s.materials[0].shear_modulus = shear;
  s.bodies[0].velocity_field   = "stretch";
  s.bodies[0].velocity_field_speed = speed;
  return s;
}

/// 20 particles with the exact stress after a time; those that began farther than
/// .5 m from the middle have another.
Sample pulled(double time, double factor)
{
  const double e = std::log(1 + speed * time), p = bulk * (1 / (1 + speed * time) - 1);
  Sample       s = row(-1, 1, 20, [](double) { return Point{}; });
  for (std::size_t i = 0; i < s.density.size(); ++i)
    for (int a = 0; a < 3; ++a)
    {
      const double exact = (a == 0 ? 4. / 3 : -2. / 3) * shear * e - p;
      s.sigma[static_cast<std::size_t>(a)][i] = exact * (std::abs(s.centre0[0][i]) < .5 ? factor : 77.);
    }
  return s;
}
} // namespace

// Stress off by a factor f everywhere is off by |f - 1| in the mean square.
TEST(PatchError, IsTheRelativeDistanceInside)
{
  const input::Scene s = stretched();
  const auto         o = observer("patch_error", s, .5);
  EXPECT_NEAR(seen(*o, .8, pulled(.8, 1)), 0, 1e-14);
  EXPECT_NEAR(seen(*o, .8, pulled(.8, 1.03)), .03, 1e-14);
  EXPECT_NEAR(seen(*o, .9, pulled(.9, 0)), 1, 1e-14);
  // with a margin of .4 two particles of the 12 inside have the other stress
  const auto wide = observer("patch_error", s, .4);
  EXPECT_NEAR(seen(*wide, .8, pulled(.8, 1)), 76 * std::sqrt(2. / 12), 1e-12);
}

TEST(PatchError, NeedsAnExactAnswer)
{
  input::Scene s = stretched();
  EXPECT_THROW(observer("patch_error", s, 1), InputError); // nothing is left inside
  s.bodies[0].velocity_field = "shear";
  EXPECT_THROW(observer("patch_error", s, .5), InputError);
  s                           = stretched();
  s.materials[0].strength.law = "perfect-plastic";
  EXPECT_THROW(observer("patch_error", s, .5), InputError);
}

// A tension of 1, 4, .5, .39, 0 Pa while the body of 2 m grows by .3 m a row: it
// breaks at the fourth, and whatever comes later does not change that.
TEST(FractureStrain, IsReadWhereTheTensionIsGone)
{
  const input::Scene s       = scene("linear", "elastic");
  auto               o       = observer("fracture_strain", s, 1.5);
  const double       pull[]  = {1, 4, .5, .39, 0};
  for (int k = 0; k < 5; ++k)
  {
    const Sample now = row(-1, 1 + .3 * k, 10, [&](double) { return Point{0, -pull[k], 1}; });
    o->row(frame(k, now));
    if (k < 3)
      EXPECT_TRUE(std::isnan(o->value())) << k;
    else
      EXPECT_NEAR(o->value(), .9 / 1.5, 1e-14) << k;
    io::MemoryArchive archive; // a restart at any row
    o->save(archive, "o");
    o = observer("fracture_strain", s, 1.5);
    o->load(archive, "o");
  }
}
} // namespace ogive::coupling
