// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ogive::io
{
/// The directory that a run writes into.
class RunDirectory
{
public:
  /// Makes `path` and all above it. If it holds results of a run already, they
  /// are removed with `force` (nothing else in it is), and are an InputError
  /// without. A path that cannot be written is an InputError too.
  static RunDirectory create(const std::string &path, bool force);

  /// A directory that another process has made; looks at nothing.
  static RunDirectory made(const std::string &path) { return RunDirectory(path); }

  /// The directory of a run to go on with; InputError if it is none.
  static RunDirectory open(const std::string &path);

  /// "results/<scene>-<n>" with the smallest n >= 1 that is free.
  static std::string default_name(const std::string &scene, const std::string &parent = "results");

  const std::string &path() const { return path_; }
  std::string        summary() const { return path_ + "/summary.json"; }
  std::string        history() const { return path_ + "/history.csv"; }
  std::string        resolved_scene() const { return path_ + "/resolved.prm"; }
  std::string        conversions() const { return path_ + "/conversions.csv"; }
  std::string        checkpoint(std::int64_t step) const;

  /// All checkpoints, the last step last.
  std::vector<std::string> checkpoints() const;
  /// The last one; InputError if there is none.
  std::string last_checkpoint() const;

private:
  explicit RunDirectory(std::string path);

  std::string path_;
};
} // namespace ogive::io
