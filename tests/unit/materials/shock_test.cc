// SPDX-License-Identifier: LGPL-2.1-or-later
// Shocks and states at the start, from a material's own equation of state.
#include "core/base/error.h"
#include "core/materials/hugoniot.h"
#include "core/materials/started_material.h"
#include "one_point.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ogive::materials
{
namespace
{
/// A fluid of density 3.
Parameters fluid(const std::string &eos)
{
  Parameters p;
  p.density      = 3;
  p.eos.law      = eos;
  p.strength.law = "fluid";
  return p;
}

// U = c0 + s u is what the law is made of
TEST(Hugoniot, OfMieGrueneisen)
{
  Parameters p           = fluid("mie-grueneisen");
  p.eos.bulk_sound_speed = 5;
  p.eos.slope            = 1.3;
  p.eos.gamma            = 1.9;
  for (const double u : {1e-4, .1, 1., 3.})
  {
    const Shock  s = hugoniot(p, u);
    const double U = 5 + 1.3 * u;
    EXPECT_NEAR(s.speed, U, 1e-9 * U) << u;
    EXPECT_NEAR(s.pressure, 3 * U * u, 1e-9 * s.pressure) << u;
    EXPECT_NEAR(s.density, 3 * U / (U - u), 1e-9 * s.density) << u;
  }
}

// p = K (rho/rho0 - 1): U^2 - u U - K/rho0 = 0
TEST(Hugoniot, OfTheLinearLaw)
{
  Parameters p       = fluid("linear");
  p.eos.bulk_modulus = 48;
  const double u = 1.5, U = .5 * u + std::sqrt(.25 * u * u + 16);
  EXPECT_NEAR(hugoniot(p, u).speed, U, 1e-9 * U);
}

// a strong shock: (gamma + 1)/(gamma - 1), and U = (gamma + 1)/2 u
TEST(Hugoniot, OfAColdGas)
{
  Parameters p = fluid("ideal-gas");
  p.eos.gamma  = 5. / 3;
  EXPECT_NEAR(hugoniot(p, 2).density, 3 * 4, 1e-9);
  EXPECT_NEAR(hugoniot(p, 2).speed, 4. / 3 * 2, 1e-9);
}

TEST(Hugoniot, RefusesWhatItDoesNotKnow)
{
  Parameters p       = fluid("linear");
  p.eos.bulk_modulus = 48;
  p.shear_modulus    = 1;
  p.strength.law     = "elastic";
  EXPECT_THROW(hugoniot(p, 1), InputError);
  // a density beyond a million times that at rest
  p.strength.law = "fluid";
  EXPECT_THROW(hugoniot(p, 1e5), InputError);
}

TEST(StartedMaterial, StartsInTheGivenStates)
{
  Parameters p                                 = fluid("ideal-gas");
  p.eos.gamma                                  = 1.4;
  const std::shared_ptr<const Material> within = make_material(p);
  const StartedMaterial                 started(within, {{3, 12}, {.5, 7}});
  Points                                points;
  points.resize(4);
  points.density[0] = 99;
  started.initialise(points, 1, 3);
  EXPECT_EQ(points.density[0], 99) << "another body's";
  EXPECT_EQ(points.density[1], 3);
  EXPECT_EQ(points.density[2], .5);
  // e = p/((gamma - 1) rho), c^2 = gamma p/rho
  EXPECT_NEAR(points.energy[1], 12 / (.4 * 3), 1e-12);
  EXPECT_NEAR(points.energy[2], 7 / (.4 * .5), 1e-12);
  EXPECT_NEAR(points.sound_speed[2], std::sqrt(1.4 * 7 / .5), 1e-12);
  for (int a = 0; a < 6; ++a)
    EXPECT_EQ(points.sigma[a][2], a < 3 ? -7 : 0);
  EXPECT_THROW(started.initialise(points, 0, 4), std::logic_error);
}

// Left alone, the state is what the law says of it: an update at rest keeps it.
TEST(StartedMaterial, StaysAsItStarts)
{
  Parameters p           = fluid("mie-grueneisen");
  p.eos.bulk_sound_speed = 5;
  p.eos.slope            = 1.3;
  p.eos.gamma            = 1.9;
  const StartedMaterial started(make_material(p), {{3.2, 40}});
  Points                points;
  points.resize(1);
  started.initialise(points, 0, 1);
  const double rest = 0, density = 3.2;
  Increments   still;
  still.strain.fill(&rest);
  still.spin.fill(&rest);
  still.density    = &density;
  still.dt         = 1e-3;
  std::size_t  bad = 0;
  const double c   = points.sound_speed[0];
  EXPECT_EQ(started.update(points, 0, 1, still, bad), Status::ok);
  EXPECT_NEAR(points.sigma[0][0], -40, 1e-12);
  EXPECT_NEAR(points.sound_speed[0], c, 1e-12);
}

// p = K (rho/rho0 - 1) with rho0 3: stretched by a sixth, and no heat in it.
TEST(StartedMaterial, MayStartInTension)
{
  Parameters p       = fluid("linear");
  p.density          = 3;
  p.eos.bulk_modulus = 48;
  EXPECT_NEAR(cold_pressure(p, 2.5), -8, 1e-13);
  const StartedMaterial started(make_material(p), {{2.5, cold_pressure(p, 2.5)}});
  Points                points;
  points.resize(1);
  started.initialise(points, 0, 1);
  EXPECT_NEAR(points.sigma[1][0], 8, 1e-13);
  EXPECT_EQ(points.energy[0], 0);
}

TEST(StartedMaterial, RefusesAPressureThatNoHeatMakes)
{
  Parameters p       = fluid("linear");
  p.eos.bulk_modulus = 48;
  EXPECT_THROW(StartedMaterial(make_material(p), {{3, 12}}), InputError);
}
} // namespace
} // namespace ogive::materials
