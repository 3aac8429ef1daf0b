// SPDX-License-Identifier: LGPL-2.1-or-later
// What one rank meets, all meet, as the same kind of error.
#include "core/parallel/together.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

using namespace ogive;

namespace
{
/// The message of the InputError or RunError that f throws, after "input: " or "run: ".
template <class F>
std::string thrown(F &&f)
{
  try
  {
    f();
  }
  catch (const InputError &e)
  {
    return "input: " + std::string(e.what());
  }
  catch (const RunError &e)
  {
    return "run: " + std::string(e.what());
  }
  return "nothing";
}

const InputError::Where place{"a scene.prm", 12, "Bodies/bar/spacing"};
} // namespace

TEST(Together, AgreedIsSilentWhereNothingFails)
{
  int calls = 0;
  EXPECT_EQ(thrown([&] { agreed(Ranks::world(), [&] { ++calls; }); }), "nothing");
  EXPECT_EQ(calls, 1);
}

TEST(Together, ErrorOfTheLastRankIsMetByAll)
{
  const Ranks ranks = Ranks::world();
  const bool  last  = ranks.rank() == ranks.size() - 1;
  EXPECT_EQ(thrown([&] {
              agreed(ranks, [&] {
                if (last)
                  throw InputError(place, "0 mm", "a length > 0", "take 1 mm");
              });
            }),
            "input: a scene.prm:12: \"Bodies/bar/spacing\": 0 mm; expected a length > 0; take 1 mm");
  EXPECT_EQ(thrown([&] {
              agreed(ranks, [&] {
                if (last)
                  throw RunError("disk full");
              });
            }),
            "run: disk full");
}

TEST(Together, PlaceOfAnInputErrorComesAlong)
{
  const Ranks ranks = Ranks::world();
  try
  {
    on_first(ranks, [] { throw InputError(place, "0 mm"); });
    FAIL() << "nothing thrown";
  }
  catch (const InputError &e)
  {
    EXPECT_EQ(e.where().file, place.file);
    EXPECT_EQ(e.where().line, place.line);
    EXPECT_EQ(e.where().entry, place.entry);
    EXPECT_EQ(e.complaint(), "0 mm");
  }
}

TEST(Together, LowestRankSpeaksForThoseWithoutAnError)
{
  const Ranks ranks = Ranks::world();
  // all but the first fail, each with its own text; alone, it fails itself
  const std::string own = "rank " + std::to_string(ranks.rank());
  const std::string met = thrown([&] {
    agreed(ranks, [&] {
      if (ranks.alone() || !ranks.first())
        throw RunError(own);
    });
  });
  EXPECT_EQ(met, "run: " + (ranks.first() && !ranks.alone() ? std::string("rank 1") : own));
}

TEST(Together, FirstActsAloneAndTellsAll)
{
  const Ranks ranks = Ranks::world();
  int         calls = 0;
  on_first(ranks, [&] { ++calls; });
  EXPECT_EQ(calls, ranks.first() ? 1 : 0);
  EXPECT_EQ(told_by_first(ranks, [&] { return "by " + std::to_string(ranks.rank()); }), "by 0");
  EXPECT_EQ(told_by_first(ranks, [] { return std::string(); }), "");
  EXPECT_EQ(thrown([&] { told_by_first(ranks, []() -> std::string { throw RunError("no room"); }); }), "run: no room");
}
