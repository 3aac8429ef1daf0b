// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"
#include "core/input/scene.h"
#include "core/io/archive.h"
#include "core/io/history_writer.h"
#include "core/io/summary.h"
#include "coupling/ledger.h"
#include "coupling/observers/observer.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ogive::coupling
{
/// What a run tells: the observers, the books, who sets the step. Turns them
/// into rows of history.csv and into the summary.
class RunReport
{
public:
  explicit RunReport(const input::Scene &);

  /// history.csv: time, step count, the books, then each observer.
  std::vector<io::HistoryWriter::Column> columns() const;

  void every_step(const StepFrame &);
  void limited_by(const StepLimit &);

  /// The values of columns(). Enters `ledger` into the books.
  std::vector<double> row(const RowFrame &, std::int64_t step, LedgerRow ledger);

  double      drift() const { return books_.drift(); }
  std::string limiter() const; ///< who sets the step at present
  /// Empty while the books hold; else what is wrong with them.
  std::string fault(double drift_limit) const { return books_.fault(drift_limit); }

  /// Names, quantities, ledger, checks and limiter; the rest is the run's.
  io::Summary summary() const;

  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  io::Summary::Checks checks() const;

  struct Limited
  {
    std::int64_t steps = 0;
    StepLimit    last;
  };

  const input::Scene                    &scene_;
  std::vector<std::unique_ptr<Observer>> observers_;
  Ledger                                 books_;
  std::map<std::pair<std::string, int>, Limited> limited_; ///< by entity and body, of this process
  StepLimit                                      limit_;
  std::int64_t                                   limited_steps_ = 0;
};

/// work/seconds, or nothing where there was no work.
std::optional<double> rate(std::uint64_t work, double seconds);
} // namespace ogive::coupling
