// SPDX-License-Identifier: LGPL-2.1-or-later
// What a user sees of the certificate of seams.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
std::vector<std::string> arguments(std::vector<std::string> command, const std::string &directory,
                                   const std::vector<std::string> &settings)
{
  command.insert(command.begin() + 1, scene("elastic-bar/split.prm"));
  command.insert(command.end(), {"-o", directory});
  for (const std::string &s : settings)
    command.insert(command.end(), {"--set", s});
  return command;
}
} // namespace

TEST(Certificate, CheckPrintsTabulatesAndDraws)
{
  const Scratch scratch;
  const auto    command = arguments({"check", "--certificate"}, scratch.path("c"), {});
  const Outcome first   = ogive::test::ogive(command);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find("P from front"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("P from rear"), std::string::npos) << first.out;

  std::istringstream csv(read_file(scratch.path("c/certificate.csv")));
  std::string        line;
  std::getline(csv, line);
  EXPECT_EQ(line, "interface,method,wave,from,wavelength [m],wavelength/size,reflection");
  int rows = 0;
  for (; std::getline(csv, line); ++rows)
  {
    const double share = std::stod(line.substr(line.rfind(',') + 1));
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 1);
  }
  EXPECT_EQ(rows, 14); // seven wavelengths, either way
  EXPECT_NE(read_file(scratch.path("c/certificate.svg")).find("<svg"), std::string::npos);

  const Outcome again = ogive::test::ogive(command);
  EXPECT_EQ(again.status, 2);
  EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
}

TEST(Certificate, OfASceneWithoutSeamsIsRefused)
{
  const Outcome none = ogive::test::ogive({"check", scene("elastic-bar/scene.prm"), "--certificate"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("seam"), std::string::npos) << none.err;
  EXPECT_EQ(ogive::test::ogive({"check", scene("elastic-bar/scene.prm"), "-o", "x"}).status, 2);
}

TEST(Certificate, RunRefusesWarnsOrGoesOn)
{
  const Scratch                  scratch;
  const std::vector<std::string> strict{"end time=1 us", "Interfaces/seam/method=tied",
                                        "Interfaces/seam/reflection limit=.01"};
  auto                           settings = strict;
  settings.push_back("Interfaces/seam/certificate=check");
  const Outcome refused = ogive::test::ogive(arguments({"run"}, scratch.path("refused"), settings));
  EXPECT_EQ(refused.status, 2);
  for (const char *word : {"split.prm:", "seam", "reflection limit", "pair-flux", "certificate = warn or skip"})
    EXPECT_NE(refused.err.find(word), std::string::npos) << word << "\n" << refused.err;
  EXPECT_FALSE(fs::exists(scratch.path("refused")));

  settings.back() = "Interfaces/seam/certificate=warn";
  const Outcome warned = ogive::test::ogive(arguments({"run"}, scratch.path("warned"), settings));
  EXPECT_EQ(warned.status, 0) << warned.err;
  EXPECT_NE(warned.err.find("warning: interface \"seam\" (tied) reflects"), std::string::npos) << warned.err;
  const auto s = summary(scratch.path("warned"));
  ASSERT_EQ(s.at("certificates").size(), 1u);
  EXPECT_EQ(s.at("certificates")[0].at("interface"), "seam");
  EXPECT_GT(s.at("certificates")[0].at("worst").get<double>(), .01);

  settings.back() = "Interfaces/seam/certificate=skip";
  const Outcome skipped = ogive::test::ogive(arguments({"run"}, scratch.path("skipped"), settings));
  EXPECT_EQ(skipped.status, 0) << skipped.err;
  EXPECT_TRUE(summary(scratch.path("skipped")).at("certificates").empty());
}
