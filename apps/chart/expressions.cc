// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/expressions.h"

#include "core/input/listing.h"
#include "core/input/suggest.h"

#include <algorithm>
#include <sstream>

namespace ogive::chart
{
using input::did_you_mean;
using input::join;
using input::split_list;
using input::trim;

std::vector<Override> parse_overrides(const std::string &text, const InputError::Where &where)
{
  std::vector<Override> all;
  for (const std::string &part : split_list(text, ';'))
  {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || trim(part.substr(0, equals)).empty() || trim(part.substr(equals + 1)).empty())
      throw InputError(where, "\"" + part + "\" is not an override", "\"Section/entry=value\", parted by semicolons");
    const Override o{trim(part.substr(0, equals)), trim(part.substr(equals + 1)), where};
    if (std::any_of(all.begin(), all.end(), [&](const Override &e) { return e.path == o.path; }))
      throw InputError(where, "\"" + o.path + "\" is set twice");
    all.push_back(o);
  }
  return all;
}

namespace
{
const std::string condition_form = "\"AXIS=LEVEL|LEVEL, AXIS=LEVEL; ...\", where AXIS may be \"case\"";

std::vector<std::string> levels_of(const std::string &axis, const Study &study)
{
  return axis == "case" ? names_of(study.cases) :
                          names_of(study.axes[static_cast<std::size_t>(study.axis_index(axis))].levels);
}

void require_axis(const std::string &axis, const Study &study, const InputError::Where &where)
{
  if (study.axis_index(axis) >= 0)
    return;
  const std::vector<std::string> known = names_of(study.axes);
  throw InputError(where, "there is no axis \"" + axis + "\"", known.empty() ? "a study with axes" : "one of " + join(known),
                   did_you_mean(axis, known));
}

Condition::Term parse_term(const std::string &text, const Study &study, const InputError::Where &where)
{
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError(where, "\"" + text + "\" is not a condition", condition_form);
  const Condition::Term term{trim(text.substr(0, equals)), split_list(text.substr(equals + 1), '|')};
  if (term.axis != "case")
    require_axis(term.axis, study, where);
  if (term.levels.empty())
    throw InputError(where, "\"" + text + "\" names no level", condition_form);
  const std::vector<std::string> known = levels_of(term.axis, study);
  for (const std::string &level : term.levels)
    if (std::find(known.begin(), known.end(), level) == known.end())
      throw InputError(where,
                       term.axis == "case" ? "there is no case \"" + level + "\"" :
                                             "axis \"" + term.axis + "\" has no level \"" + level + "\"",
                       "one of " + join(known), did_you_mean(level, known));
  return term;
}
} // namespace

Condition parse_condition(const std::string &text, const Study &study, const InputError::Where &where)
{
  Condition condition;
  condition.text = text;
  for (const std::string &alternative : split_list(text, ';'))
  {
    condition.alternatives.emplace_back();
    for (const std::string &term : split_list(alternative))
      condition.alternatives.back().push_back(parse_term(term, study, where));
    if (condition.alternatives.back().empty())
      throw InputError(where, "an empty condition stands between two semicolons", condition_form);
  }
  return condition;
}

Measure parse_measure(const std::string &text, const Study &study, const InputError::Where &where)
{
  std::istringstream       in(text);
  std::vector<std::string> w;
  for (std::string word; in >> word;)
    w.push_back(word);

  using Kind = Measure::Kind;
  Measure m;
  m.text              = text;
  const auto    first = w.empty() ? std::string() : w.front();
  const bool    of    = w.size() >= 3 && w[1] == "of";
  if (w.size() == 2 && first == "axis")
    m.kind = Kind::axis_number, m.name = w[1];
  else if (w.size() == 2 && w[1] == "seconds" && (first == "core" || first == "wall"))
    m.kind = first == "core" ? Kind::core_seconds : Kind::wall_seconds;
  else if (w.size() == 1 && first == "work")
    m.kind = Kind::work;
  else if (of && w.size() == 3 && (first == "value" || first == "size" || first == "error"))
    m.kind = first == "value" ? Kind::value : first == "size" ? Kind::size : Kind::error, m.name = w[2];
  else if (of && w.size() == 5 && first == "spread" && w[3] == "over")
    m.kind = Kind::spread, m.name = w[2], m.over = w[4];
  else
    throw InputError(where, "\"" + text + "\" is not something to draw",
                     "\"axis NAME\", \"core seconds\", \"wall seconds\", \"work\", \"value of QUANTITY\", \"size of "
                     "QUANTITY\", \"error of QUANTITY\" or \"spread of QUANTITY over AXIS\"",
                     did_you_mean(first, {"axis", "core", "wall", "work", "value", "size", "error", "spread"}));
  if (m.kind == Kind::axis_number)
    require_axis(m.name, study, where);
  if (m.kind == Kind::spread)
    require_axis(m.over, study, where);
  return m;
}
} // namespace ogive::chart
