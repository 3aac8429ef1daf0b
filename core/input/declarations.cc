// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/declarations.h"

#include "core/input/suggest.h"

#include <algorithm>
#include <cctype>

namespace ogive::input
{
namespace
{
std::string parent_of(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string leaf_of(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// "Bodies" lists its subsections in the entry "bodies".
std::string list_entry_of(std::string section)
{
  section.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(section.front())));
  return section;
}

bool is_named_list(const std::string &section)
{
  return section == "Bodies" || section == "Materials" || section == "Walls" || section == "Boundaries" ||
         section == "Interfaces" || section == "Contacts" || section == "Observers";
}

std::string describe_use(const Use &use)
{
  const std::string what = "\"" + use.entry + "\"";
  return use.values.empty() ? "only together with " + what : "only where " + what + " is " + join(use.values, " or ");
}
} // namespace

void Declarations::entered()
{
  handler_.enter_subsection(leaf_of(section()));
  if (std::find(sections_.begin(), sections_.end(), section()) == sections_.end())
    sections_.push_back(section());
}

void Declarations::entry(const About &about, const Pattern &pattern, const std::string &present, const Assign &)
{
  // a mandatory entry has no default, whatever its member starts with
  const bool        has_default = about.need == Need::optional && pattern.match(present);
  const std::string preset      = has_default ? present : "";
  handler_.declare_entry(about.name, preset, pattern, about.meaning);
  entries_.push_back({section(), about.name, preset, about.meaning, about.need, about.use, pattern.clone()});
}

void Declarations::admit(const Listing &listing)
{
  // an empty list leaves its subsections unused: say so where it is empty
  for (const ListedEntry &e : listing.entries)
    if (e.value.empty())
      admit_entry(e);
  for (const ListedSection &s : listing.sections)
    admit_section(s);
  for (const ListedEntry &e : listing.entries)
    admit_entry(e);
}

void Declarations::admit_section(const ListedSection &s) const
{
  if (std::find(sections_.begin(), sections_.end(), s.path) != sections_.end())
    return;
  const std::string        parent = parent_of(s.path);
  std::vector<std::string> siblings;
  for (const std::string &known : sections_)
    if (!known.empty() && parent_of(known) == parent)
      siblings.push_back(leaf_of(known));
  const std::string hint = did_you_mean(leaf_of(s.path), siblings);
  if (is_named_list(parent))
    throw InputError({s.file, s.line, s.path},
                     "the subsection is not used: \"" + leaf_of(s.path) + "\" is not in the list \"" +
                       list_entry_of(parent) + "\"",
                     siblings.empty() ? "no such subsection" : "one of " + join(siblings), hint);
  if (is_named_list(s.path))
    throw InputError({s.file, s.line, s.path},
                     "the subsection is not used: there is no list \"" + list_entry_of(s.path) + "\"",
                     "\"set " + list_entry_of(s.path) + " = ...\"");
  throw InputError({s.file, s.line, s.path}, "unknown subsection",
                   siblings.empty() ? "no subsection here" : "one of " + join(siblings), hint);
}

void Declarations::refuse_entry(const ListedEntry &e) const
{
  const InputError::Where where{e.file, e.line, join_path(e.section, e.name)};
  if (std::find(sections_.begin(), sections_.end(), e.section) == sections_.end())
    throw InputError(where, "unknown subsection \"" + e.section + "\"", {}, did_you_mean(e.section, sections_));
  std::vector<std::string> here, elsewhere;
  for (const DeclaredEntry &d : entries_)
    if (d.section == e.section)
      here.push_back(d.name);
    else if (d.name == e.name && std::find(elsewhere.begin(), elsewhere.end(), d.section) == elsewhere.end())
      elsewhere.push_back(d.section);
  std::string hint = did_you_mean(e.name, here);
  if (hint.empty() && !elsewhere.empty())
    hint = elsewhere.front().empty() ? "it stands at the top, outside of subsections" :
                                       "it belongs to subsection \"" + elsewhere.front() + "\"";
  throw InputError(where, "unknown entry", here.empty() ? "subsections only" : "one of " + join(here), hint);
}

void Declarations::admit_entry(const ListedEntry &e)
{
  const auto declared = std::find_if(entries_.begin(), entries_.end(), [&](const DeclaredEntry &d) {
    return d.section == e.section && d.name == e.name;
  });
  if (declared == entries_.end())
    refuse_entry(e);
  const InputError::Where where{e.file, e.line, join_path(e.section, e.name)};
  if (e.value.empty())
    throw InputError(where, "the entry has no value", declared->rule().expectation());
  const Pattern::Complaint complaint = declared->rule().complaint(e.value);
  if (!complaint.wrong.empty())
    throw InputError(where, complaint.wrong, declared->rule().expectation(), complaint.suggestion);

  const std::vector<std::string> path = split_list(e.section, '/');
  for (const std::string &p : path)
    handler_.enter_subsection(p);
  handler_.set(e.name, e.value);
  for (std::size_t i = 0; i < path.size(); ++i)
    handler_.leave_subsection();
}

void Loader::entry(const About &about, const Pattern &pattern, const std::string &, const Assign &assign)
{
  const bool given = listing_.find(section(), about.name) != nullptr;
  if (!applies(about.use))
  {
    if (given)
      throw InputError(listing_.where(section(), about.name), "the entry does not apply here",
                       "it " + describe_use(about.use));
    return;
  }
  if (!given && about.need == Need::mandatory)
    throw InputError(listing_.where(section(), about.name), "the entry is missing", pattern.expectation());
  const std::string value = handler_.get(split_list(section(), '/'), about.name);
  if (!value.empty())
    assign(value);
  remember(about.name, value);
}

void Writer::entry(const About &about, const Pattern &, const std::string &present, const Assign &)
{
  if (!applies(about.use) || present.empty())
    return;
  text_ += indent() + "set " + about.name + " = " + present + "\n";
  remember(about.name, present);
}

void Writer::entered()
{
  text_ += indent() + "subsection " + leaf_of(section()) + "\n";
  ++depth_;
}

void Writer::left()
{
  --depth_;
  text_ += indent() + "end\n";
}
} // namespace ogive::input
