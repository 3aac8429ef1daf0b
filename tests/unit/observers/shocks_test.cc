// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/exact_profile.h"
#include "tests/unit/observers/synthetic.h"

#include <gtest/gtest.h>

namespace ogive::coupling
{
namespace
{
using synthetic::Point;

/// Mie-Grueneisen, rho 2, c0 3, s 1.5, halves at 1 m/s each: U = 4.5, p = 9, the
/// front at 3.5 m/s from the middle, over at 1/4.5 s.
input::Scene closing()
{
  input::Scene s                      = synthetic::scene("mie-grueneisen", "fluid");
  s.materials[0].eos.bulk_sound_speed = 3;
  s.materials[0].eos.slope            = 1.5;
  s.materials[0].eos.gamma            = 2;
  s.bodies[0].velocity_field          = "closing";
  s.bodies[0].velocity_field_speed    = 1;
  return s;
}
constexpr double front = 3.5, plateau = 9, squeezed = 2 * 4.5 / 3.5;

Sample shocked(double t, double pressure_factor = 1, double velocity_off = 0)
{
  return synthetic::row(-1, 1, 4000,
                        [&](double x)
                        {
                          const bool behind = std::abs(x) < front * t;
                          return Point{(behind ? 0 : -std::copysign(1, x)) + velocity_off,
                                       behind ? plateau * pressure_factor : 0, behind ? squeezed : 2};
                        });
}

// p = rho0 (c0 + s u) u and rho0 U = rho (U - u)
TEST(ExactProfile, OfClosingHalvesIsTheHugoniot)
{
  const input::Scene s     = closing();
  const auto         exact = exact_profile(s.bodies[0], s, "");
  EXPECT_NEAR(exact->greatest_pressure(), plateau, 1e-12);
  EXPECT_NEAR(exact->until(), 1 / 4.5, 1e-12);
  const ExactState in = exact->at(.34, .1), out = exact->at(-.36, .1);
  EXPECT_NEAR(in.density, squeezed, 1e-12);
  EXPECT_EQ(in.velocity, 0);
  EXPECT_EQ(out.velocity, 1);
  EXPECT_EQ(out.density, 2);
  EXPECT_EQ(out.pressure, 0);
}

// validation A4: Sod, gamma 1.4
TEST(ExactProfile, OfTheShockTubeIsSods)
{
  const ShockTube tube(1.4, {1, 1}, {.125, .1});
  EXPECT_NEAR(tube.pressure(), .303130, 1e-6);
  EXPECT_NEAR(tube.velocity(), .927453, 1e-6);
  EXPECT_NEAR(tube.reach_right(), 1.752156, 1e-6);
  EXPECT_NEAR(tube.reach_left(), std::sqrt(1.4), 1e-12);
  EXPECT_NEAR(tube.at(.9).density, .426319, 1e-6);
  EXPECT_NEAR(tube.at(1).density, .265574, 1e-6);
  EXPECT_EQ(tube.at(1.76).density, .125);
  EXPECT_EQ(tube.at(-1.19).density, 1);
  // in the fan u + 2c/(gamma - 1) is that of the gas at rest, and p/rho^gamma
  const ExactState fan = tube.at(-.5);
  const double     c   = std::sqrt(1.4 * fan.pressure / fan.density);
  EXPECT_NEAR(fan.velocity + 5 * c, 5 * std::sqrt(1.4), 1e-12);
  EXPECT_NEAR(fan.pressure / std::pow(fan.density, 1.4), 1, 1e-12);
  EXPECT_NEAR(fan.velocity - c, -.5, 1e-12);
}

TEST(ExactProfile, OfTheShockTubeMayRunTheOtherWay)
{
  const ShockTube to_right(1.4, {1, 1}, {.125, .1}), to_left(1.4, {.125, .1}, {1, 1});
  for (const double s : {-1.5, -1., -.5, .3, .95, 1.5, 1.8})
  {
    EXPECT_NEAR(to_left.at(-s).density, to_right.at(s).density, 1e-12) << s;
    EXPECT_NEAR(to_left.at(-s).velocity, -to_right.at(s).velocity, 1e-12) << s;
  }
}

TEST(Overshoot, IsTheGreatestSinceAThirdOfTheWay)
{
  const auto o = synthetic::observer("overshoot", closing());
  EXPECT_TRUE(std::isnan(synthetic::seen(*o, .05, shocked(.05, 1.5)))) << "the start does not count";
  EXPECT_NEAR(synthetic::seen(*o, .1, shocked(.1, 1.02)), .02, 1e-12);
  EXPECT_NEAR(synthetic::seen(*o, .12, shocked(.12, 1.2)), .2, 1e-12);
  EXPECT_NEAR(synthetic::seen(*o, .15, shocked(.15, 1.01)), .2, 1e-12);
  io::MemoryArchive archive;
  o->save(archive, "o");
  const auto later = synthetic::observer("overshoot", closing());
  later->load(archive, "o");
  EXPECT_NEAR(synthetic::seen(*later, .2, shocked(.2, 1.1)), .2, 1e-12);
  EXPECT_NEAR(synthetic::seen(*later, .3, shocked(.2, 2)), .2, 1e-12) << "the front has reached the end";
}

TEST(ProfileError, IsZeroOnTheProfileAndGrowsWithTheDistance)
{
  for (const char *quantity : {"l1_error", "l1_density_error", "l1_velocity_error"})
  {
    const auto o = synthetic::observer(quantity, closing());
    EXPECT_NEAR(synthetic::seen(*o, .1, shocked(.1)), 0, 1e-12) << quantity;
  }
  const auto pressure = synthetic::observer("l1_error", closing());
  EXPECT_NEAR(synthetic::seen(*pressure, .1, shocked(.1, 1.3)), .3, 1e-12);
  EXPECT_NEAR(synthetic::seen(*pressure, .3, shocked(.1, 9)), .3, 1e-12) << "over, it keeps its value";
  // masses 2.571 in 0.7 m and 2 in 1.3 m: .1 everywhere over 1 outside
  const auto velocity = synthetic::observer("l1_velocity_error", closing());
  EXPECT_NEAR(synthetic::seen(*velocity, .1, shocked(.1, 1, .1)), .1 * (.7 * squeezed + 1.3 * 2) / (1.3 * 2),
              1e-12);
}

TEST(ProfileError, KnowsTheShockTube)
{
  input::Scene s              = synthetic::scene("ideal-gas", "fluid");
  s.materials[0].eos.gamma    = 1.4;
  s.materials[0].density      = 1;
  s.bodies[0].pressure        = 1;
  s.bodies[0].step_plane      = .25;
  s.bodies[0].density_beyond  = .125;
  s.bodies[0].pressure_beyond = .1;
  const ShockTube tube(1.4, {1, 1}, {.125, .1});
  const auto      exact = exact_profile(s.bodies[0], s, "");
  EXPECT_NEAR(exact->until(), .75 / 1.752156, 1e-6) << "the shock reaches the end first";
  const auto o = synthetic::observer("l1_density_error", s);
  EXPECT_NEAR(synthetic::seen(*o, .2,
                              synthetic::row(-1, 1, 500,
                                             [&](double x) {
                                               return Point{0, 0, 1.1 * tube.at((x - .25) / .2).density};
                                             })),
              .1, 1e-12);
}

TEST(ExactProfile, IsRefusedWhereNoneIsKnown)
{
  input::Scene s               = closing();
  s.materials[0].strength.law  = "elastic";
  s.materials[0].shear_modulus = 1;
  EXPECT_THROW(synthetic::observer("overshoot", s), InputError);
  s                          = closing();
  s.bodies[0].velocity_field = "shear";
  EXPECT_THROW(synthetic::observer("l1_error", s), InputError);
  s                                = closing();
  s.bodies[0].velocity_field_speed = 0;
  EXPECT_THROW(synthetic::observer("l1_error", s), InputError);
  s                      = synthetic::scene("linear", "fluid");
  s.bodies[0].step_plane = 0;
  s.bodies[0].pressure   = 1;
  EXPECT_THROW(synthetic::observer("l1_error", s), InputError);
}

// 400 particles on [-1, 1]: those within .4 m are struck, after .8 s
TEST(ShockSpeed, IsThatOfTheMass)
{
  const auto o = synthetic::observer("shock_speed", synthetic::scene("ideal-gas", "fluid"), 5);
  const auto p = [](double x) { return Point{0, std::abs(x) < .4 ? 6. : 4., 3}; };
  Sample     s = synthetic::row(-1, 1, 400, p);
  EXPECT_NEAR(synthetic::seen(*o, .8, s), .5, 1e-9);
  // a wrong pair moves it by its mass, 1/400 of 2 m each
  s.sigma[0][10] = s.sigma[0][390] = -6;
  EXPECT_NEAR(synthetic::seen(*o, .8, s), (.4 + .005) / .8, 1e-9);
  EXPECT_TRUE(std::isnan(synthetic::seen(*o, 0, s)));
}

// shells about a point off the origin, as heavy as those of a ball
TEST(ShockSpeed, IsRadial)
{
  input::Scene    s = synthetic::scene("ideal-gas", "fluid");
  input::Observer seen;
  seen.name = seen.quantity = "shock_speed";
  seen.body                 = "body";
  seen.point                = {3, 0, -1};
  seen.parameter            = 5;
  const auto o              = make_observer(seen, s);
  Sample ball = synthetic::row(0, 1, 1000, [](double r) { return Point{0, r < .3 ? 6. : 4., 3 * r * r}; });
  for (std::size_t i = 0; i < 1000; ++i)
  {
    const double r    = ball.x[0][i];
    ball.centre[0][i] = 3 + (i % 2 ? .6 : -.6) * r;
    ball.centre[2][i] = -1 + .8 * r;
  }
  EXPECT_NEAR(synthetic::seen(*o, .6, ball), .5, 1e-3);
}

TEST(DensityDeficit, IsOfTheInnermostParticles)
{
  const auto o = synthetic::observer("density_deficit", synthetic::scene("ideal-gas", "fluid"), 4);
  // the two at +-.005 have 3, the next ones at +-.015 have 4
  EXPECT_NEAR(synthetic::seen(*o, 1,
                              synthetic::row(-1, 1, 200,
                                             [](double x) {
                                               return Point{0, 0, std::abs(x) < .01 ? 3. : 4.};
                                             })),
              .25, 1e-12);
}
} // namespace
} // namespace ogive::coupling
