// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/app/command.h"

#include <gtest/gtest.h>

#include <cmath>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace ogive::test
{
namespace
{
std::string quoted(const std::string &word)
{
  std::string s = "'";
  for (const char c : word)
    s += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return s + "'";
}
} // namespace

Outcome ogive(const std::vector<std::string> &arguments)
{
  const Scratch scratch;
  std::string   line = quoted(OGIVE_COMMAND);
  for (const std::string &a : arguments)
    line += " " + quoted(a);
  line += " >" + quoted(scratch.path("out")) + " 2>" + quoted(scratch.path("err"));
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(scratch.path("out")),
          read_file(scratch.path("err"))};
}

Scratch::Scratch()
{
  std::string name = (std::filesystem::temp_directory_path() / "ogive-test-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw std::runtime_error("cannot make a scratch directory");
  path_ = name;
}

Scratch::~Scratch()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_file(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string &path, const std::string &text)
{
  std::ofstream(path, std::ios::binary) << text;
}

nlohmann::json summary(const std::string &directory)
{
  return nlohmann::json::parse(read_file(directory + "/summary.json"));
}

double quantity(const nlohmann::json &summary, const std::string &name)
{
  return summary.at("quantities").at(name).at("value").get<double>();
}

std::string scene(const std::string &name)
{
  return std::string(OGIVE_SOURCE_DIR) + "/apps/scenes/" + name;
}

double error(const nlohmann::json &summary, const std::string &name)
{
  return std::abs(summary.at("quantities").at(name).at("relative_error").get<double>());
}

double check(const nlohmann::json &summary, const std::string &name)
{
  return std::abs(summary.at("checks").at(name).get<double>());
}

nlohmann::json run_scene(const std::string &name, const std::vector<std::string> &settings)
{
  const Scratch            scratch;
  std::vector<std::string> arguments = {"run", scene(name), "-o", scratch.path("r")};
  for (const std::string &s : settings)
    arguments.insert(arguments.end(), {"--set", s});
  const Outcome outcome = ogive(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? summary(scratch.path("r")) : nlohmann::json();
}
} // namespace ogive::test
