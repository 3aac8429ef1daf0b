// SPDX-License-Identifier: LGPL-2.1-or-later
// A body from a mesh file is the same body as one that the program meshes.
#include "tests/app/command.h"

#include <gtest/gtest.h>

using namespace ogive::test;

namespace
{
std::string block_scene(const std::string &shape)
{
  return "set title = Block on a wall\n"
         "set dimension = 3d\nset end time = 5 us\nset bodies = block\nset walls = wall\n"
         "set boundaries = held\nset observers = final_length, peak_stress\n"
         "subsection Bodies\n subsection block\n" +
         shape +
         "  set material = copper-benchmark\n  set method = fem\n  set spacing = 2.5 mm\n"
         "  set velocity = 0, 0, -100 m/s\n end\nend\n"
         "subsection Walls\n subsection wall\n  set point = 0, 0, 0 mm\n  set normal = 0, 0, 1\n end\nend\n"
         "subsection Observers\n subsection final_length\n  set body = block\n  set direction = 0, 0, 1\n end\n"
         " subsection peak_stress\n  set body = block\n end\nend\n";
}

nlohmann::json run(const Scratch &scratch, const std::string &name, const std::string &text)
{
  write_file(scratch.path(name + ".prm"), text);
  const Outcome outcome = ogive::test::ogive({"run", scratch.path(name + ".prm"), "-o", scratch.path(name)});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return summary(scratch.path(name));
}

std::string held(const std::string &face)
{
  return "subsection Boundaries\n subsection held\n  set body = block\n  set face = " + face +
         "\n  set kind = velocity\n  set components = x, y\n  set velocity = 0, 0, 0 m/s\n end\nend\n";
}
} // namespace

TEST(MeshFile, GivesTheSameAnswerAsTheGeneratedBlock)
{
  const Scratch     scratch;
  const std::string file = std::string(OGIVE_SOURCE_DIR) + "/meshes/block.msh";
  const auto generated = run(scratch, "generated",
                             block_scene("  set shape = box\n  set lower = 0, 0, 0 mm\n  set upper = 10, 10, 10 mm\n") +
                               held("z-"));
  const auto read = run(scratch, "read", block_scene("  set shape = mesh\n  set mesh file = " + file + "\n") + held("1"));
  EXPECT_EQ(read.at("counts").at("elements"), 64);
  for (const char *name : {"final_length", "peak_stress"})
    EXPECT_NEAR(quantity(read, name) / quantity(generated, name), 1, 1e-9) << name;
}
