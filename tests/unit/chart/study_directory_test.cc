// SPDX-License-Identifier: LGPL-2.1-or-later
// What is known of a row, and when it no longer holds.
#include "apps/chart/study_directory.h"
#include "tests/unit/io/scratch.h"

using namespace ogive;
using namespace ogive::chart;

namespace
{
class Directory : public test::Scratch
{
protected:
  Outcome failed() const
  {
    Outcome o;
    o.reason = "the energy drifts";
    o.wall_s = 3;
    return o;
  }
};
} // namespace

TEST_F(Directory, RecallsWhatHolds)
{
  StudyDirectory d(in("s"));
  d.take("study");
  const Identity me{"set a = 1\n", "abc", 0};
  d.forget("r");
  EXPECT_FALSE(d.recall("r", me));
  d.record("r", me, failed());
  const auto known = d.recall("r", me);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->status, Status::failed);
  EXPECT_EQ(known->reason, "the energy drifts");
  EXPECT_FALSE(d.recall("r", {"set a = 2\n", "abc", 0})); // another scene
  EXPECT_FALSE(d.recall("r", {"set a = 1\n", "abd", 0})); // another program
  d.forget("r");
  EXPECT_FALSE(d.recall("r", me));
}

TEST_F(Directory, ARunThatTookTooLongIsTriedAgainWithMoreTime)
{
  StudyDirectory d(in("s"));
  d.take("study");
  Outcome o = failed();
  o.status  = Status::too_long;
  d.forget("r");
  d.record("r", {"x", "abc", 60}, o);
  EXPECT_TRUE(d.recall("r", {"x", "abc", 60}));
  EXPECT_TRUE(d.recall("r", {"x", "abc", 30}));
  EXPECT_FALSE(d.recall("r", {"x", "abc", 90}));
  EXPECT_FALSE(d.recall("r", {"x", "abc", 0}));
}

TEST_F(Directory, ADoneRowNeedsItsSummary)
{
  StudyDirectory d(in("s"));
  d.take("study");
  Outcome o;
  o.status = Status::done;
  d.forget("r");
  d.record("r", {"x", "abc", 0}, o);
  EXPECT_FALSE(d.recall("r", {"x", "abc", 0}));
}

TEST_F(Directory, OthersAreRefused)
{
  test::write_bytes(in("thesis.tex"), "x");
  const StudyDirectory foreign(directory());
  EXPECT_NE(test::message_of<InputError>([&] { foreign.look("a", false); }).find("--force"), std::string::npos);
  foreign.look("a", true);

  StudyDirectory d(in("s"));
  d.look("a", false); // not there yet
  d.take("a");
  d.look("a", false);
  EXPECT_NE(test::message_of<InputError>([&] { d.look("b", false); }).find("\"a\""), std::string::npos);
  StudyDirectory second(in("s"));
  EXPECT_NE(test::message_of<InputError>([&] { second.take("a"); }).find("works here"), std::string::npos);
}

TEST_F(Directory, PicturesOfChartsThatAreGoneGo)
{
  {
    StudyDirectory d(in("s"));
    d.take("a");
    d.write("old.svg", "1");
    d.write("kept.svg", "1");
    d.finish("a");
  }
  test::write_bytes(in("s/mine.txt"), "x");
  StudyDirectory d(in("s"));
  d.take("a");
  d.write("kept.svg", "2");
  d.finish("a");
  EXPECT_FALSE(std::filesystem::exists(in("s/old.svg")));
  EXPECT_TRUE(std::filesystem::exists(in("s/mine.txt")));
  EXPECT_EQ(test::bytes_of(in("s/kept.svg")), "2");
}
