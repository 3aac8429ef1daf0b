// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/listing.h"

#include "core/input/suggest.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace ogive::input
{
std::string trim(const std::string &s)
{
  const std::size_t first = s.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t\r\n") + 1 - first);
}

std::vector<std::string> split_list(const std::string &s, char separator)
{
  std::vector<std::string> parts;
  if (trim(s).empty())
    return parts;
  std::istringstream in(s);
  for (std::string part; std::getline(in, part, separator);)
    parts.push_back(trim(part));
  if (trim(s).back() == separator)
    parts.emplace_back();
  return parts;
}

std::string join(const std::vector<std::string> &parts, const std::string &separator)
{
  std::string s;
  for (const std::string &part : parts)
    s += (s.empty() ? "" : separator) + part;
  return s;
}

std::string join_path(const std::string &section, const std::string &name)
{
  return section.empty() ? name : name.empty() ? section : section + "/" + name;
}

const ListedEntry *Listing::find(const std::string &section, const std::string &name) const
{
  const auto it = std::find_if(entries.begin(), entries.end(), [&](const ListedEntry &e) {
    return e.section == section && e.name == name;
  });
  return it == entries.end() ? nullptr : &*it;
}

std::string Listing::value(const std::string &section, const std::string &name, const std::string &otherwise) const
{
  const ListedEntry *e = find(section, name);
  return e ? e->value : otherwise;
}

std::vector<std::string> Listing::names(const std::string &section, const std::string &name) const
{
  return split_list(value(section, name));
}

InputError::Where Listing::where(const std::string &section, const std::string &name) const
{
  const std::string entry = join_path(section, name);
  if (const ListedEntry *e = find(section, name))
    return {e->file, e->line, entry};
  for (const ListedSection &s : sections)
    if (s.path == section)
      return {s.file, s.line, entry};
  return {file, 0, entry};
}

void Listing::add(ListedEntry e)
{
  if (const ListedEntry *first = find(e.section, e.name))
    throw InputError({e.file, e.line, join_path(e.section, e.name)},
                     "the entry is given twice, first in line " + std::to_string(first->line));
  entries.push_back(std::move(e));
}

namespace
{
/// One statement per line, after comments and continued lines are resolved.
class PrmScanner
{
public:
  explicit PrmScanner(const std::string &file)
    : in_(file)
  {
    listing_.file = file;
    if (!in_)
      throw InputError("cannot read \"" + file + "\"");
  }

  Listing scan()
  {
    for (std::string text; next(text);)
      if (!text.empty())
        statement(text);
    if (!open_.empty())
      throw InputError(here(path()), "the subsection is not closed", "\"end\"");
    return std::move(listing_);
  }

private:
  bool next(std::string &text)
  {
    text.clear();
    line_ = last_line_ + 1;
    for (std::string raw; std::getline(in_, raw);)
    {
      ++last_line_;
      raw = trim(raw.substr(0, raw.find('#')));
      if (raw.empty() || raw.back() != '\\')
      {
        text = trim(text + raw);
        return true;
      }
      raw.pop_back();
      text += raw;
    }
    return !text.empty();
  }

  void statement(const std::string &text)
  {
    const std::size_t blank = text.find_first_of(" \t");
    const std::string verb  = text.substr(0, blank);
    const std::string rest  = blank == std::string::npos ? "" : trim(text.substr(blank));
    if (verb == "set")
      assignment(rest);
    else if (verb == "subsection" && !rest.empty())
    {
      open_.push_back(rest);
      listing_.sections.push_back({path(), listing_.file, line_});
    }
    else if (verb == "end" && rest.empty())
    {
      if (open_.empty())
        throw InputError(here("end"), "there is no open subsection to end");
      open_.pop_back();
    }
    else
      throw InputError(here(verb), "this is not a statement", "\"set NAME = VALUE\", \"subsection NAME\" or \"end\"",
                       did_you_mean(verb, {"set", "subsection", "end"}));
  }

  void assignment(const std::string &rest)
  {
    const std::size_t equals = rest.find('=');
    if (equals == std::string::npos)
      throw InputError(here(rest), "there is no \"=\"", "\"set NAME = VALUE\"");
    listing_.add({path(), trim(rest.substr(0, equals)), trim(rest.substr(equals + 1)), listing_.file, line_});
  }

  std::string       path() const { return join(open_, "/"); }
  InputError::Where here(const std::string &entry) const { return {listing_.file, line_, entry}; }

  std::ifstream            in_;
  Listing                  listing_;
  std::vector<std::string> open_;
  int                      line_ = 0, last_line_ = 0;
};
} // namespace

Listing list_prm(const std::string &file)
{
  return PrmScanner(file).scan();
}

Listing list_file(const std::string &file)
{
  return file.ends_with(".json") ? list_json(file) : list_prm(file);
}

void apply_override(Listing &listing, const std::string &assignment)
{
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
    throw InputError({"--set", 0, assignment}, "there is no \"=\"", "\"Section/entry=value\"");
  const std::string path  = trim(assignment.substr(0, equals));
  const std::string value = trim(assignment.substr(equals + 1));
  const std::size_t slash = path.rfind('/');
  const bool        top   = slash == std::string::npos;
  const ListedEntry entry{top ? "" : path.substr(0, slash), top ? path : path.substr(slash + 1), value, "--set", 0};
  for (ListedEntry &e : listing.entries)
    if (e.section == entry.section && e.name == entry.name)
    {
      e = entry;
      return;
    }
  listing.entries.push_back(entry);
}
} // namespace ogive::input
