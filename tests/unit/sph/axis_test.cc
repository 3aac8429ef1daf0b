// SPDX-License-Identifier: LGPL-2.1-or-later
// Particles that are rings: axial symmetry.
#include "core/base/error.h"
#include "core/materials/started_material.h"
#include "sph/axis_factor.h"
#include "support.h"

#include <gtest/gtest.h>

#include <numbers>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;

constexpr double spacing = 1.9e-3;

/// A section r, z between two corners, in spacings, jittered.
BodyParticles<2> rings(const Vec3 &lower, const Vec3 &upper, std::shared_ptr<const materials::Material> m,
                       double jitter = 0, unsigned seed = 7)
{
  input::Scene scene;
  scene.dimension = input::Dimension::axisymmetric;
  input::Body body;
  body.name        = "rings";
  body.spacing     = spacing;
  body.shape.lower = spacing * lower;
  body.shape.upper = spacing * upper;
  auto p           = fill<2>(body, scene, 0, m);
  shake(p, spacing, jitter, seed);
  return p;
}

Parameters quiet()
{
  Parameters q;
  q.axisymmetric       = true;
  q.options.alpha      = q.options.beta = 0;
  q.options.hourglass  = 0;
  q.options.correction = "none";
  return q;
}

/// numerics of the plan (a prototype's table, cubic spline): held to 1 %, the
/// difference between its lattice and the integral.
TEST(AxisFactor, AgreesWithTheTable)
{
  const AxisFactor phi("cubic");
  const double     table[] = {0,     .1923, .3763, .5444, .6908,  .8114,  .9045,  .9708,  1.0128, 1.0344, 1.0406,
                              1.0364, 1.0265, 1.0149, 1.0042, .9965, .9920, .9909, .9921, .9949, .9981, 1.0009};
  for (int k = 0; k < 22; ++k)
    EXPECT_NEAR(phi(.125 * k), table[k], .01 * std::min(1., .5 + table[k])) << .125 * k;
  EXPECT_EQ(phi(100), 1);
}

/// A hydrostatic column: in-plane and hoop forces of a uniform pressure cancel
/// next to the axis. p/(rho dx) is the acceleration that the pressure would give
/// over one spacing; the bound .02 is that of the plan's lead (.013) and its
/// rounding. With phi = 1 the first ring gets .9 of it.
TEST(AxisFactor, UniformPressureRestsOnTheLattice)
{
  for (const char *kernel : {"cubic", "quintic", "wendland-c2", "wendland-c4"})
  {
    materials::Parameters gas;
    gas.name         = "gas";
    gas.density      = 1;
    gas.eos.law      = "ideal-gas";
    gas.eos.gamma    = 1.4;
    gas.strength.law = "fluid";
    auto         p   = rings(Vec3(0, 0, 0), Vec3(16, 16, 0), materials::make_material(gas));
    const double pressure = 3;
    p.material = std::make_shared<materials::StartedMaterial>(
      p.material, std::vector<materials::StartState>(p.x.size(), {1., pressure}));
    Parameters q     = quiet();
    q.options.kernel = kernel;
    if (std::string(kernel).starts_with("wendland"))
      q.options.h_over_dx = 1.8; // at 1.3 these kernels do not sum a lattice well anywhere
    Solver<2>  solver(q, {p});
    const double dt = 1e-9;
    Runner<2>{solver}.step(dt);
    const Sample s     = solver.sample(0);
    double       worst = 0;
    for (std::size_t i = 0; i < s.x[0].size(); ++i)
      if (s.x[0][i] < 8 * spacing && s.x[1][i] > 6 * spacing && s.x[1][i] < 10 * spacing)
        worst = std::max(worst, std::hypot(s.v[0][i], s.v[1][i]) / (.5 * dt) / (pressure / spacing));
    EXPECT_LT(worst, .02) << kernel;
    EXPECT_GT(worst, 0) << kernel;
  }
}

/// v = (a r, b z + c) is the affine motion that an axis allows: the volume of
/// every ring follows it to rounding, at the axis, at the surfaces, jittered.
TEST(Axisymmetric, UniformExpansionIsExact)
{
  const auto   faint = material(2000, 1e-16, 4e-17); // so that nothing but the strain acts
  const double a = 31, b = -17, c = 5, dt = 2e-4;
  for (const double jitter : {0., .2})
  {
    auto p = rings(Vec3(0, -4, 0), Vec3(9, 7, 0), faint, jitter);
    for (std::size_t i = 0; i < p.x.size(); ++i)
      p.v[i] = {a * p.x[i][0], b * p.x[i][1] + c};
    Solver<2> solver(quiet(), {p});
    Runner<2> run{solver};
    double    swelled = 1;
    for (int k = 0; k < 60; ++k)
    {
      ASSERT_TRUE(run.step(dt).ok);
      // The rates of a body in free flight: x(t) = x0 (1 + a t).
      const double t = (k + 1) * dt;
      swelled        = (1 + a * t) * (1 + a * t) * (1 + b * t);
    }
    EXPECT_EQ(solver.diagnostics().fallbacks, 0u);
    const Sample s = solver.sample(0);
    for (std::size_t i = 0; i < s.x[0].size(); ++i)
    {
      EXPECT_NEAR(s.density[i] * swelled / 2000, 1, 1e-12);
      // Hoop and radial strain are one; the axial one differs by what b - a strained.
      EXPECT_NEAR(s.sigma[0][i], s.sigma[2][i], 1e-12 * std::abs(s.sigma[1][i] - s.sigma[0][i]));
      EXPECT_NEAR(s.sigma[3][i], 0, 1e-12 * std::abs(s.sigma[1][i] - s.sigma[0][i]));
    }
  }
}

/// Away from the axis any affine motion of the plane is exact too, and the hoop
/// strain is v_r/r.
TEST(Axisymmetric, ShearAwayFromTheAxisIsExact)
{
  const double G = 48e9;
  auto         p = rings(Vec3(8, 0, 0), Vec3(16, 9, 0), material(8930, 130e9, G), .2);
  const double a = 3, b = -2, c = 1.5, d = 4, dt = 1e-9;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i] = {a * p.x[i][0] + c * p.x[i][1], b * p.x[i][1] + d * p.x[i][0]};
  Solver<2> solver(quiet(), {p});
  Runner<2>{solver}.step(dt);
  const Sample s = solver.sample(0);
  for (std::size_t i = 0; i < s.x[0].size(); ++i)
  {
    // To first order in dt = 1e-9: 1e-8 of the stress.
    EXPECT_NEAR(s.sigma[3][i], G * (c + d) * dt, 1e-7 * G * dt);
    const double hoop = s.v[0][i] / s.x[0][i];
    EXPECT_NEAR(s.sigma[2][i] - s.sigma[0][i], 2 * G * (hoop - a) * dt, 1e-7 * G * dt);
  }
}

/// A block on the axis that deforms, yields and rings.
BodyParticles<2> ringing(double bottom = 0)
{
  auto p = rings(Vec3(0, bottom, 0), Vec3(9, 14, 0), material(8930, 130e9, 48e9, 3e8), .15, 5);
  for (std::size_t i = 0; i < p.x.size(); ++i)
    p.v[i] = {(130 * std::cos(310 * p.x[i][1]) - 40) * p.x[i][0] / (9 * spacing),
              130 * std::cos(310 * p.x[i][0]) - 4000 * p.x[i][1]};
  return p;
}

TEST(Axisymmetric, EnergyAndAxialMomentumAreKept)
{
  struct Case
  {
    const char *name;
    void (*set)(input::SphOptions &);
  };
  using O = input::SphOptions;
  for (const Case &c : {Case{"default", [](O &) {}}, Case{"plain", [](O &o) { o.correction = "none"; }},
                        Case{"split", [](O &o) { o.shock_split = "curvature", o.limiter = "linear"; }},
                        Case{"standard", [](O &o) { o.form = "standard"; }},
                        Case{"artificial stress", [](O &o) { o.artificial_stress = .3; }},
                        Case{"shepard", [](O &o) { o.correction = "shepard", o.energy_form = "working"; }}})
  {
    SCOPED_TRACE(c.name);
    Parameters q;
    q.axisymmetric = true;
    c.set(q.options);
    Solver<2>     solver(q, {ringing()});
    const Balance before = solver.balance();
    Runner<2>     run{solver};
    const auto    total = [](const Balance &b) {
      return b.kinetic + b.elastic + b.plastic_work + b.viscosity_heat + b.hourglass_sph;
    };
    for (int k = 0; k < 300; ++k)
      ASSERT_TRUE(run.step().ok) << k;
    const Balance after = solver.balance();
    EXPECT_NEAR(total(after) / total(before), 1, 1e-11);
    if (q.options.correction != "shepard") // which keeps no momentum, see Configurations
      EXPECT_NEAR(after.momentum[1], before.momentum[1], 1e-13 * after.mass * 130);
    EXPECT_EQ(after.momentum[0], 0);
    EXPECT_GT(after.plastic_work, 0);
    EXPECT_GT(after.viscosity_heat, 0);
    EXPECT_NEAR(after.mass, 8930 * std::numbers::pi * 81 * 14 * std::pow(spacing, 3), 1e-9 * after.mass);
  }
}

/// The plane of symmetry z = 0 and a rigid wall there give the block the same
/// motion as its own mirror image does.
TEST(Axisymmetric, HalfABlockMovesAsTheWhole)
{
  const auto half  = rings(Vec3(0, 0, 0), Vec3(6, 7, 0), material(8930, 130e9, 48e9, 3e8));
  const auto whole = rings(Vec3(0, -7, 0), Vec3(6, 7, 0), material(8930, 130e9, 48e9, 3e8));
  const auto end   = [](BodyParticles<2> p, bool plane) {
    for (std::size_t i = 0; i < p.x.size(); ++i)
      p.v[i] = {2e4 * p.x[i][0], -4e4 * p.x[i][1]};
    Parameters q;
    q.axisymmetric = true;
    if (plane)
      q.symmetry.push_back({1});
    Solver<2> solver(q, {p});
    Runner<2> run{solver};
    for (int k = 0; k < 60; ++k)
      EXPECT_TRUE(run.step(6e-8).ok);
    return solver.balance();
  };
  const Balance a = end(half, true), b = end(whole, false);
  EXPECT_NEAR(2 * a.kinetic / b.kinetic, 1, 1e-10);
  EXPECT_NEAR(2 * a.plastic_work / b.plastic_work, 1, 1e-10);
}

/// Free blocks on the axis at tiny amplitude: noise stays within its bound at
/// 1.0 of the step, with and without a hole.
TEST(Axisymmetric, StepBoundHolds)
{
  for (const double hole : {0., 3.})
  {
    auto p = rings(Vec3(hole, 0, 0), Vec3(hole + 9, 11, 0), copper());
    std::mt19937                           random(9);
    std::uniform_real_distribution<double> u(-1e-6, 1e-6);
    for (auto &v : p.v)
      for (auto &component : v)
        component = u(random);
    const auto growth = [&](double share) {
      Parameters q          = quiet();
      q.options.step_factor = 1;
      Solver<2>    solver(q, {p});
      const double dt = share * solver.stable_dt().dt, before = solver.balance().kinetic;
      Runner<2>    run{solver};
      double       most = 0;
      for (int k = 0; k < 4000 && most < 1e12; ++k)
      {
        if (!run.step(dt).ok)
          return 1e300;
        most = std::max(most, solver.balance().kinetic / before);
      }
      return most;
    };
    EXPECT_LT(growth(1.), 20) << hole;
    EXPECT_GT(growth(1.6), 1e6) << hole;
  }
}

TEST(Axisymmetric, RefusesWhatKnowsNoAxis)
{
  Parameters summed, reference;
  summed.axisymmetric = reference.axisymmetric = true;
  summed.options.density                       = "summation";
  reference.options.configuration              = "reference";
  EXPECT_THROW(Solver<2>(summed, {ringing()}), InputError);
  EXPECT_THROW(Solver<2>(reference, {ringing()}), InputError);
}
} // namespace
