// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/campaign.h"

#include "apps/chart/processes.h"
#include "apps/chart/progress.h"
#include "core/input/reader.h"
#include "core/io/files.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace ogive::chart
{
namespace
{
class Runner
{
public:
  Runner(const Study &study, const std::vector<Row> &rows, StudyDirectory &directory, const CampaignOptions &options)
    : study_(study)
    , rows_(rows)
    , directory_(directory)
    , options_(options)
  {}

  Campaign go()
  {
    resolve();
    directory_.look(study_.name, options_.force);
    recall();
    check();
    directory_.take(study_.name);
    run();
    return std::move(campaign_);
  }

private:
  /// Reads the scene of every row: most mistakes show here.
  void resolve()
  {
    for (const Row &row : rows_)
      identities_.push_back(
        {input::write_resolved(read_variant(study_.cases[row.of_case].scene, row.overrides, "row \"" + row.name + "\"")),
         options_.commit, study_.row_limit});
  }

  void recall()
  {
    campaign_.outcomes.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (const auto known = options_.force ? std::nullopt : directory_.recall(rows_[i].name, identities_[i]))
        campaign_.outcomes[i] = *known;
      else
        todo_.push_back(i);
    campaign_.run = todo_.size();
  }

  std::vector<std::string> command(const char *verb, const Row &row) const
  {
    std::vector<std::string> words{options_.program, verb, study_.cases[row.of_case].scene};
    for (const Override &o : row.overrides)
      words.insert(words.end(), {"--set", o.text()});
    return words;
  }

  [[noreturn]] void refuse(const Row &row, const Ended &e) const
  {
    std::string text = last_line(e.err);
    if (text.starts_with("ogive: "))
      text = text.substr(7);
    std::string overrides;
    for (const Override &o : row.overrides)
      overrides += " --set \"" + o.text() + "\"";
    throw InputError({study_.file, 0, {}}, "row \"" + row.name + "\" is refused: " + text + " (" +
                                             study_.cases[row.of_case].scene + overrides + ")");
  }

  /// Builds the model of each row that is to run, and learns what it will cost.
  void check()
  {
    std::vector<Job> jobs;
    for (const std::size_t i : todo_)
      jobs.push_back({command("check", rows_[i]), study_.row_limit});
    costs_.assign(rows_.size(), 0);
    Progress progress("checked", todo_.size());
    run_all(
      jobs, options_.jobs,
      [&](std::size_t j, const Ended &e) {
        if (e.exit == 2)
          refuse(rows_[todo_[j]], e);
        // "about 1366 steps, 0.0256 s of processor time"
        const std::size_t at = e.out.find(" s of processor time");
        const std::size_t comma = at == std::string::npos ? at : e.out.rfind(", ", at);
        if (comma != std::string::npos)
          costs_[todo_[j]] = std::max(0., std::strtod(e.out.c_str() + comma + 2, nullptr));
        progress.ended(1);
      },
      [&](std::size_t running) { progress.show(running); });
  }

  void run()
  {
    // the long ones first, so that no core waits for one at the end
    std::stable_sort(todo_.begin(), todo_.end(), [&](std::size_t a, std::size_t b) { return costs_[a] > costs_[b]; });
    std::vector<Job> jobs;
    double           total = 0;
    for (const std::size_t i : todo_)
    {
      std::vector<std::string> words = command("run", rows_[i]);
      words.insert(words.end(), {"-o", directory_.row(rows_[i].name), "--force"});
      jobs.push_back({words, study_.row_limit});
      directory_.forget(rows_[i].name);
      total += weight(i);
    }
    Progress progress("run", todo_.size(), total);
    run_all(
      jobs, options_.jobs,
      [&](std::size_t j, const Ended &e) {
        keep(todo_[j], e);
        progress.ended(weight(todo_[j]));
      },
      [&](std::size_t running) { progress.show(running); });
  }

  /// Seconds that a row is expected to take; starting a process takes some too.
  double weight(std::size_t i) const { return costs_[i] + .2; }

  void keep(std::size_t i, const Ended &e)
  {
    const Row        &row    = rows_[i];
    const std::string folder = directory_.row(row.name);
    io::write_whole(folder + "/output.txt", e.out + e.err);
    if (e.exit == 2)
      refuse(row, e);
    Outcome o;
    o.wall_s = e.wall_s;
    o.status = e.exit == 0 ? Status::done : e.too_long ? Status::too_long : Status::failed;
    if (e.exit == 0)
      read_summary(folder + "/summary.json", o);
    else if (e.too_long)
      o.reason = "ended at the row limit of " + units::format_quantity(study_.row_limit, units::time);
    else if (e.signal != 0)
      o.reason = "ended by signal " + std::to_string(e.signal);
    else
      o.reason = last_line(e.err);
    if (o.reason.starts_with("ogive: "))
      o.reason = o.reason.substr(7);
    if (o.status == Status::failed && o.reason.empty())
      o.reason = "exit status " + std::to_string(e.exit);
    directory_.record(row.name, identities_[i], o);
    campaign_.outcomes[i] = o;
  }

  const Study            &study_;
  const std::vector<Row> &rows_;
  StudyDirectory         &directory_;
  CampaignOptions         options_;
  Campaign                campaign_;
  std::vector<Identity>   identities_;
  std::vector<std::size_t> todo_;
  std::vector<double>     costs_; ///< s by row, 0 where unknown
};
} // namespace

Campaign run_rows(const Study &study, const std::vector<Row> &rows, StudyDirectory &directory,
                  const CampaignOptions &options)
{
  return Runner(study, rows, directory, options).go();
}
} // namespace ogive::chart
