// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/outcome.h"
#include "apps/chart/rows.h"
#include "apps/chart/study_directory.h"

#include <string>
#include <vector>

namespace ogive::chart
{
struct CampaignOptions
{
  std::string program; ///< its path
  std::string commit;
  int         jobs  = 1;     ///< runs side by side
  bool        force = false; ///< run every row again
};

struct Campaign
{
  std::vector<Outcome> outcomes; ///< one a row
  std::size_t          run = 0;  ///< rows run now; the others were known
};

/// Runs the rows whose outcome is not known. Every row's input is examined
/// before anything runs or is written. A run that fails is an outcome; bad input
/// of any row is an InputError that names it.
Campaign run_rows(const Study &, const std::vector<Row> &, StudyDirectory &, const CampaignOptions &);
} // namespace ogive::chart
