// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "tests/verification/coupling/support.h"

/// Whole bodies that overlap at the start.
namespace ogive::coupling
{
namespace
{
using input::Dimension;
using input::Method;

/// A slab and a block on it that is drawn .2 mm too low; spacing 1 mm.
input::Scene sunken(Method slab, Method block, const std::string &overlap)
{
  auto scene = scenes::steel_scene(Dimension::plane_strain);
  scenes::add_box(scene, "slab", slab, {-10e-3, -4e-3, 0}, {10e-3, 0, 0}, 1e-3, Vec3::Zero());
  scenes::add_box(scene, "block", block, {-3.3e-3, -.2e-3, 0}, {2.7e-3, 3.8e-3, 0}, 1e-3, Vec3::Zero());
  scene.contacts.push_back({"touch", "slab", "block", 0, .1, overlap});
  return scene;
}
} // namespace

// Healed or left at rest, nothing is strained and nothing moves. Where the contact is
// between surfaces, the points are moved by the .2 mm that they are too low, or by half of
// it on each side where both sides' points are moved; fields of particles give by about that.
TEST(Overlap, HealedBodiesAreAtRestAndUnstrained)
{
  for (const Method slab : {Method::fem, Method::sph})
    for (const Method block : {Method::fem, Method::sph})
      for (const char *way : {"heal", "rest"})
      {
        SCOPED_TRACE(std::string(way) + (slab == Method::fem ? ", mesh" : ", particles") +
                     (block == Method::fem ? ", mesh" : ", particles"));
        scenes::Driver<2> run(sunken(slab, block, way));
        const auto        overlaps = run.model.initial_overlaps();
        ASSERT_FALSE(overlaps.empty());
        const bool heal = std::string(way) == "heal";
        EXPECT_EQ(overlaps.front().healed, heal);
        EXPECT_GT(overlaps.front().worst, .1e-3);
        EXPECT_LT(overlaps.front().worst, .3e-3);
        if (heal)
        {
          EXPECT_EQ(overlaps.size(), 1u);
          EXPECT_GT(overlaps.front().moved, .05e-3);
          EXPECT_LT(overlaps.front().moved, .4e-3);
        }
        for (int n = 0; n < 40; ++n)
          run.step();
        const auto row = run.model.ledger();
        // A light pulse of rounding is left: 1e-7 of half a spacing into springs.
        EXPECT_LT(row.kinetic + row.elastic + row.contact, 1e-9);
        EXPECT_LT(row.momentum.norm(), 1e-12);
      }
}

TEST(Overlap, IsRefusedWithTheContactsName)
{
  try
  {
    scenes::Driver<2> run(sunken(Method::fem, Method::sph, "refuse"));
    FAIL() << "accepted";
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(error.where().entry, "Contacts/touch/overlap");
    EXPECT_NE(std::string(error.what()).find("particle"), std::string::npos);
  }
}
} // namespace ogive::coupling
