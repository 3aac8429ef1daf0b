// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ledger.h"

#include "hand_made.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace ogive::coupling
{
namespace
{
Balance some_balance(double scale)
{
  Balance b;
  b.mass                = 3 * scale;
  b.momentum            = scale * Vec3(1, -2, 5);
  b.angular_momentum    = scale * Vec3(.3, 7, -1);
  b.kinetic             = 101 * scale;
  b.elastic             = 13 * scale;
  b.plastic_work        = 29 * scale;
  b.thermal             = 26 * scale;
  b.viscosity_heat      = 3 * scale;
  b.bulk_viscosity_heat = 2 * scale;
  b.hourglass_fem       = .5 * scale;
  b.hourglass_sph       = .25 * scale;
  b.external_work       = 17 * scale;
  b.wall_loss           = 1.5 * scale;
  b.friction_heat       = .75 * scale;
  b.absorbed            = 4 * scale;
  b.eroded_energy       = 21 * scale;
  b.eroded_mass         = .5 * scale;
  b.eroded_momentum     = scale * Vec3(0, 0, 2);
  return b;
}
} // namespace

TEST(Ledger, AddsUpWhatItSays)
{
  CouplingBalance c;
  c.contact_stored  = 6;
  c.friction_heat   = 9;
  c.contact_loss    = 1000; // memo
  c.interface_work  = 2000; // memo
  c.conversion_heat = 40;
  c.contact_eroded  = 3;
  const LedgerRow row = ledger_row(some_balance(2), some_balance(5), c);
  // 7 (101 + 13 + 29 + 3 + 2 + .5 + .25 + 1.5 + .75 + 4 + 21) + 6 + 9 + 40 + 3
  EXPECT_NEAR(row.total, 7 * 176. + 58, 1e-12 * row.total);
  EXPECT_DOUBLE_EQ(row.friction, 7 * .75 + 9);
  EXPECT_DOUBLE_EQ(row.thermal, 7 * 26.);
  EXPECT_DOUBLE_EQ(row.momentum[2], 49);
  EXPECT_DOUBLE_EQ(row.mass, 24.5);
  EXPECT_DOUBLE_EQ(row.eroded_mass, 3.5);
}

TEST(Ledger, ColumnsAreDistinctAndMatchTheValues)
{
  const auto                  names = LedgerRow::columns();
  const std::set<std::string> distinct(names.begin(), names.end());
  LedgerRow                   row;
  row.kinetic            = 1;
  row.gradient_fallbacks = 9;
  EXPECT_EQ(distinct.size(), names.size());
  ASSERT_EQ(row.values().size(), names.size());
  EXPECT_EQ(names.front(), "kinetic [J]");
  EXPECT_EQ(row.values().front(), 1);
  EXPECT_EQ(row.values().back(), 9);
}

TEST(Ledger, RemembersTheMostFallbacks)
{
  Ledger  ledger;
  Balance particles = some_balance(1);
  for (const double count : {2., 7., 3.})
  {
    particles.gradient_fallbacks = count;
    LedgerRow row                = ledger_row({}, particles, {});
    ledger.enter(row);
    EXPECT_EQ(row.gradient_fallbacks, count);
  }
  EXPECT_EQ(ledger.most_fallbacks(), 7);
}

// Work done on the bodies is not drift; what is missing beyond it is.
TEST(Ledger, DriftIsWhatExternalWorkDoesNotExplain)
{
  Ledger    ledger;
  Balance   fem = some_balance(1);
  LedgerRow row = ledger_row(fem, {}, {});
  ledger.enter(row);
  EXPECT_EQ(row.drift, 0);
  fem.external_work += 50;
  fem.kinetic += 50;
  row = ledger_row(fem, {}, {});
  ledger.enter(row);
  EXPECT_NEAR(row.drift, 0, 1e-15);
  fem.plastic_work -= 3.02; // reference: kinetic 151
  row = ledger_row(fem, {}, {});
  ledger.enter(row);
  EXPECT_NEAR(row.drift, -.02, 1e-15);
  EXPECT_EQ(ledger.fault(.021), "");
  EXPECT_NE(ledger.fault(.019), "");
  // The reference is the largest so far: slowing down does not enlarge the drift.
  fem.kinetic -= 140;
  fem.elastic += 140;
  row = ledger_row(fem, {}, {});
  ledger.enter(row);
  EXPECT_NEAR(row.drift, -3.02 / (151 + 3.02 + 33.73), .003);
  EXPECT_NEAR(ledger.worst_drift(), -.02, 1e-15);
}

TEST(Ledger, NamesTheCulprit)
{
  const auto fault = [](Balance fem, Balance sph, const CouplingBalance &coupling) {
    Ledger    ledger;
    LedgerRow row = ledger_row(some_balance(1), some_balance(1), {});
    ledger.enter(row);
    row = ledger_row(fem, sph, coupling);
    ledger.enter(row);
    return ledger.fault(.01);
  };
  const Balance same = some_balance(1);
  Balance       more = same;
  more.elastic += 30;
  EXPECT_NE(fault(more, same, {}).find("elements"), std::string::npos);
  EXPECT_NE(fault(same, more, {}).find("particles"), std::string::npos);

  CouplingBalance contact; // takes 40 J from the elements and keeps none
  contact.contact_taken = contact.contact_loss = 40;
  contact.work_on_mesh                         = -40;
  Balance slower                               = same;
  slower.kinetic -= 40;
  EXPECT_NE(fault(slower, same, contact).find("contact_loss"), std::string::npos);

  CouplingBalance seam; // gives the particles 40 J that nobody lost
  seam.work_on_particles = seam.interface_work = 40;
  Balance faster                               = same;
  faster.kinetic += 40;
  EXPECT_NE(fault(same, faster, seam).find("interface_work"), std::string::npos);
}

TEST(Ledger, SaysWhichColumnIsNotANumber)
{
  Ledger    ledger;
  Balance   fem = some_balance(1);
  LedgerRow row = ledger_row(fem, {}, {});
  ledger.enter(row);
  fem.hourglass_fem = std::numeric_limits<double>::quiet_NaN();
  row               = ledger_row(fem, {}, {});
  ledger.enter(row);
  EXPECT_NE(ledger.fault(1e9).find("hourglass_fem"), std::string::npos);
}

TEST(Ledger, RestartGoesOnWithTheSameBooks)
{
  Ledger                   ledger, again;
  hand_made::MemoryArchive archive;
  LedgerRow                row = ledger_row(some_balance(1), {}, {});
  ledger.enter(row);
  row = ledger_row(some_balance(1.3), some_balance(.1), {});
  ledger.enter(row);
  ledger.save(archive, "run");
  again.load(archive, "run");
  EXPECT_EQ(again.fault(1e-6), ledger.fault(1e-6));
  LedgerRow next = ledger_row(some_balance(.7), {}, {}), same = next;
  ledger.enter(next);
  again.enter(same);
  EXPECT_EQ(next.drift, same.drift);
  EXPECT_EQ(again.worst_drift(), ledger.worst_drift());
}
} // namespace ogive::coupling
