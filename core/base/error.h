// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace ogive
{
/// A mistake in what the user wrote. The command ends with exit status 2.
///
/// The message names the file, the line (0 where there is none), the entry,
/// what was expected, and a suggestion where one exists.
class InputError : public std::runtime_error
{
public:
  struct Where
  {
    std::string file;
    int         line = 0;
    std::string entry;
  };

  explicit InputError(const std::string &what_is_wrong)
    : std::runtime_error(what_is_wrong)
    , complaint_(what_is_wrong)
  {}

  InputError(const Where &where, const std::string &what_is_wrong, const std::string &expected = {},
             const std::string &suggestion = {})
    : std::runtime_error(compose(where, what_is_wrong, expected, suggestion))
    , where_(where)
    , complaint_(compose({}, what_is_wrong, expected, suggestion))
  {}

  /// Where the mistake stands; empty if whoever found it could not know.
  const Where &where() const { return where_; }

  /// The message without the place, for those who know the place better.
  const std::string &complaint() const { return complaint_; }

private:
  static std::string compose(const Where &w, const std::string &wrong, const std::string &expected,
                             const std::string &suggestion)
  {
    std::string s = w.file;
    if (w.line > 0)
      s += ":" + std::to_string(w.line);
    if (!s.empty())
      s += ": ";
    if (!w.entry.empty())
      s += "\"" + w.entry + "\": ";
    s += wrong;
    if (!expected.empty())
      s += "; expected " + expected;
    if (!suggestion.empty())
      s += "; " + suggestion;
    return s;
  }

  Where       where_;
  std::string complaint_;
};

/// A run that cannot go on. The command ends with exit status 1.
/// The message names the entity, the place, the time and the cause.
class RunError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Stops on a mistake of the programmer; always on, so use it outside hot loops.
inline void require(bool condition, const char *message)
{
  if (!condition)
    throw std::logic_error(message);
}
} // namespace ogive
