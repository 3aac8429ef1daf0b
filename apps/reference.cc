// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "apps/chart/study_reader.h"
#include "core/input/reader.h"

#include <cstdio>

namespace ogive::apps
{
void reference()
{
  std::fputs((input::reference() + chart::reference()).c_str(), stdout);
}
} // namespace ogive::apps
