// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/outcome.h"

#include <optional>
#include <string>
#include <vector>

namespace ogive::chart
{
/// What decides whether an earlier run of a row still holds.
struct Identity
{
  std::string resolved; ///< the scene with everything filled in
  std::string commit;   ///< of the program
  double      limit_s = 0;
};

/// The directory of a study: `study.json` says which, `rows/NAME` are the runs,
/// the rest is what is drawn of them.
class StudyDirectory
{
public:
  explicit StudyDirectory(std::string path)
    : path_(std::move(path))
  {}
  ~StudyDirectory();
  StudyDirectory(const StudyDirectory &)            = delete;
  StudyDirectory &operator=(const StudyDirectory &) = delete;

  /// Throws InputError if the directory holds anything but this study, unless forced.
  void look(const std::string &study, bool force) const;

  /// Makes it the study's, and holds it against others until the object goes.
  /// Throws InputError if another process has it.
  void take(const std::string &study);

  /// What became of a row before, if that still holds.
  std::optional<Outcome> recall(const std::string &row, const Identity &) const;

  /// Forgets what became of a row.
  void forget(const std::string &row) const;

  /// Writes what became of a row, for recall().
  void record(const std::string &row, const Identity &, const Outcome &) const;

  /// Writes a file of results; those of earlier calls that are not written again
  /// are removed by finish().
  void write(const std::string &name, const std::string &text);
  void finish(const std::string &study);

  const std::string &path() const { return path_; }
  std::string        row(const std::string &name) const { return path_ + "/rows/" + name; }

private:
  std::string              path_;
  int                      lock_ = -1;
  std::vector<std::string> before_, written_;
};
} // namespace ogive::chart
