// SPDX-License-Identifier: LGPL-2.1-or-later
// Sweeps that take each pair once, and sweeps left out where nothing changes,
// against the sweeps they stand for.
#include "sph/half/half.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1e-3;

BodyParticles<3> rod(bool breaks, int length)
{
  materials::Parameters m = material(8930, 130e9, 48e9, 3e8)->parameters();
  if (breaks)
  {
    m.damage.law            = "plastic-strain";
    m.damage.failure_strain = .01;
  }
  return box<3>(Vec3::Zero(), spacing * Vec3(5, 5, length), spacing, materials::make_material(m), .05, 3, {{0}});
}

/// Largest difference of two samples over the largest number of the first.
double difference(const Sample &a, const Sample &b)
{
  EXPECT_EQ(a.id, b.id);
  double worst = 0;
  const auto look = [&](const std::vector<double> &u, const std::vector<double> &w) {
    double most = 0, apart = 0;
    for (std::size_t k = 0; k < u.size(); ++k)
    {
      most  = std::max(most, std::abs(u[k]));
      apart = std::max(apart, std::abs(u[k] - w[k]));
    }
    worst = std::max(worst, most > 0 ? apart / most : apart);
  };
  for (int k = 0; k < 3; ++k)
  {
    look(a.x[k], b.x[k]);
    look(a.v[k], b.v[k]);
  }
  for (int k = 0; k < 6; ++k)
    look(a.sigma[k], b.sigma[k]);
  look(a.energy, b.energy);
  look(a.density, b.density);
  return worst;
}

void meets_general(bool breaks, const char *limiter)
{
  Parameters p;
  p.options.limiter = limiter;
  p.symmetry        = {{0}};
  p.walls.push_back({"wall", Vec3(0, 0, -.2 * spacing), Vec3::UnitZ(), Vec3(0, 0, 30), .1});
  auto body = rod(breaks, 10);
  for (std::size_t i = 0; i < body.x.size(); ++i)
  {
    body.v[i][0] = 60 * body.x[i][0] / (5 * spacing);
    body.v[i][2] = -90 + 40 * std::sin(900 * body.x[i][1]);
  }
  Solver<3> joint(p, {body}), general(p, {body});
  general.weigh({}, {}); // shares, even of one, are known to the general sweeps alone
  Runner<3> a{joint}, b{general};
  for (int k = 0; k < 30; ++k)
  {
    // Both bounds see the same damping: sound speeds in pair forces are rounded to 2^-17 m/s.
    EXPECT_NEAR(joint.stable_dt().dt, general.stable_dt().dt, 1e-7 * general.stable_dt().dt);
    const double dt = general.stable_dt().dt;
    ASSERT_TRUE(a.step(dt).ok);
    ASSERT_TRUE(b.step(dt).ok);
  }
  // 2^-18 m/s of 4660 m/s is 8e-10 of every dissipative force; rounding apart, nothing
  // else differs, and 30 steps of a smooth motion add up to no more than ten times that.
  EXPECT_LT(difference(general.sample(0), joint.sample(0)), 1e-8);
  const Balance u = joint.balance(), w = general.balance();
  EXPECT_NEAR(u.viscosity_heat, w.viscosity_heat, 1e-7 * w.viscosity_heat);
  EXPECT_NEAR(u.hourglass_sph, w.hourglass_sph, 1e-7 * w.hourglass_sph);
}

TEST(Joint, SweepsMeetTheGeneralOnes)
{
  meets_general(false, "linear");
  meets_general(false, "none");
  meets_general(true, "linear");
}

TEST(Joint, SoundAndShareComeBack)
{
  // Bounds: half a unit for the sound speed, the spacing of numbers near 10 km/s over the unit for the share.
  for (const double c : {0., 50., 343., 4660., 9999.9})
    for (const double share : {0., 1e-6, .3, .999999, 1.})
    {
      double c_back = 0, share_back = 0;
      SoundAndShare::unpack(SoundAndShare::pack(c, share), c_back, share_back);
      EXPECT_NEAR(c_back, c, .5 * SoundAndShare::unit);
      EXPECT_NEAR(share_back, share, 3e-7);
    }
}

TEST(Joint, ReciprocalsAreRoundedAsDivisionsNearly)
{
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> exponent(-250, 250), digit(1, 2);
  for (int k = 0; k < 20000; ++k)
  {
    const double a = digit(random) * std::exp2(exponent(random));
    EXPECT_NEAR(reciprocal(VDouble(a))[0] * a, 1, 5e-16); // two units in the last place, and the product's
    const double root = reciprocal_root(VDouble(a))[0];
    EXPECT_NEAR(root * std::sqrt(a), 1, 7e-16); // the same, and the root's
  }
}

TEST(Rest, LeavesTheStateAsItIs)
{
  auto body = rod(false, 60);
  for (std::size_t i = 0; i < body.x.size(); ++i)
    body.v[i][2] = body.x[i][2] < 4 * spacing ? 40 : 0; // the far end is reached within some 60 steps
  Parameters with, without;
  with.symmetry = without.symmetry = {{0}};
  without.options.quiescent_skip   = "off";
  Solver<3> a(with, {body}), b(without, {body});
  Runner<3> run_a{a}, run_b{b};
  for (int k = 0; k < 40; ++k)
  {
    ASSERT_EQ(a.stable_dt().dt, b.stable_dt().dt);
    ASSERT_TRUE(run_a.step().ok);
    ASSERT_TRUE(run_b.step().ok);
  }
  const Sample u = a.sample(0), w = b.sample(0);
  ASSERT_EQ(u.id, w.id);
  const auto same = [](const std::vector<double> &p, const std::vector<double> &q) {
    ASSERT_EQ(std::memcmp(p.data(), q.data(), p.size() * sizeof(double)), 0);
  };
  for (int k = 0; k < 3; ++k)
  {
    same(u.x[k], w.x[k]);
    same(u.v[k], w.v[k]);
  }
  for (int k = 0; k < 6; ++k)
    same(u.sigma[k], w.sigma[k]);
  same(u.density, w.density);
  same(u.energy, w.energy);
  const auto d = a.diagnostics();
  EXPECT_EQ(b.diagnostics().rows, 0u);
  EXPECT_GT(d.rows_skipped, d.rows / 4); // else this proves little
  std::printf("rows left out: %.0f %%\n", 100. * static_cast<double>(d.rows_skipped) / static_cast<double>(d.rows));
}
} // namespace
