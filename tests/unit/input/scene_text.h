// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace ogive::input::testing
{
/// A good three-dimensional scene with one of everything.
extern const char *const base_scene;

/// Writes a file of that name into a fresh folder, which goes away at the end of the
/// program, and returns its path.
std::string write_file(const std::string &name, const std::string &text);

/// Replaces the first `from`, which must be there.
std::string replaced(std::string text, const std::string &from, const std::string &to);

/// Number of the first line that holds the fragment, 0 if there is none.
int line_of(const std::string &text, const std::string &fragment);

/// One mistake: the base scene with `from` replaced by `to`.
struct WrongScene
{
  const char *what, *from, *to;
  const char *at;    ///< part of the line that the message must point at; empty: the file as a whole
  const char *entry; ///< the entry that it must name
  const char *says;  ///< part of the message
  const char *hint;  ///< another part, such as the suggestion
};
extern const WrongScene  wrong_scenes[];
extern const std::size_t wrong_scene_count;
} // namespace ogive::input::testing
