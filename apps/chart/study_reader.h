// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/study.h"

#include <string>

namespace ogive::chart
{
/// Reads a study file, .prm or .json, in two passes as scenes are read, and the
/// scenes that it names, to know what they measure. Throws InputError with file,
/// line, entry, what was expected and the nearest valid name.
Study read_study(const std::string &file);

/// Every entry of a study. Markdown.
std::string reference();
} // namespace ogive::chart
