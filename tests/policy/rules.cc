// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/policy/rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace ogive::policy
{
namespace fs = std::filesystem;

namespace
{
constexpr std::array<const char *, 6> rooms{"core", "sph", "fem", "coupling", "apps", "tests"};

std::string text_of(const fs::path &path)
{
  std::ifstream      file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  std::istringstream       stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// Paths below the root, "/" between the parts, of the code in all rooms.
std::vector<std::string> code_files(const Root &root, const std::set<std::string> &extensions)
{
  std::vector<std::string> files;
  for (const char *room : rooms)
    if (fs::is_directory(root / room))
      for (const auto &entry : fs::recursive_directory_iterator(root / room))
        if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
          files.push_back(fs::relative(entry.path(), root).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

/// What each folder may include of the project, the longest prefix deciding.
const std::map<std::string, std::vector<std::string>> &graph()
{
  static const std::map<std::string, std::vector<std::string>> may{
    {"core/base/", {"core/base/"}},
    {"core/materials/", {"core/base/", "core/materials/"}},
    {"core/", {"core/"}},
    {"sph/", {"core/", "sph/"}},
    {"fem/", {"core/", "fem/"}},
    {"coupling/", {"core/", "sph/", "fem/", "coupling/"}},
    {"apps/", {"core/", "sph/", "fem/", "coupling/", "apps/"}},
  };
  return may;
}

bool starts_with_any(const std::string &text, const std::vector<std::string> &prefixes)
{
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const auto &p) { return text.starts_with(p); });
}

/// The standard library's headers have neither a dot nor a slash; the vector
/// type, the terminal of POSIX and what the heap holds are what core/base adds.
bool plain_header(const std::string &name)
{
  return name.find_first_of("./") == std::string::npos || name == "experimental/simd" || name == "unistd.h" ||
         name == "malloc.h" || name.starts_with("Eigen/");
}

std::string longest_prefix(const std::string &file)
{
  std::string best;
  for (const auto &[prefix, may] : graph())
    if (file.starts_with(prefix) && prefix.size() > best.size())
      best = prefix;
  return best;
}

std::string without_comments(std::string line)
{
  return line.substr(0, line.find("//"));
}
} // namespace

Violations includes_against_the_graph(const Root &root)
{
  static const std::regex include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  Violations              found;
  for (const std::string &file : code_files(root, {".h", ".cc"}))
    {
      const std::string place = longest_prefix(file);
      if (place.empty())
        continue;
      const bool bare = place == "core/base/" || place == "core/materials/";
      for (const std::string &line : lines_of(text_of(root / file)))
        {
          std::smatch match;
          if (!std::regex_search(line, match, include))
            continue;
          const std::string name = match[2];
          const bool        own  = match[1] == "\"";
          // A generated header has no folder.
          const bool generated = own && name.find('/') == std::string::npos && place == "apps/";
          if (own && !generated && !starts_with_any(name, graph().at(place)))
            found.push_back(file + ": includes " + name);
          if (!own && bare && !plain_header(name))
            found.push_back(file + ": includes <" + name + ">");
        }
    }
  return found;
}

Violations parameter_handlers_out_of_place(const Root &root)
{
  Violations found;
  for (const std::string &file : code_files(root, {".h", ".cc"}))
    {
      if (file.starts_with("tests/") || file.starts_with("core/input/") || file.ends_with("_parameters.cc"))
        continue;
      for (const std::string &line : lines_of(text_of(root / file)))
        {
          const std::string code = without_comments(line);
          if (code.find("ParameterHandler") != std::string::npos ||
              code.find("parameter_handler.h") != std::string::npos)
            found.push_back(file + ": sees ParameterHandler");
        }
    }
  return found;
}

Violations sources_left_out_of_the_build(const Root &root)
{
  Violations found;
  for (const std::string &file : code_files(root, {".cc"}))
    {
      bool named = false;
      for (fs::path folder = fs::path(file).parent_path(); !named && !folder.empty(); folder = folder.parent_path())
        {
          const std::string wanted = fs::path(file).lexically_relative(folder).generic_string();
          std::string       list;
          for (const std::string &line : lines_of(text_of(root / folder / "CMakeLists.txt")))
            list += line.substr(0, line.find('#')) + "\n";
          // A whole word: other.cc does not name her.cc.
          for (std::size_t at = list.find(wanted); at != std::string::npos; at = list.find(wanted, at + 1))
            {
              const auto ends = [&](std::size_t i) {
                return i >= list.size() || std::string_view(" \t\n()\"/").find(list[i]) != std::string_view::npos;
              };
              named = named || ((at == 0 || (ends(at - 1) && list[at - 1] != '/')) && ends(at + wanted.size()));
            }
        }
      if (!named)
        found.push_back(file + ": in no CMakeLists.txt");
    }
  return found;
}

Violations incomplete_scenes(const Root &root)
{
  Violations found;
  if (fs::is_directory(root / "apps/scenes"))
    for (const auto &entry : fs::directory_iterator(root / "apps/scenes"))
      for (const char *needed : {"scene.prm", "README.md"})
        if (entry.is_directory() && !fs::is_regular_file(entry.path() / needed))
          found.push_back(fs::relative(entry.path(), root).generic_string() + ": no " + needed);
  return found;
}

Violations readme_commands_unknown_to_the_scripts(const Root &root)
{
  std::string known;
  for (const char *script : {"demo", "test", ".ci/run", "scripts/prepare.sh"})
    known += text_of(root / script);
  Violations found;
  bool       in_block = false;
  for (const std::string &line : lines_of(text_of(root / "README.md")))
    {
      if (line.starts_with("```"))
        {
          in_block = !in_block && line == "```sh";
          continue;
        }
      const std::string command = line.substr(0, line.find("  #"));
      if (!in_block || command.empty() || command.starts_with("build/release/ogive "))
        continue;
      const bool script = command.starts_with("./") && command.find(' ') == std::string::npos;
      if (script ? !fs::is_regular_file(root / command.substr(2)) : known.find(command) == std::string::npos)
        found.push_back("README.md: \"" + command + "\" is in no script");
    }
  return found;
}

Violations overlong_files(const Root &root)
{
  Violations found;
  for (const std::string &file : code_files(root, {".h", ".cc", ".cmake", ".sh", ".py"}))
    if (const std::size_t n = lines_of(text_of(root / file)).size(); n >= 500)
      found.push_back(file + ": " + std::to_string(n) + " lines");
  return found;
}

Violations files_without_licence(const Root &root)
{
  Violations found;
  for (const std::string &file : code_files(root, {".h", ".cc", ".cmake", ".sh", ".py"}))
    {
      const auto lines = lines_of(text_of(root / file));
      bool       named = false;
      for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 2); ++i)
        named = named || lines[i].find("SPDX-License-Identifier: LGPL-2.1-or-later") != std::string::npos;
      if (!named)
        found.push_back(file + ": no licence on top");
    }
  return found;
}
} // namespace ogive::policy
