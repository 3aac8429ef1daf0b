// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/study.h"
#include "core/input/scene.h"

#include <string>
#include <vector>

namespace ogive::chart
{
/// One variant of one case: one run.
struct Row
{
  std::string           name; ///< unique in the study, fit for a folder: "taylor+owen+0.5"
  std::size_t           of_case = 0;
  std::vector<int>      levels; ///< by axis of the study; -1 where the case does not use it
  std::vector<Override> overrides;
};

struct Matrix
{
  std::vector<Row> rows;        ///< in the order of cases, then of levels, the last axis fastest
  std::size_t      skipped = 0; ///< combinations that "only with" and "except with" leave out
};

/// The product of the axes of each case, less what is left out. Throws InputError
/// where two axes set the same entry, and for a case without any variant.
Matrix expand(const Study &);

/// Name of the row's level along an axis; the case's name for "case"; empty for
/// an axis that the case does not use.
std::string level_name(const Study &, const Row &, const std::string &axis);

/// Names of the levels of these axes, "-" for those not used.
std::vector<std::string> level_names(const Study &, const Row &, const std::vector<std::string> &axes);

/// Reads a scene with overrides; a mistake in one is reported where the study
/// says it. `what`: who asks, for the message.
input::Scene read_variant(const std::string &scene, const std::vector<Override> &, const std::string &what);
} // namespace ogive::chart
