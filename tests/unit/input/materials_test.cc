// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "core/input/reader.h"
#include "tests/unit/input/scene_text.h"

#include <gtest/gtest.h>

namespace ogive::input
{
namespace
{
// the definition of the benchmark: E 117 GPa, nu .35, rho 8930, Y 400 MPa, H 100 MPa
TEST(Materials, ReadsTheBenchmarkCopper)
{
  const materials::Parameters p = read_material("copper-benchmark");
  EXPECT_EQ(p.name, "copper-benchmark");
  EXPECT_EQ(p.density, 8930);
  EXPECT_EQ(p.young_modulus, 117e9);
  EXPECT_EQ(p.strength.law, "linear-hardening");
  EXPECT_EQ(p.strength.yield_stress, 400e6);
  EXPECT_EQ(p.strength.hardening_modulus, 100e6);
  // isotropic elasticity: G = E/(2(1+nu)), K = E/(3(1-2nu))
  EXPECT_DOUBLE_EQ(p.shear_modulus, 117e9 / 2.7);
  EXPECT_NEAR(p.eos.bulk_modulus, 117e9 / .9, 1e-14 * 117e9 / .9);
  ASSERT_FALSE(p.sources.empty());
  EXPECT_EQ(p.sources.front().entry, "density");
  EXPECT_EQ(p.sources.front().kind, "code");
  ASSERT_FALSE(p.ranges.empty());
  EXPECT_EQ(p.ranges.front().what, "plastic strain");
  EXPECT_EQ(p.ranges.front().high, 4);
}

TEST(Materials, EveryFileOfTheLibraryReads)
{
  const std::vector<std::string> names = list_materials();
  ASSERT_FALSE(names.empty());
  for (const std::string &name : names)
    EXPECT_NO_THROW(read_material(name)) << name;
}

TEST(Materials, UnknownNameSuggestsTheNearest)
{
  try
  {
    read_material("copper-benchmrak");
    FAIL();
  }
  catch (const InputError &e)
  {
    EXPECT_NE(std::string(e.what()).find("did you mean \"copper-benchmark\"?"), std::string::npos) << e.what();
  }
}

TEST(Materials, WhatALawMissesIsReportedInTheFile)
{
  const std::string file = testing::write_file("mud.prm", "set density = 2 g/cm^3\n"
                                                          "set young modulus = 1 GPa\n"
                                                          "set poisson ratio = 0.2\n"
                                                          "subsection EOS\n"
                                                          "  set law = mie-grueneisen\n"
                                                          "  set slope = 1.5\n"
                                                          "end\n"
                                                          "subsection Strength\n"
                                                          "  set law = elastic\n"
                                                          "end\n");
  try
  {
    read_material_file(file);
    FAIL();
  }
  catch (const InputError &e)
  {
    const std::string message = e.what();
    EXPECT_EQ(message.find(file + ":4: \"EOS/"), 0u) << message;
    EXPECT_NE(message.find("missing"), std::string::npos) << message;
  }
}

TEST(Materials, ContradictingElasticConstantsAreRefused)
{
  const std::string file = testing::write_file("mud.prm", "set density = 2 g/cm^3\n"
                                                          "set young modulus = 1 GPa\n"
                                                          "set poisson ratio = 0.2\n"
                                                          "set shear modulus = 1 GPa\n"
                                                          "subsection EOS\n"
                                                          "  set law = linear\n"
                                                          "end\n"
                                                          "subsection Strength\n"
                                                          "  set law = elastic\n"
                                                          "end\n");
  try
  {
    read_material_file(file);
    FAIL();
  }
  catch (const InputError &e)
  {
    EXPECT_EQ(std::string(e.what()).find(file + ":4: \"shear modulus\""), 0u) << e.what();
  }
}
} // namespace
} // namespace ogive::input
