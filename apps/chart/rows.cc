// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/rows.h"

#include "apps/chart/expressions.h"
#include "core/input/reader.h"

#include <algorithm>

namespace ogive::chart
{
namespace
{
/// Puts one over what is there already.
void put(std::vector<Override> &all, const Override &o)
{
  std::erase_if(all, [&](const Override &e) { return e.path == o.path; });
  all.push_back(o);
}

/// The overrides of one level in one case: the most particular list that says
/// anything, over that of the level it is like.
std::vector<Override> overrides_of(const Axis &axis, const Level &level, const CaseAxis &in_case)
{
  if (const auto at = in_case.at.find(level.name); at != in_case.at.end() && !at->second.items.empty())
    return at->second.items;
  if (const Level *model = model_of(axis, level))
  {
    std::vector<Override> all = overrides_of(axis, *model, in_case);
    for (const Override &o : level.overrides.items)
      put(all, o);
    return all;
  }
  if (!in_case.overrides.items.empty())
    return in_case.overrides.items;
  return level.overrides.items.empty() ? axis.overrides.items : level.overrides.items;
}

Override with_level(Override o, const std::string &level)
{
  for (std::string *text : {&o.path, &o.value})
    for (std::size_t at = text->find("{}"); at != std::string::npos; at = text->find("{}", at + level.size()))
      text->replace(at, 2, level);
  return o;
}

std::vector<Override> overrides_of(const Study &s, const Row &row)
{
  const Case           &c = s.cases[row.of_case];
  std::vector<Override> all, of_axes;
  for (const auto *list : {&s.overrides.items, &c.overrides.items})
    for (const Override &o : *list)
      put(all, o);
  for (std::size_t a = 0; a < s.axes.size(); ++a)
  {
    if (row.levels[a] < 0)
      continue;
    const Level          &level   = s.axes[a].levels[static_cast<std::size_t>(row.levels[a])];
    const CaseAxis       &in_case = *c.find_axis(s.axes[a].name);
    std::vector<Override> mine;
    for (const Override &raw : overrides_of(s.axes[a], level, in_case))
    {
      const Override o = with_level(raw, level.name);
      if (std::any_of(of_axes.begin(), of_axes.end(), [&](const Override &e) { return e.path == o.path; }))
        throw InputError(o.place, "\"" + o.path + "\" is set by another axis too", "each entry set by one axis",
                         "see row \"" + row.name + "\"");
      mine.push_back(o);
    }
    of_axes.insert(of_axes.end(), mine.begin(), mine.end());
  }
  for (const Override &o : of_axes)
    put(all, o);
  return all;
}

bool wanted(const Study &s, const Row &row)
{
  const auto level_of = [&](const std::string &axis) { return level_name(s, row, axis); };
  for (std::size_t a = 0; a < s.axes.size(); ++a)
    if (row.levels[a] >= 0)
    {
      const Level &level = s.axes[a].levels[static_cast<std::size_t>(row.levels[a])];
      if (why_not(s.axes[a], *s.cases[row.of_case].find_axis(s.axes[a].name), level))
        return false;
      if (!holds(level.only_with, level_of, true))
        return false;
      if (!level.except_with.alternatives.empty() && holds(level.except_with, level_of, false))
        return false;
    }
  return true;
}

/// Levels that the case uses of each axis of the study.
std::vector<std::vector<int>> choices_of(const Study &s, const Case &c)
{
  std::vector<std::vector<int>> choices;
  for (const Axis &axis : s.axes)
  {
    std::vector<int> &mine    = choices.emplace_back();
    const CaseAxis   *in_case = c.find_axis(axis.name);
    for (std::size_t l = 0; in_case && l < axis.levels.size(); ++l)
      if (in_case->levels.empty() ||
          std::find(in_case->levels.begin(), in_case->levels.end(), axis.levels[l].name) != in_case->levels.end())
        mine.push_back(static_cast<int>(l));
    if (!in_case)
      mine.push_back(-1);
  }
  return choices;
}

/// The next combination, the last axis fastest; false after the last one.
bool advance(std::vector<std::size_t> &at, const std::vector<std::vector<int>> &choices)
{
  for (std::size_t a = at.size(); a-- > 0;)
  {
    if (++at[a] < choices[a].size())
      return true;
    at[a] = 0;
  }
  return false;
}

void expand_case(const Study &s, std::size_t index, Matrix &matrix)
{
  const auto               choices = choices_of(s, s.cases[index]);
  const std::size_t        before  = matrix.rows.size();
  std::vector<std::size_t> at(choices.size(), 0);
  do
  {
    Row row;
    row.of_case = index;
    row.name    = s.cases[index].name;
    for (std::size_t a = 0; a < at.size(); ++a)
    {
      const int level = choices[a][at[a]];
      row.levels.push_back(level);
      if (level >= 0)
        row.name += "+" + s.axes[a].levels[static_cast<std::size_t>(level)].name;
    }
    if (!wanted(s, row))
    {
      ++matrix.skipped;
      continue;
    }
    row.overrides = overrides_of(s, row);
    matrix.rows.push_back(std::move(row));
  } while (advance(at, choices));
  if (matrix.rows.size() == before)
    throw InputError({s.file, 0, "Cases/" + s.cases[index].name},
                     "every variant of the case is left out by \"only with\", \"except with\" or \"does not apply\"",
                     "at least one variant");
}
} // namespace

Matrix expand(const Study &s)
{
  Matrix matrix;
  for (std::size_t c = 0; c < s.cases.size(); ++c)
    expand_case(s, c, matrix);
  return matrix;
}

std::string level_name(const Study &s, const Row &row, const std::string &axis)
{
  if (axis == "case")
    return s.cases[row.of_case].name;
  const int a = s.axis_index(axis);
  if (a < 0 || row.levels[static_cast<std::size_t>(a)] < 0)
    return {};
  return s.axes[static_cast<std::size_t>(a)].levels[static_cast<std::size_t>(row.levels[static_cast<std::size_t>(a)])].name;
}

std::vector<std::string> level_names(const Study &s, const Row &row, const std::vector<std::string> &axes)
{
  std::vector<std::string> names;
  for (const std::string &axis : axes)
  {
    const std::string name = level_name(s, row, axis);
    names.push_back(name.empty() ? "-" : name);
  }
  return names;
}

input::Scene read_variant(const std::string &scene, const std::vector<Override> &overrides, const std::string &what)
{
  std::vector<std::string> texts;
  for (const Override &o : overrides)
    texts.push_back(o.text());
  try
  {
    return input::read_scene(scene, texts);
  }
  catch (const InputError &e)
  {
    for (const Override &o : overrides)
      if (e.where().file == "--set" && e.where().entry == o.path)
        throw InputError(o.place, "\"" + o.text() + "\": " + e.complaint() + " (" + what + ")");
    throw InputError(e.where(), e.complaint() + " (" + what + ")");
  }
}
} // namespace ogive::chart
