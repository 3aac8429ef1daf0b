// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/unit/observers/synthetic.h"

#include <gtest/gtest.h>

namespace ogive::coupling
{
namespace
{
RowFrame energies(double kinetic, double viscosity_heat, double plastic_work)
{
  RowFrame f;
  f.kinetic        = kinetic;
  f.viscosity_heat = viscosity_heat;
  f.plastic_work   = plastic_work;
  return f;
}

TEST(Heat, IsMeasuredByTheKineticEnergyOfTheStart)
{
  const input::Scene s     = synthetic::scene("linear", "elastic");
  const auto         kept  = synthetic::observer("kinetic_energy_kept", s);
  const auto         share = synthetic::observer("viscosity_heat_share", s);
  for (Observer *o : {kept.get(), share.get()})
  {
    o->row(energies(8, 0, 0));
    o->row(energies(2, 3, 0));
  }
  EXPECT_DOUBLE_EQ(kept->value(), .25);
  EXPECT_DOUBLE_EQ(share->value(), .375);
}

TEST(Heat, IsMeasuredByThePlasticWork)
{
  const auto o = synthetic::observer("viscosity_to_plastic_work", synthetic::scene("linear", "elastic"));
  o->row(energies(8, 1, 0));
  EXPECT_TRUE(std::isnan(o->value())) << "nothing has yielded";
  o->row(energies(2, 3, 4));
  EXPECT_DOUBLE_EQ(o->value(), .75);
}

TEST(Heat, GoesOnAfterARestart)
{
  const input::Scene s     = synthetic::scene("linear", "elastic");
  const auto         first = synthetic::observer("kinetic_energy_kept", s);
  first->row(energies(8, 0, 0));
  io::MemoryArchive archive;
  first->save(archive, "o");
  const auto second = synthetic::observer("kinetic_energy_kept", s);
  second->load(archive, "o");
  second->row(energies(2, 0, 0));
  EXPECT_DOUBLE_EQ(second->value(), .25);
}
} // namespace
} // namespace ogive::coupling
