// SPDX-License-Identifier: LGPL-2.1-or-later
// Each rule holds for this repository, and finds what breaks it in a small
// tree made for the purpose.
#include "tests/policy/rules.h"

#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace
{
using namespace ogive::policy;

const Root repository = OGIVE_SOURCE_DIR;

std::string listed(const Violations &violations)
{
  std::string text;
  for (const std::string &v : violations)
    text += v + "\n";
  return text;
}

class Tree : public ::testing::Test
{
protected:
  Tree()
    : root_(std::filesystem::temp_directory_path() /
            ("ogive-tree-" + std::to_string(::getpid()) + "-" +
             ::testing::UnitTest::GetInstance()->current_test_info()->name()))
  {}
  ~Tree() override { std::filesystem::remove_all(root_); }

  void add(const std::string &file, const std::string &text) const
  {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  Root root_;
};

TEST_F(Tree, IncludesFollowTheGraph)
{
  EXPECT_EQ(listed(includes_against_the_graph(repository)), "");

  add("core/base/a.h", "#include <vector>\n#include <Eigen/Core>\n#include \"core/base/b.h\"\n#include \"core/input/c.h\"\n");
  add("core/materials/eos/a.h", "#include <deal.II/base/tensor.h>\n#include \"core/base/b.h\"\n");
  add("core/io/a.cc", "#include <hdf5.h>\n  #  include \"fem/solver.h\"\n");
  add("sph/a.h", "#include \"fem/solver.h\"\n#include \"core/base/b.h\"\n");
  add("fem/a.cc", "#include \"sph/solver.h\"\n");
  add("coupling/a.cc", "#include \"apps/run.h\"\n#include \"fem/solver.h\"\n");
  add("apps/a.cc", "#include \"coupling/run.h\"\n#include \"commit.h\"\n");
  add("tests/a.cc", "#include \"apps/run.h\"\n");
  EXPECT_EQ(listed(includes_against_the_graph(root_)),
            "core/base/a.h: includes core/input/c.h\n"
            "core/io/a.cc: includes fem/solver.h\n"
            "core/materials/eos/a.h: includes <deal.II/base/tensor.h>\n"
            "coupling/a.cc: includes apps/run.h\n"
            "fem/a.cc: includes sph/solver.h\n"
            "sph/a.h: includes fem/solver.h\n");
}

TEST_F(Tree, ParameterHandlerStaysWithTheInput)
{
  EXPECT_EQ(listed(parameter_handlers_out_of_place(repository)), "");

  add("core/input/reader.cc", "ParameterHandler prm;\n");
  add("sph/sph_parameters.cc", "ParameterHandler prm;\n");
  add("sph/solver.h", "// knows no ParameterHandler\n");
  add("fem/solver.h", "void declare(dealii::ParameterHandler &);\n");
  add("coupling/run.cc", "#include <deal.II/base/parameter_handler.h>\n");
  EXPECT_EQ(listed(parameter_handlers_out_of_place(root_)),
            "coupling/run.cc: sees ParameterHandler\nfem/solver.h: sees ParameterHandler\n");
}

TEST_F(Tree, EverySourceIsBuilt)
{
  EXPECT_EQ(listed(sources_left_out_of_the_build(repository)), "");

  add("sph/CMakeLists.txt", "ogive_library(sph SOURCES a.cc another.cc kernels/k.cc\n  # left.cc\n)\n");
  for (const char *file : {"sph/a.cc", "sph/another.cc", "sph/kernels/k.cc", "sph/other.cc", "sph/left.cc", "sph/kernels/a.cc", "tests/unit/x_test.cc"})
    add(file, "");
  EXPECT_EQ(listed(sources_left_out_of_the_build(root_)),
            "sph/kernels/a.cc: in no CMakeLists.txt\n"
            "sph/left.cc: in no CMakeLists.txt\n"
            "sph/other.cc: in no CMakeLists.txt\n"
            "tests/unit/x_test.cc: in no CMakeLists.txt\n");
}

TEST_F(Tree, ScenesAreComplete)
{
  EXPECT_EQ(listed(incomplete_scenes(repository)), "");

  add("apps/scenes/good/scene.prm", "");
  add("apps/scenes/good/README.md", "");
  add("apps/scenes/bad/scene.prm", "");
  EXPECT_EQ(listed(incomplete_scenes(root_)), "apps/scenes/bad: no README.md\n");
}

TEST_F(Tree, ReadmeCommandsAreThoseOfTheScripts)
{
  EXPECT_EQ(listed(readme_commands_unknown_to_the_scripts(repository)), "");

  add("demo", "cmake --preset release\n");
  add("README.md", "```sh\n./demo  # shows\n./dmo\nbuild/release/ogive reference\ncmake --preset release\ncmake --preset fast\n```\n"
                   "```\nmake\n```\nmake\n");
  EXPECT_EQ(listed(readme_commands_unknown_to_the_scripts(root_)),
            "README.md: \"./dmo\" is in no script\nREADME.md: \"cmake --preset fast\" is in no script\n");
}

TEST_F(Tree, FilesStayShort)
{
  EXPECT_EQ(listed(overlong_files(repository)), "");

  std::string lines;
  for (int i = 0; i < 499; ++i)
    lines += "//\n";
  add("fem/short.h", lines);
  add("fem/long.h", lines + "//\n");
  EXPECT_EQ(listed(overlong_files(root_)), "fem/long.h: 500 lines\n");
}

TEST_F(Tree, FilesNameTheirLicence)
{
  EXPECT_EQ(listed(files_without_licence(repository)), "");

  add("fem/good.h", "// SPDX-License-Identifier: LGPL-2.1-or-later\n");
  add("fem/bad.h", "#pragma once\n");
  EXPECT_EQ(listed(files_without_licence(root_)), "fem/bad.h: no licence on top\n");
}
} // namespace
