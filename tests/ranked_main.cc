// SPDX-License-Identifier: LGPL-2.1-or-later
// All ranks run the same cases. The first one prints; another does as soon as a
// check of its own fails. The run fails if any rank does.
#include "core/parallel/ranks.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace
{
/// Keeps still until something fails.
class Silent : public testing::EmptyTestEventListener
{
public:
  explicit Silent(int rank) : rank_(rank) {}
  void OnTestPartResult(const testing::TestPartResult &result) override
  {
    if (result.failed())
      std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, result.file_name() ? result.file_name() : "?",
                   result.line_number(), result.summary());
  }

private:
  int rank_;
};
} // namespace

int main(int argc, char *argv[])
{
  testing::InitGoogleTest(&argc, argv);
  const ogive::Ranks ranks = ogive::Ranks::world();
  if (!ranks.first())
  {
    auto &listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Silent(ranks.rank()));
  }
  return ranks.any(RUN_ALL_TESTS() != 0) ? 1 : 0;
}
