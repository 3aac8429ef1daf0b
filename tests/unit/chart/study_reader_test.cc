// SPDX-License-Identifier: LGPL-2.1-or-later
// Good studies are read; each slip is answered with file, line and a suggestion.
#include "apps/chart/rows.h"
#include "apps/chart/study_reader.h"
#include "tests/unit/io/scratch.h"

#include <cmath>

using namespace ogive;
using namespace ogive::chart;

namespace
{
class StudyFile : public test::Scratch
{
protected:
  /// The study with one text replaced; the lines are counted from its first.
  Study read(const std::string &from = {}, const std::string &to = {}) const
  {
    std::string text = "set axes = method, alpha\n"                                        // 1
                       "set cases = bar\n"                                                 // 2
                       "set charts = c\n"                                                  // 3
                       "set row limit = 2 s\n"                                             // 4
                       "subsection Axes\n"                                                 // 5
                       " subsection method\n"                                              // 6
                       "  set levels = fem, sph\n"                                         // 7
                       "  set overrides = Bodies/bar/method={}\n"                          // 8
                       " end\n"                                                            // 9
                       " subsection alpha\n"                                               // 10
                       "  set levels = .5, 1\n"                                            // 11
                       "  set overrides = SPH/alpha={}\n"                                  // 12
                       "  subsection .5\n"                                                 // 13
                       "   set only with = method=sph\n"                                   // 14
                       "  end\n end\nend\n"                                                // 15-17
                       "subsection Cases\n subsection bar\n"                               // 18, 19
                       "  set scene = " OGIVE_SOURCE_DIR "/apps/scenes/elastic-bar/scene.prm\n" // 20
                       "  set quantities = contact_time, energy_drift\n"                   // 21
                       "  subsection Quantities\n   subsection contact_time\n"             // 22, 23
                       "    set reference = 34 us\n    set kind = code\n    set source = a test\n" // 24-26
                       "    set at most = 35 us\n"                                         // 27
                       "   end\n  end\n end\nend\n"                                        // 28-31
                       "subsection Charts\n subsection c\n"                                // 32, 33
                       "  set x = axis alpha\n"                                            // 34
                       "  set y = error of contact_time\n"                                 // 35
                       " end\nend\n";
    if (const std::size_t at = text.find(from); !from.empty())
    {
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    test::write_bytes(in("s.prm"), text);
    return read_study(in("s.prm"));
  }

  void refuses(const std::string &from, const std::string &to, std::initializer_list<const char *> parts) const
  {
    test::expect_parts(test::message_of<InputError>([&] { read(from, to); }), parts);
  }
};
} // namespace

TEST_F(StudyFile, IsRead)
{
  const Study s = read();
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.row_limit, 2);
  EXPECT_EQ(s.axes[1].levels[0].number, .5); // by its name
  EXPECT_TRUE(std::isnan(s.axes[0].levels[0].number));
  EXPECT_EQ(s.cases[0].title, "Elastic bar on a rigid wall");
  ASSERT_EQ(s.cases[0].quantities.size(), 2u);
  EXPECT_NEAR(s.cases[0].quantities[0].reference, 34e-6, 1e-18);
  EXPECT_FALSE(s.cases[0].quantities[1].observed); // a check of the summary
  EXPECT_EQ(s.charts[0].series, std::vector<std::string>{"method"});
  EXPECT_EQ(expand(s).rows.size(), 3u);
  EXPECT_EQ(expand(s).rows[0].name, "bar+fem+1");
}

TEST_F(StudyFile, SaysWhatMapsShow)
{
  const Study s = read("  set quantities = contact_time, energy_drift\n",
                       "  set group = waves\n  set quantities = contact_time, energy_drift\n"
                       "  subsection Axes\n   subsection method\n"
                       "    set does not apply at fem = no mesh\n   end\n  end\n");
  EXPECT_EQ(s.cases[0].group, "waves");
  const auto why = [&](std::size_t level) { return why_not(s.axes[0], s.cases[0].axes[0], s.axes[0].levels[level]); };
  ASSERT_NE(why(0), nullptr);
  EXPECT_EQ(*why(0), "no mesh");
  EXPECT_EQ(why(1), nullptr);
  EXPECT_EQ(expand(s).rows.size(), 2u); // both of particles
  EXPECT_EQ(expand(s).skipped, 2u);
  const Study sourced = read("set at most = 35 us", "set at most = 35 us\n    set bound source = a bar");
  EXPECT_EQ(sourced.cases[0].quantities[0].bound_source, "a bar");
  refuses("  set quantities = contact_time, energy_drift\n",
          "  set quantities = contact_time, energy_drift\n"
          "  subsection Axes\n   subsection method\n    set does not apply at fen = x\n   end\n  end\n",
          {"s.prm:24", "does not apply at fem"});
}

TEST_F(StudyFile, SlipsAreAnswered)
{
  refuses("set levels = fem, sph", "set levels = fem, sph, fem", {"s.prm:7", "\"fem\" is listed twice"});
  refuses("subsection .5", "subsection .55", {"s.prm:13", "unknown subsection"});
  refuses("set only with = method=sph", "set like = 1", {"s.prm:14", "no level \"1\" before this one"});
  refuses("set only with = method=sph", "set only with = metod=sph", {"s.prm:14", "no axis \"metod\"", "\"method\""});
  refuses("set only with = method=sph", "set only with = method=shp", {"s.prm:14", "no level \"shp\"", "\"sph\""});
  refuses("set quantities = contact_time,", "set quantities = contact_tim,",
          {"s.prm:21", "\"contact_tim\" is not known here", "\"contact_time\""});
  refuses("set reference = 34 us", "set reference = 34 mm", {"s.prm:24", "a time"});
  refuses("set kind = code\n", "", {"kind", "missing"});
  refuses("error of contact_time", "error of contact_tme", {"s.prm:35", "\"contact_time\""});
  refuses("x = axis alpha", "x = axis alfa", {"s.prm:34", "no axis \"alfa\"", "\"alpha\""});
  refuses("set charts = c\n", "set charts = c, d\n", {"\"Charts/d", "missing"});
  refuses("set y = error of contact_time", "set y = error of contact_time\n  set cases = bra",
          {"s.prm:36", "\"bra\" is not known here", "\"bar\""});
  refuses("elastic-bar/scene.prm", "elastic-bar/scenes.prm", {"s.prm:20", "there is no file"});
  refuses("set axes = method, alpha", "set axes = method, work", {"s.prm:1"});
  refuses("set row limit = 2 s", "set row limit = 2", {"s.prm:4", "has no unit"});
}

TEST_F(StudyFile, OverridesAreTriedOnTheScene)
{
  const Study s = read("SPH/alpha={}", "SPH/alfa={}");
  const Row   row = expand(s).rows[0];
  test::expect_parts(
    test::message_of<InputError>([&] { read_variant(s.cases[0].scene, row.overrides, "row \"" + row.name + "\""); }),
    {"s.prm:12", "SPH/alfa=1", "did you mean \"alpha\"?", "row \"bar+fem+1\""});
  // those of the case at once, since its quantities hang on them
  refuses("set quantities =", "set overrides = Bodies/bar/velocty=3 m/s\n  set quantities =",
          {"s.prm:21", "did you mean \"velocity\"?", "case \"bar\""});
}

TEST_F(StudyFile, ReferenceTellsEveryEntry)
{
  const std::string text = reference();
  for (const char *word : {"row limit", "only with", "overrides at LEVEL", "does not apply at LEVEL", "bound source",
                           "error at most", "y scale", "Maps/MAP"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
  EXPECT_EQ(text.find("| `AXIS` |"), std::string::npos); // an example, no default
}
