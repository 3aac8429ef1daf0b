// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/run_directory.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <unistd.h>

namespace ogive::io
{
namespace fs = std::filesystem;

namespace
{
bool is_checkpoint(const std::string &name)
{
  return name.starts_with("checkpoint-") && name.ends_with(".h5");
}

/// Whether a run of this program wrote a file of this name.
bool is_result(const std::string &name)
{
  constexpr std::array<const char *, 6> names{"summary.json", "history.csv",  "results.xdmf",
                                              "results.h5",   "resolved.prm", "conversions.csv"};
  const std::string whole = name.ends_with(".part") ? name.substr(0, name.size() - 5) : name;
  return is_checkpoint(whole) || std::find(names.begin(), names.end(), whole) != names.end();
}

std::vector<fs::path> files_of(const fs::path &directory, bool (*wanted)(const std::string &))
{
  std::vector<fs::path> found;
  std::error_code       error;
  for (fs::directory_iterator at(directory, error), end; !error && at != end; at.increment(error))
    if (wanted(at->path().filename().string()))
      found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

[[noreturn]] void refuse(const std::string &path, const std::string &why)
{
  throw InputError({.file = path, .line = 0, .entry = {}}, "cannot write results here: " + why,
                   "a directory that can be written", "choose another with -o DIR");
}
} // namespace

RunDirectory::RunDirectory(std::string path)
  : path_(std::move(path))
{}

RunDirectory RunDirectory::create(const std::string &path, bool force)
{
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    refuse(path, "it is not a directory");
  fs::create_directories(path, error);
  if (error)
    refuse(path, error.message());
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    refuse(path, "no permission");

  const std::vector<fs::path> results = files_of(path, is_result);
  if (!results.empty() && !force)
    throw InputError({.file = path, .line = 0, .entry = {}},
                     "holds the results of a run already (" + results.front().filename().string() + ")",
                     "a new or empty directory",
                     "choose another with -o DIR, or replace them with --force");
  for (const fs::path &file : results)
    if (!fs::remove(file, error) || error)
      refuse(file.string(), error.message());
  return RunDirectory(path);
}

RunDirectory RunDirectory::open(const std::string &path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw InputError({.file = path, .line = 0, .entry = {}}, "no such directory",
                     "the directory of an earlier run");
  if (files_of(path, is_result).empty())
    throw InputError({.file = path, .line = 0, .entry = {}}, "holds no results of a run",
                     "the directory of an earlier run");
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    refuse(path, "no permission");
  return RunDirectory(path);
}

std::string RunDirectory::default_name(const std::string &scene, const std::string &parent)
{
  std::error_code error;
  for (int n = 1;; ++n)
    {
      const std::string name = parent + "/" + scene + "-" + std::to_string(n);
      if (!fs::exists(name, error))
        return name;
    }
}

std::string RunDirectory::checkpoint(std::int64_t step) const
{
  std::array<char, 64> name;
  std::snprintf(name.data(), name.size(), "/checkpoint-%010lld.h5", static_cast<long long>(step));
  return path_ + name.data();
}

std::vector<std::string> RunDirectory::checkpoints() const
{
  std::vector<std::string> names;
  for (const fs::path &file : files_of(path_, is_checkpoint))
    names.push_back(file.string());
  return names;
}

std::string RunDirectory::last_checkpoint() const
{
  const std::vector<std::string> all = checkpoints();
  if (all.empty())
    throw InputError({.file = path_, .line = 0, .entry = {}}, "holds no checkpoint",
                     "a file checkpoint-*.h5", "set an interval for checkpoints in the scene");
  return all.back();
}
} // namespace ogive::io
