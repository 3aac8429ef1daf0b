// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Runs the built `ogive` as a user would.
namespace ogive::test
{
struct Outcome
{
  int         status = -1; ///< exit status
  std::string out, err;
};

/// Arguments are passed as they are, without a shell's expansion.
Outcome ogive(const std::vector<std::string> &arguments);

/// A fresh empty directory that goes away with the object.
class Scratch
{
public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch &)            = delete;
  Scratch &operator=(const Scratch &) = delete;

  std::string path(const std::string &name = {}) const { return name.empty() ? path_ : path_ + "/" + name; }

private:
  std::string path_;
};

std::string    read_file(const std::string &path);
void           write_file(const std::string &path, const std::string &text);
nlohmann::json summary(const std::string &directory);
double         quantity(const nlohmann::json &summary, const std::string &name);

/// |relative error| of a quantity, |value| of a check.
double error(const nlohmann::json &summary, const std::string &name);
double check(const nlohmann::json &summary, const std::string &name);

/// A shipped scene: apps/scenes/<name>.
std::string scene(const std::string &name);

/// Runs a shipped scene with `--set` of each setting and returns its summary;
/// fails the test, and returns none, if it fails.
nlohmann::json run_scene(const std::string &name, const std::vector<std::string> &settings = {});
} // namespace ogive::test
