// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/unit/observers/synthetic.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ogive::coupling
{
namespace
{
constexpr double pi = std::numbers::pi;

/// 2 m of a solid with rho 2, K + 4/3 G = 18: c = 3 m/s; three half waves.
input::Scene bar()
{
  input::Scene s                  = synthetic::scene("linear", "elastic");
  s.materials[0].eos.bulk_modulus = 14;
  s.materials[0].shear_modulus    = 3;
  s.bodies[0].velocity_field      = "standing-wave";
  s.bodies[0].half_waves          = 3;
  return s;
}
constexpr double k = 3 * pi / 2, c = 3, w = k * c;

/// The exact wave of amplitude a at time t with the velocity of half a step
/// earlier, as the leapfrog has it: cos(wt - phi) with sin(phi) = w dt/2.
Sample wave(double a, double t, double dt)
{
  const double phase = std::asin(.5 * w * dt);
  return synthetic::row(-1, 1, 200,
                        [&](double x)
                        {
                          const double xi = x + 1;
                          return synthetic::Point{a * std::cos(k * xi) * std::cos(w * t - phase),
                                                  2 * c * a * std::sin(k * xi) * std::sin(w * t), 2};
                        });
}

double kept(const std::string &quantity, double amplitude, double t, double dt, double time)
{
  const auto o = synthetic::observer(quantity, bar());
  synthetic::seen(*o, 0, wave(1, 0, 0));
  StepFrame step;
  step.length = dt;
  o->every_step(step);
  return synthetic::seen(*o, time, wave(amplitude, t, dt));
}

// a stress of -2 c a sin sin follows from rho dv/dt = d(sigma)/dx
TEST(WaveEnergy, StaysWhateverThePhase)
{
  for (const double t : {0., .05, .11, .17, .31})
    EXPECT_NEAR(kept("fundamental_energy", 1, t, 0, t), 1, 1e-12) << t;
}

TEST(WaveEnergy, CountsTheLeapfrogsHalfStep)
{
  // cos(wt - phi) cos(wt + phi) + sin^2(wt) = cos^2(phi), at any time
  const double dt = .02, phase = std::asin(.5 * w * dt);
  for (const double t : {.02, .05, .11, .17})
    EXPECT_NEAR(kept("fundamental_energy", 1, t, dt, t), std::pow(std::cos(phase), 2), 1e-12) << t;
}

TEST(WaveEnergy, GoesWithTheSquareOfTheAmplitude)
{
  EXPECT_NEAR(kept("fundamental_energy", .5, .1, 0, .1), .25, 1e-12);
}

TEST(WaveEnergy, SeesNoOtherWave)
{
  const auto o = synthetic::observer("fundamental_energy", bar());
  synthetic::seen(*o, 0, wave(1, 0, 0));
  const Sample other =
      synthetic::row(-1, 1, 200,
                     [](double x) {
                       return synthetic::Point{std::cos(5 * pi / 2 * (x + 1)), std::sin(pi * (x + 1)), 2};
                     });
  EXPECT_NEAR(synthetic::seen(*o, 1, other), 0, 1e-12);
}

TEST(WaveAmplitudeLoss, IsOfOneWavelength)
{
  // .9 in each of 7 wavelengths of 4/3 m
  EXPECT_NEAR(kept("wave_amplitude_loss", std::pow(.9, 7), .1, 0, 7 * (4. / 3) / c), .1, 1e-12);
}

TEST(WaveEnergy, RefusesABodyWithoutTheWave)
{
  input::Scene s             = bar();
  s.bodies[0].velocity_field = "closing";
  EXPECT_THROW(synthetic::observer("fundamental_energy", s), InputError);
  s           = bar();
  s.dimension = input::Dimension::plane_strain;
  EXPECT_THROW(synthetic::observer("wave_amplitude_loss", s), InputError);
  EXPECT_THROW(synthetic::observer("oscillation_noise", s), InputError);
}

TEST(WaveEnergy, GoesOnAfterARestart)
{
  const auto first = synthetic::observer("fundamental_energy", bar());
  synthetic::seen(*first, 0, wave(2, 0, 0));
  io::MemoryArchive archive;
  first->save(archive, "o");
  const auto second = synthetic::observer("fundamental_energy", bar());
  second->load(archive, "o");
  EXPECT_NEAR(synthetic::seen(*second, 1, wave(1, .1, 0)), .25, 1e-12);
}

/// Modes of 40 particles: wavelength 80/m spacings.
Sample modes(double long_one, double short_one)
{
  return synthetic::row(-1, 1, 40,
                        [&](double x)
                        {
                          return synthetic::Point{long_one * std::cos(20 * pi * (x + 1) / 2) +
                                                      short_one * std::cos(21 * pi * (x + 1) / 2),
                                                  0, 1};
                        });
}

TEST(OscillationNoise, PartsWavesAtFourSpacings)
{
  const auto o = synthetic::observer("oscillation_noise", bar());
  EXPECT_NEAR(synthetic::seen(*o, 0, modes(1, 0)), 0, 1e-12);
  EXPECT_NEAR(synthetic::seen(*o, 1, modes(1, .5)), .25, 1e-12);
  // the order of the particles in memory is not that in space
  Sample shuffled = modes(1, .5);
  for (auto *field : {&shuffled.x, &shuffled.x0, &shuffled.v})
    for (int a = 0; a < 3; ++a)
      std::swap((*field)[a][3], (*field)[a][30]);
  EXPECT_NEAR(synthetic::seen(*o, 2, shuffled), .25, 1e-12);
}
} // namespace
} // namespace ogive::coupling
