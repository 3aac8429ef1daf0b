// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/quantities.h"
#include "coupling/observers/observer.h"

#include <gtest/gtest.h>

#include <set>

namespace ogive::coupling
{
namespace
{
// What a scene may ask for and what is measured are two lists.
TEST(Tables, WhatIsListedIsMeasured)
{
  const std::vector<std::string> listed = input::quantity_names(), measured = observable_quantities();
  EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()),
            std::set<std::string>(measured.begin(), measured.end()));
  EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()).size(), listed.size()) << "a name twice";
}
} // namespace
} // namespace ogive::coupling
