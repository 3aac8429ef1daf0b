// SPDX-License-Identifier: LGPL-2.1-or-later
// A program that ends in trouble on ranks, in the way it is asked to.
#include "core/parallel/together.h"

#include <cstdio>
#include <string>

int main(int, char *argv[])
{
  const ogive::Ranks ranks = ogive::Ranks::world();
  const std::string  how   = argv[1];
  const std::string  rank  = std::to_string(ranks.rank());
  if (how == "one" && ranks.rank() != 1)
    ranks.any(false); // for ever: the other one does not come
  const ogive::Ending own = how == "alike"  ? ogive::Ending{2, "no such scene"} :
                            how == "differ" ? ogive::Ending{ranks.first() ? 2 : 1, "trouble of " + rank} :
                                              ogive::Ending{2, "a stray error"};
  const ogive::Ending end = ogive::end_together(ranks, own, 1, how == "one" ? .2 : 60.);
  if (!end.message.empty())
    std::fprintf(stderr, "%s\n", end.message.c_str());
  return end.status;
}
