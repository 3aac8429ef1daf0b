// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "commit.h"

#include "apps/chart/campaign.h"
#include "apps/chart/csv.h"
#include "apps/chart/map.h"
#include "apps/chart/pictures.h"
#include "apps/chart/processes.h"
#include "apps/chart/study_reader.h"
#include "apps/chart/tables.h"

#include <algorithm>
#include <cstdio>
#include <thread>

namespace ogive::apps
{
namespace
{
using namespace ogive::chart;

/// Gives the names of what was written.
std::vector<std::string> write_results(const Results &r, StudyDirectory &directory)
{
  std::vector<std::string> names;
  const auto               write = [&](const std::string &name, const std::string &text) {
    directory.write(name, text);
    names.push_back(name);
  };
  write("chart.csv", csv(r));
  write("tables.md", tables(r));
  for (const ChartSpec &c : r.study.charts)
    for (const std::string &of_case : c.cases)
      write(c.cases.size() == 1 ? c.name + ".svg" : c.name + "-" + of_case + ".svg", draw(make_plot(r, c, of_case)));
  for (const MapSpec &m : r.study.maps)
    write(m.name + ".svg", draw(make_map(r, m)));
  directory.finish(r.study.name);
  return names;
}

void print(const Results &r, const Matrix &matrix, std::size_t run, const StudyDirectory &directory,
           const std::vector<std::string> &names)
{
  std::printf("%s\n", r.study.title.c_str());
  std::printf("  %-24s %6s %6s %8s %10s\n", "case", "rows", "done", "failed", "too long");
  for (const Case &c : r.study.cases)
  {
    std::size_t n[3] = {0, 0, 0};
    for (const std::size_t i : rows_of(r, c.name))
      ++n[static_cast<int>(r.outcomes[i].status)];
    std::printf("  %-24s %6zu %6zu %8zu %10zu\n", c.name.c_str(), n[0] + n[1] + n[2], n[0], n[1], n[2]);
  }
  std::size_t listed = 0;
  for (std::size_t i = 0; i < r.rows.size(); ++i)
    if (r.outcomes[i].status != Status::done && ++listed <= 10)
      std::printf("  %s %s: %s\n", r.rows[i].name.c_str(), describe(r.outcomes[i].status), r.outcomes[i].reason.c_str());
  if (listed > 10)
    std::printf("  and %zu more, see chart.csv\n", listed - 10);
  std::printf("  %zu rows run now, %zu known from before; %zu combinations left out by the study\n", run,
              r.rows.size() - run, matrix.skipped);
  if (run < r.rows.size() && std::string(OGIVE_COMMIT).ends_with("-dirty"))
    std::printf("  note: this program has changes that are not committed, so the known rows may be of another build; "
                "--force runs all again\n");
  std::printf("  written to %s:", directory.path().c_str());
  for (std::size_t i = 0; i < names.size(); ++i)
    std::printf("%s %s", i == 0 ? "" : ",", names[i].c_str());
  std::printf("\n");
}
} // namespace

void chart(const ChartArguments &a)
{
  const Study    study  = read_study(a.study);
  const Matrix   matrix = expand(study);
  StudyDirectory directory(a.directory.empty() ? "results/chart-" + study.name : a.directory);
  const int      cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const CampaignOptions options{own_program(), OGIVE_COMMIT, a.jobs > 0 ? a.jobs : cores, a.force};
  const Campaign campaign = run_rows(study, matrix.rows, directory, options);
  const Results  results{study, matrix.rows, campaign.outcomes};
  print(results, matrix, campaign.run, directory, write_results(results, directory));
}
} // namespace ogive::apps
