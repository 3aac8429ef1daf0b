// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "core/input/reader.h"
#include "tests/unit/input/scene_text.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace ogive::input::testing
{
namespace
{
/// A folder of this process that goes away with it.
struct Scratch
{
  const std::filesystem::path path =
    std::filesystem::temp_directory_path() / ("ogive-scenes-" + std::to_string(::getpid()));
  ~Scratch()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};
} // namespace

std::string write_file(const std::string &name, const std::string &text)
{
  static const Scratch        scratch;
  static int                  count = 0;
  const ::testing::TestInfo  *test  = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
    scratch.path / test->test_suite_name() / test->name() / std::to_string(count++);
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  std::ofstream(path) << text;
  return path;
}

std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
    throw std::logic_error("the base scene lacks: " + from);
  return text.replace(at, from.size(), to);
}

int line_of(const std::string &text, const std::string &fragment)
{
  const std::size_t at = text.find(fragment);
  if (at == std::string::npos)
    return 0;
  // a fragment that spans lines points at its last one
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + at + fragment.size(), '\n'));
}

namespace
{
std::string message_of(const std::string &file, const std::vector<std::string> &overrides = {})
{
  try
  {
    read_scene(file, overrides);
  }
  catch (const InputError &e)
  {
    return e.what();
  }
  return "";
}

void expect_part(const std::string &message, const std::string &part)
{
  EXPECT_NE(message.find(part), std::string::npos) << "message: " << message << "\nlacks: " << part;
}

TEST(WrongScenes, TheBaseIsGood)
{
  EXPECT_EQ(message_of(write_file("scene.prm", base_scene)), "");
}

// Each scene differs from the good one by one edit; the place it must name is
// looked up in the edited text itself.
TEST(WrongScenes, EachIsNamedWithItsPlace)
{
  ASSERT_GE(wrong_scene_count, 50u);
  for (std::size_t i = 0; i < wrong_scene_count; ++i)
  {
    const WrongScene &w = wrong_scenes[i];
    SCOPED_TRACE(w.what);
    const std::string text    = replaced(base_scene, w.from, w.to);
    const std::string file    = write_file("scene.prm", text);
    const std::string message = message_of(file);
    ASSERT_NE(message, "") << "the scene was accepted";
    std::string place = file;
    if (*w.at)
    {
      ASSERT_GT(line_of(text, w.at), 0);
      place += ":" + std::to_string(line_of(text, w.at));
    }
    expect_part(message, place);
    expect_part(message, "\"" + std::string(w.entry) + "\"");
    expect_part(message, w.says);
    expect_part(message, w.hint);
  }
}

TEST(WrongScenes, OverridesAreCheckedTheSameWay)
{
  const std::string file = write_file("scene.prm", base_scene);
  expect_part(message_of(file, {"Bodies/zone/method=mixed"}), "--set: \"Bodies/zone/method\": \"mixed\" is not known");
  expect_part(message_of(file, {"Bodies/zone/metod=fem"}), "did you mean \"method\"?");
  expect_part(message_of(file, {"Bodies/zoen/method=fem"}), "did you mean \"Bodies/zone\"?");
  expect_part(message_of(file, {"end time"}), "no \"=\"");
  expect_part(message_of(file, {"end time=-1 s"}), "--set: \"end time\": \"-1 s\" is out of bounds");
}

TEST(WrongScenes, MissingFile)
{
  expect_part(message_of("nowhere/scene.prm"), "nowhere/scene.prm: there is no such file");
}

std::string flat_scene(const std::string &dimension, const std::string &body, const std::string &top = "")
{
  return "set dimension = " + dimension + "\nset end time = 1 ms\nset bodies = a\n" + top +
         "subsection Bodies\n  subsection a\n    set material = copper-benchmark\n    set method = fem\n"
         "    set spacing = 1 mm\n" +
         body + "  end\nend\n";
}

// Lower dimensions: what a shape, an axis, a velocity or a spin may be there.
TEST(WrongScenes, OfLowerDimensions)
{
  const std::string bar  = "set shape = box\nset lower = 0, 0 mm\nset upper = 9, 30 mm\nset velocity = 0, -9 m/s\n";
  const std::string rod  = "set shape = cylinder\nset base = 0, 0 mm\nset radius = 9 mm\nset length = 30 mm\n"
                           "set velocity = 0, -9 m/s\n";
  const std::string line = "set shape = box\nset lower = 0 mm\nset upper = 30 mm\nset velocity = 3 m/s\n";
  for (const auto &[dimension, body] :
       {std::pair{"plane-strain", bar}, std::pair{"axisymmetric", bar}, std::pair{"axisymmetric", rod},
        std::pair{"uniaxial", line}, std::pair{"plane-strain", bar + "set spin = 100 rad/s\n"}})
    EXPECT_EQ(message_of(write_file("a.prm", flat_scene(dimension, body))), "");

  struct Wrong
  {
    std::string dimension, body, entry, says, top;
  };
  const Wrong wrong[] = {
    {"uniaxial", "set shape = sphere\nset base = 0 m\nset radius = 9 mm\n", "Bodies/a/shape", "no round", ""},
    {"uniaxial", "set shape = box\nset lower = 0 mm\nset upper = 0 mm\n", "Bodies/a/upper", "empty", ""},
    {"uniaxial", line + "set spin = 3 1/s\n", "Bodies/a/spin", "out of its space", ""},
    {"uniaxial", replaced(line, "3 m/s", "3, 1, 0 m/s"), "Bodies/a/velocity", "out of the space", ""},
    {"plane-strain", rod, "Bodies/a/shape", "no meaning", ""},
    {"axisymmetric", bar + "set velocity field = twist\nset field speed = 9 m/s\n", "Bodies/a/velocity field", "twists", ""},
    {"axisymmetric", bar + "set velocity field = bend\nset field speed = 9 m/s\n", "Bodies/a/velocity field",
     "x is the radius", ""},
    {"plane-strain", bar + "set velocity field = radial-inverse\nset field speed = 9 m/s\n",
     "Bodies/a/velocity field", "round body", ""},
    {"plane-strain", replaced(bar, "-9 m/s", "-9, 2 m/s"), "Bodies/a/velocity", "out of the space", ""},
    {"plane-strain", bar, "symmetry planes", "no plane \"z\"", "set symmetry planes = z\n"},
    {"axisymmetric", bar, "symmetry planes", "no plane \"x\"", "set symmetry planes = x\n"},
    {"axisymmetric", replaced(bar, "lower = 0, 0 mm", "lower = -1, 0 mm"), "Bodies/a/lower", "beyond the axis", ""},
    {"axisymmetric", replaced(rod, "base = 0, 0 mm", "base = 1, 0 mm"), "Bodies/a/base", "off the axis", ""},
    {"axisymmetric", rod + "set axis = 1, 0\n", "Bodies/a/axis", "not that of the scene", ""},
    {"axisymmetric", replaced(rod, "0, -9 m/s", "1, -9 m/s"), "Bodies/a/velocity", "x is the radius", ""},
    {"axisymmetric", rod + "set spin = 0, 3, 0 1/s\n", "Bodies/a/spin", "out of its space", ""}};
  for (const Wrong &w : wrong)
  {
    const std::string message = message_of(write_file("a.prm", flat_scene(w.dimension, w.body, w.top)));
    expect_part(message, "\"" + w.entry + "\"");
    expect_part(message, w.says);
  }
}
} // namespace
} // namespace ogive::input::testing
