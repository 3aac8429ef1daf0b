// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads in time, absorbing faces, ties and coarsened meshes in one scene, by the command.
#include "tests/app/command.h"

#include <gtest/gtest.h>

using namespace ogive::test;

namespace
{
/// A coarsened cap, tied to a coarser base whose foot absorbs, takes a pulse on top.
const char *const cap_on_base = R"(set title = Pulse into the ground
set dimension = 3d
set end time = 6 us
set symmetry planes = x, y
set bodies = cap, base
set boundaries = pulse, foot
set interfaces = seam
set observers = residual_velocity
subsection Bodies
  subsection cap
    set shape = box
    set lower = -6, -6, 0 mm
    set upper = 6, 6, 4 mm
    set material = copper-benchmark
    set method = fem
    set spacing = 0.5 mm
    set coarsen = 1
    set coarsen distance = 2.5 mm
    set coarsen from = 0, 0, 4 mm
  end
  subsection base
    set shape = box
    set lower = -6, -6, -6 mm
    set upper = 6, 6, 0 mm
    set material = copper-benchmark
    set method = fem
    set spacing = 1.5 mm
  end
end
subsection Boundaries
  subsection pulse
    set body = cap
    set kind = pressure
    set face = z+
    set pressure = 20 MPa
    set history = 0 us: 0, 0.5 us: 1, 1 us: 0
  end
  subsection foot
    set body = base
    set kind = absorbing
    set face = z-
  end
end
subsection Interfaces
  subsection seam
    set slave = cap
    set master = base
  end
end
subsection Observers
  subsection residual_velocity
    set body = base
    set direction = 0, 0, -1
  end
end
subsection Output
  set checkpoint interval = 3 us
end
)";
} // namespace

TEST(Edges, PulseIsAbsorbedBelowATie)
{
  const Scratch     scratch;
  const std::string scene = scratch.path("ground.prm");
  write_file(scene, cap_on_base);
  const Outcome plan = ogive::test::ogive({"check", scene});
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_NE(plan.out.find("seam             tied, cap | base"), std::string::npos) << plan.out;
  // 6 coarse edges of 1 mm and the axes' planes: 7 x 7 nodes at the seam
  EXPECT_NE(plan.out.find("tied nodes seam             49, gap closed up to"), std::string::npos)
      << plan.out;

  const Outcome outcome = ogive::test::ogive({"run", scene, "-o", scratch.path("out")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json s      = summary(scratch.path("out"));
  const nlohmann::json ledger = s.at("ledger");
  const double         work   = ledger.at("external_work");
  // what the pulse brought in is in the bodies, in the foot, or heat: to rounding
  EXPECT_GT(work, 0);
  EXPECT_LT(std::abs(double(s.at("checks").at("energy_drift"))), 1e-10);
  EXPECT_LT(double(s.at("checks").at("momentum_drift")), 1e-12);
  EXPECT_GT(double(ledger.at("absorbed")), .1 * work);
}

// A block strikes the seam of two tied ones; without the tie the drift is 8e-4, with
// an open surface under the seam it was 36 %.
TEST(Edges, ABlockStrikesASeam)
{
  const Scratch here;
  write_file(here.path("seam.prm"), R"(
set dimension  = plane-strain
set end time   = 20 us
set bodies     = left, right, striker
set contacts   = one, other
set interfaces = seam
subsection Bodies
  subsection left
    set shape    = box
    set lower    = 0, 0 mm
    set upper    = 10, 6 mm
    set material = steel-elastic
    set method   = fem
    set spacing  = 1 mm
  end
  subsection right
    set shape    = box
    set lower    = 10, 0 mm
    set upper    = 20, 6 mm
    set material = steel-elastic
    set method   = fem
    set spacing  = 1 mm
  end
  subsection striker
    set shape    = box
    set lower    = 6.3, 6.1 mm
    set upper    = 13.3, 12.1 mm
    set material = steel-elastic
    set method   = fem
    set spacing  = 1 mm
    set velocity = 0, -60 m/s
  end
end
subsection Contacts
  subsection one
    set between = left, striker
  end
  subsection other
    set between = right, striker
  end
end
subsection Interfaces
  subsection seam
    set slave  = left
    set master = right
  end
end
)");
  const auto o = ogive::test::ogive({"run", here.path("seam.prm"), "-o", here.path("out")});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_LT(check(summary(here.path("out")), "energy_drift"), 3e-3);
  EXPECT_LT(check(summary(here.path("out")), "momentum_drift"), 1e-12);
}
