// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"

#include <string>
#include <vector>

/// The entries of a scene or material file as they stand in the text, each with
/// its line, before anything is known about what they mean.
namespace ogive::input
{
struct ListedEntry
{
  std::string section; ///< "Bodies/plate", empty at the top
  std::string name, value;
  std::string file;     ///< "--set" for an override
  int         line = 0; ///< 0 for an override
};

struct ListedSection
{
  std::string path; ///< "Bodies/plate"
  std::string file;
  int         line = 0;
};

struct Listing
{
  std::string                file;
  std::vector<ListedEntry>   entries;
  std::vector<ListedSection> sections;

  /// Null if the entry is not there.
  const ListedEntry *find(const std::string &section, const std::string &name) const;

  /// The value of an entry, or `otherwise` if it is not there.
  std::string value(const std::string &section, const std::string &name, const std::string &otherwise = {}) const;

  /// Names in a comma-separated entry.
  std::vector<std::string> names(const std::string &section, const std::string &name) const;

  /// Where the entry stands; the section's line if it is not there.
  InputError::Where where(const std::string &section, const std::string &name = {}) const;

  /// Throws InputError if the entry is there already.
  void add(ListedEntry);
};

/// Reads a .prm file: `set NAME = VALUE`, `subsection NAME`, `end`, comments
/// from `#`, a trailing `\` joins the next line. Throws InputError.
Listing list_prm(const std::string &file);

/// Reads a JSON file whose objects are subsections and whose other members are
/// entries; an array of names or numbers stands for a comma-separated list.
Listing list_json(const std::string &file);

/// JSON for names ending in .json, .prm otherwise.
Listing list_file(const std::string &file);

/// Puts "Section/sub/entry=value" over what the file says.
void apply_override(Listing &, const std::string &assignment);

std::string              trim(const std::string &);
std::vector<std::string> split_list(const std::string &, char separator = ',');
std::string              join(const std::vector<std::string> &, const std::string &separator = ", ");
/// "Bodies" and "plate" to "Bodies/plate"; either may be empty.
std::string join_path(const std::string &section, const std::string &name);
} // namespace ogive::input
