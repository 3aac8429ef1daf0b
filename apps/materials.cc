// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "core/input/reader.h"
#include "core/io/files.h"

#include <cstdio>

namespace ogive::apps
{
void materials(const std::string &name)
{
  if (!name.empty())
  {
    std::fputs(io::read_whole(input::material_file(name)).c_str(), stdout);
    return;
  }
  for (const std::string &each : input::list_materials())
    std::printf("%-22s %s\n", each.c_str(), input::read_material(each).title.c_str());
}
} // namespace ogive::apps
