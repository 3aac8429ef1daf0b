// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/study_reader.h"

#include "apps/chart/expressions.h"
#include "apps/chart/rows.h"
#include "apps/chart/study_fields.h"
#include "core/input/declarations.h"
#include "core/input/quantities.h"
#include "core/input/reader.h"
#include "core/input/suggest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace ogive::chart
{
namespace fs = std::filesystem;
using input::join;
using input::Listing;

namespace
{
template <class Item>
void outline_list(std::vector<Item> &items, const Listing &listing, const std::string &section, const std::string &entry)
{
  for (const std::string &name : listing.names(section, entry))
  {
    items.emplace_back();
    items.back().name = name;
  }
}

void outline_case(Case &c, const Study &s, const Listing &listing)
{
  const std::string section = "Cases/" + c.name;
  std::vector<std::string> used = listing.names(section, "axes");
  if (used.empty())
    used = names_of(s.axes);
  std::erase(used, "none");
  for (const std::string &axis : used)
    c.axes.push_back({axis, {}, {}, {}, {}});

  c.overrides.items = parse_overrides(listing.value(section, "overrides"), listing.where(section, "overrides"));
  c.scene           = listing.value(section, "scene");
  if (c.scene.empty())
    return; // the strict pass will say so
  c.scene = fs::absolute(fs::path(s.file).parent_path() / c.scene).lexically_normal().string();
  if (!fs::is_regular_file(c.scene))
    throw InputError(listing.where(section, "scene"), "there is no file \"" + c.scene + "\"", "a scene file");

  std::vector<Override> overrides = s.overrides.items;
  overrides.insert(overrides.end(), c.overrides.items.begin(), c.overrides.items.end());
  const input::Scene scene = read_variant(c.scene, overrides, "case \"" + c.name + "\"");
  c.title                  = scene.title;
  for (const input::Observer &o : scene.observers)
    if (const input::ObservedQuantity *q = input::find_quantity(o.quantity))
      c.known.push_back({o.name, q->dimension});
  const std::vector<std::string> observers = names_of(c.known);
  for (const std::string &check : check_names())
    if (std::find(observers.begin(), observers.end(), check) == observers.end())
      c.known.push_back({check, units::none, false});

  std::vector<std::string> judged = listing.names(section, "quantities");
  if (judged.empty())
    judged = observers;
  for (const std::string &name : judged)
  {
    const auto known = std::find_if(c.known.begin(), c.known.end(), [&](const Measured &m) { return m.name == name; });
    if (known == c.known.end())
      throw InputError(listing.where(section, "quantities"), "\"" + name + "\" is not known here",
                       "out of the observers and checks " + join(names_of(c.known)),
                       input::did_you_mean(name, names_of(c.known)));
    c.quantities.emplace_back();
    static_cast<Measured &>(c.quantities.back()) = *known;
  }
}

/// The lenient pass: names and what decides which entries there are.
Study outline(const Listing &listing)
{
  Study s;
  s.file            = listing.file;
  s.overrides.items = parse_overrides(listing.value("", "overrides"), listing.where("", "overrides"));
  outline_list(s.axes, listing, "", "axes");
  for (Axis &a : s.axes)
    outline_list(a.levels, listing, "Axes/" + a.name, "levels");
  outline_list(s.cases, listing, "", "cases");
  for (Case &c : s.cases)
    outline_case(c, s, listing);
  outline_list(s.charts, listing, "", "charts");
  outline_list(s.maps, listing, "", "maps");
  return s;
}

/// Words of conditions, and heads of columns of chart.csv.
void refuse_reserved_names(const Study &s, const Listing &listing)
{
  const std::vector<std::string> taken{"case",  "none",      "status",   "reason",
                                       "steps", "particles", "elements", "work"};
  for (const Axis &a : s.axes)
    if (std::find(taken.begin(), taken.end(), a.name) != taken.end())
      throw InputError(listing.where("", "axes"), "an axis cannot be called \"" + a.name + "\"", "another name");
}

void complete_axis(Axis &a, const Study &s, const Listing &listing)
{
  const std::string section = "Axes/" + a.name;
  if (a.title.empty())
    a.title = a.name;
  a.overrides.items = parse_overrides(a.overrides.text, listing.where(section, "overrides"));
  for (Level &l : a.levels)
  {
    const std::string here = section + "/" + l.name;
    if (l.title.empty())
      l.title = l.name;
    double     number = 0;
    const auto end    = l.name.data() + l.name.size();
    if (const auto r = std::from_chars(l.name.data(), end, number);
        std::isnan(l.number) && r.ec == std::errc() && r.ptr == end)
      l.number = number;
    l.overrides.items = parse_overrides(l.overrides.text, listing.where(here, "overrides"));
    const std::vector<std::string> names = names_of(a.levels);
    const std::vector<std::string> earlier(names.begin(), std::find(names.begin(), names.end(), l.name));
    if (!l.like.empty() && std::find(earlier.begin(), earlier.end(), l.like) == earlier.end())
      throw InputError(listing.where(here, "like"), "there is no level \"" + l.like + "\" before this one",
                       earlier.empty() ? "no \"like\" at the first level" : "one of " + join(earlier),
                       input::did_you_mean(l.like, earlier));
    l.only_with       = parse_condition(l.only_with.text, s, listing.where(here, "only with"));
    l.except_with     = parse_condition(l.except_with.text, s, listing.where(here, "except with"));
  }
}

void complete_case(Case &c, const Listing &listing, const std::string &scene)
{
  c.scene = scene; // the strict pass has put the text of the file here
  for (CaseAxis &a : c.axes)
  {
    const std::string section = "Cases/" + c.name + "/Axes/" + a.axis;
    a.overrides.items         = parse_overrides(a.overrides.text, listing.where(section, "overrides"));
    for (auto &[level, overrides] : a.at)
      overrides.items = parse_overrides(overrides.text, listing.where(section, "overrides at " + level));
  }
}

void check_quantity(const Measure &m, ChartSpec &chart, const Study &s, const Listing &listing, const char *entry)
{
  if (m.name.empty() || m.kind == Measure::Kind::axis_number)
    return;
  const InputError::Where  where = listing.where("Charts/" + chart.name, entry);
  std::vector<std::string> all;
  for (const Case &c : s.cases)
    for (const Measured &k : c.known)
      if (std::find(all.begin(), all.end(), k.name) == all.end())
        all.push_back(k.name);
  if (std::find(all.begin(), all.end(), m.name) == all.end())
    throw InputError(where, "there is no quantity \"" + m.name + "\"", "one of " + join(all),
                     input::did_you_mean(m.name, all));
  const bool by_name = listing.find("Charts/" + chart.name, "cases") != nullptr;
  for (const Case &c : s.cases)
    if (by_name && !c.knows(m.name) && std::find(chart.cases.begin(), chart.cases.end(), c.name) != chart.cases.end())
      throw InputError(where, "case \"" + c.name + "\" has no quantity \"" + m.name + "\"",
                       "one of " + join(names_of(c.known)), input::did_you_mean(m.name, names_of(c.known)));
  if (!by_name)
    std::erase_if(chart.cases, [&](const std::string &c) { return !s.find_case(c)->knows(m.name); });
}

void complete_chart(ChartSpec &chart, const Study &s, const Listing &listing)
{
  const std::string section = "Charts/" + chart.name;
  if (chart.title.empty())
    chart.title = chart.name;
  if (chart.cases.empty())
    chart.cases = names_of(s.cases);
  chart.x    = parse_measure(chart.x.text, s, listing.where(section, "x"));
  chart.y    = parse_measure(chart.y.text, s, listing.where(section, "y"));
  chart.only = parse_condition(chart.only.text, s, listing.where(section, "only"));
  if (chart.x.kind == Measure::Kind::spread)
    throw InputError(listing.where(section, "x"), "a spread is drawn along y only", "another measure");
  check_quantity(chart.x, chart, s, listing, "x");
  check_quantity(chart.y, chart, s, listing, "y");
  if (chart.series.empty())
    chart.series = names_of(s.axes);
  for (const Measure *m : {&chart.x, &chart.y})
    std::erase_if(chart.series, [&](const std::string &a) {
      return a == m->over || (m->kind == Measure::Kind::axis_number && a == m->name);
    });
}

void complete_map(MapSpec &map, const Study &s, const Listing &listing)
{
  if (map.title.empty())
    map.title = map.name;
  if (map.cases.empty())
    map.cases = names_of(s.cases);
  map.only = parse_condition(map.only.text, s, listing.where("Maps/" + map.name, "only"));
}
} // namespace

Study read_study(const std::string &file)
{
  if (!fs::is_regular_file(file))
    throw InputError({file, 0, {}}, "there is no such file", "a study file");
  const Listing       listing = input::list_file(file);
  Study               s       = outline(listing);
  input::Declarations declarations;
  study_fields(declarations, s);
  declarations.admit(listing);
  refuse_reserved_names(s, listing);

  std::vector<std::string> scenes;
  for (const Case &c : s.cases)
    scenes.push_back(c.scene);
  input::Loader loader(declarations.handler(), listing);
  study_fields(loader, s);
  if (s.name.empty())
    s.name = fs::path(file).stem().string();
  if (s.title.empty())
    s.title = s.name;
  for (Axis &a : s.axes)
    complete_axis(a, s, listing);
  for (std::size_t i = 0; i < s.cases.size(); ++i)
    complete_case(s.cases[i], listing, scenes[i]);
  for (ChartSpec &c : s.charts)
    complete_chart(c, s, listing);
  for (MapSpec &m : s.maps)
    complete_map(m, s, listing);
  return s;
}

std::string reference()
{
  // one of everything, so that every subsection is declared once
  Study s;
  s.axes.emplace_back().name                  = "AXIS";
  s.axes.back().levels.emplace_back().name    = "LEVEL";
  Case &c                                     = s.cases.emplace_back();
  c.name                                      = "CASE";
  c.known                                     = {{"QUANTITY", units::none}};
  c.axes                                      = {{"AXIS", {}, {}, {}, {}}};
  c.quantities.emplace_back().name            = "QUANTITY";
  s.charts.emplace_back().name                = "CHART";
  s.maps.emplace_back().name                  = "MAP";
  input::Declarations declarations;
  study_fields(declarations, s);
  // what stands in the example is no default
  std::string entries = input::describe_entries(declarations);
  for (const std::string example : {"| `AXIS` |", "| `CASE` |", "| `QUANTITY` |", "| `CHART` |", "| `MAP` |"})
    for (std::size_t at = entries.find(example); at != std::string::npos; at = entries.find(example, at))
      entries.replace(at, example.size(), "| not set |");
  return "\n# Entries of a study\n\n"
         "Read by `ogive chart`. AXIS, LEVEL, CASE, CHART and MAP stand for names of the lists of that kind, QUANTITY\n"
         "for the name of an observer or a check; its `reference` and bounds have its dimension.\n" + entries;
}
} // namespace ogive::chart
