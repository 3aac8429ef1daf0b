// SPDX-License-Identifier: LGPL-2.1-or-later
// `ogive chart` on a small study of the elastic bar: what is written, that
// nothing runs twice, rows that fail, and bad input.
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
/// Two methods and two resolutions, and a drift limit that no run with a wall
/// loss could keep at the level "strict" of `rule`.
std::string study(const std::string &extra_level = "")
{
  return "set title = small\nset axes = method, cells, rule\nset cases = bar\nset charts = cost\nset maps = map\n"
         "set overrides = Output/field interval=0 s\n"
         "subsection Axes\n"
         " subsection method\n  set levels = fem, sph\n  set overrides = Bodies/bar/method={}\n end\n"
         " subsection cells\n  set levels = 20, 40\n"
         "  subsection 20\n   set overrides = Bodies/bar/spacing=5 mm\n  end\n"
         "  subsection 40\n   set overrides = Bodies/bar/spacing=2.5 mm\n  end\n end\n"
         " subsection rule\n  set levels = usual" +
         extra_level +
         "  subsection usual\n   set overrides = Limits/energy drift=0.05\n  end\n end\n"
         "end\n"
         "subsection Cases\n subsection bar\n  set scene = " +
         scene("elastic-bar/scene.prm") +
         "\n  set quantities = contact_time\n"
         "  subsection Quantities\n   subsection contact_time\n    set error at most = 0.2\n   end\n  end\n"
         " end\nend\n"
         "subsection Charts\n subsection cost\n  set x = work\n  set y = error of contact_time\n"
         "  set x scale = log\n  set y scale = log\n end\nend\n"
         "subsection Maps\n subsection map\n  set columns = method, cells\n end\nend\n";
}

/// An end before the first step is taken back as too small a step.
const std::string failing_level = ", hopeless\n"
                                  "  subsection hopeless\n   set overrides = Limits/energy drift=1e-300\n"
                                  "   set only with = method=sph, cells=20\n  end\n";

Outcome chart(const Scratch &s, std::vector<std::string> more = {})
{
  std::vector<std::string> words{"chart", s.path("study.prm"), "-o", s.path("r")};
  words.insert(words.end(), more.begin(), more.end());
  return ogive::test::ogive(words);
}

/// chart.csv without the columns of times.
std::string without_times(const std::string &directory)
{
  std::istringstream in(read_file(directory + "/chart.csv"));
  std::string        all, line;
  while (std::getline(in, line))
  {
    std::istringstream cells(line);
    std::string        cell;
    for (int i = 0; std::getline(cells, cell, ','); ++i)
      if (i != 6 && i != 7) // case, three axes, status, reason, then wall and core
        all += cell + ",";
    all += "\n";
  }
  return all;
}
} // namespace

TEST(Chart, RunsWritesAndRunsNothingTwice)
{
  const Scratch s;
  write_file(s.path("study.prm"), study("\n"));
  const Outcome first = chart(s);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.err, ""); // quiet, since this is no terminal
  EXPECT_NE(first.out.find("4 rows run now"), std::string::npos) << first.out;
  for (const char *file : {"chart.csv", "tables.md", "cost.svg", "map.svg", "rows/bar+sph+40+usual/summary.json"})
    EXPECT_TRUE(fs::exists(s.path("r/") + file)) << file;
  const std::string csv = read_file(s.path("r/chart.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  // the wall's contact time 2 L/c_L is the scene's exact reference
  EXPECT_NE(csv.find("contact_time [s]"), std::string::npos);
  EXPECT_NE(csv.find("3.4569e-05"), std::string::npos) << csv;
  EXPECT_NE(read_file(s.path("r/tables.md")).find("survived"), std::string::npos);

  const auto    time   = fs::last_write_time(s.path("r/rows/bar+fem+20+usual/summary.json"));
  const Outcome second = chart(s);
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_NE(second.out.find("0 rows run now, 4 known"), std::string::npos) << second.out;
  EXPECT_EQ(read_file(s.path("r/chart.csv")), csv);
  EXPECT_EQ(fs::last_write_time(s.path("r/rows/bar+fem+20+usual/summary.json")), time);

  // a run that was broken off is made again, and alone
  fs::remove(s.path("r/rows/bar+sph+20+usual/row.json"));
  const Outcome third = chart(s, {"--jobs", "1"});
  EXPECT_NE(third.out.find("1 rows run now, 3 known"), std::string::npos) << third.out;
  const std::string before = without_times(s.path("r"));
  const Outcome     forced = chart(s, {"--force"});
  EXPECT_NE(forced.out.find("4 rows run now"), std::string::npos) << forced.out;
  EXPECT_EQ(without_times(s.path("r")), before);
}

TEST(Chart, AFailingRowIsAResult)
{
  const Scratch s;
  write_file(s.path("study.prm"), study(failing_level));
  const Outcome run = chart(s);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("bar+sph+20+hopeless failed: "), std::string::npos) << run.out;
  const std::string csv = read_file(s.path("r/chart.csv"));
  EXPECT_NE(csv.find("bar,sph,20,hopeless,failed,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("energy"), std::string::npos) << csv;
  EXPECT_NE(read_file(s.path("r/cost.svg")).find("Not shown, failed: bar+sph+20+hopeless"), std::string::npos);
  EXPECT_NE(read_file(s.path("r/tables.md")).find("**failed 1 of 2**"), std::string::npos);
  // it failed once; it is not tried again
  EXPECT_NE(chart(s).out.find("0 rows run now, 5 known"), std::string::npos);
}

TEST(Chart, ARowBeyondItsLimitIsTooLong)
{
  const Scratch s;
  std::string   text = study("\n");
  // a thousandfold time takes far longer than the limit
  text += "set row limit = 1 s\n";
  text.replace(text.find("Bodies/bar/spacing=2.5 mm"), 25, "Bodies/bar/spacing=2.5 mm; end time=1000 s");
  write_file(s.path("study.prm"), text);
  const Outcome run = chart(s);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(read_file(s.path("r/chart.csv")).find("bar,sph,40,usual,too long,ended at the row limit of 1 s"),
            std::string::npos);
}

TEST(Chart, BadInputOfAnyRowRunsNothing)
{
  const Scratch s;
  // known only once the model stands: too many points
  std::string text = study("\n");
  text.replace(text.find("Bodies/bar/spacing=2.5 mm"), 25, "Bodies/bar/spacing=1e-12 mm");
  write_file(s.path("study.prm"), text);
  const Outcome built = chart(s);
  EXPECT_EQ(built.status, 2);
  EXPECT_NE(built.err.find("row \"bar+"), std::string::npos) << built.err;
  EXPECT_NE(built.err.find("+40+usual\""), std::string::npos) << built.err;
  EXPECT_FALSE(fs::exists(s.path("r")));

  text = study("\n");
  text.replace(text.find("Bodies/bar/spacing=5 mm"), 23, "Bodies/bar/spacin=5 mm");
  write_file(s.path("study.prm"), text);
  const Outcome read = chart(s);
  EXPECT_EQ(read.status, 2);
  for (const char *word : {"study.prm:15: ", "did you mean \"spacing\"?", "row \"bar+fem+20+usual\""})
    EXPECT_NE(read.err.find(word), std::string::npos) << word << " in\n" << read.err;
  EXPECT_FALSE(fs::exists(s.path("r")));
}

TEST(Chart, AnotherStudysDirectoryIsRefused)
{
  const Scratch s;
  fs::create_directories(s.path("r"));
  write_file(s.path("r/precious"), "x");
  write_file(s.path("study.prm"), study("\n"));
  const Outcome run = chart(s);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--force"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(s.path("r/chart.csv")));
}

TEST(Chart, ShippedStudiesAreGood)
{
  // each row's scene is read before the directory is looked at by the runs: a
  // file in its place ends the command there
  for (const auto &entry : fs::directory_iterator(std::string(OGIVE_SOURCE_DIR) + "/apps/studies"))
  {
    if (entry.path().extension() != ".prm")
      continue;
    const Scratch s;
    write_file(s.path("r"), "");
    const Outcome run = ogive::test::ogive({"chart", entry.path().string(), "-o", s.path("r")});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("it is not a directory"), std::string::npos) << run.err;
  }
}
