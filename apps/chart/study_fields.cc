// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/study_fields.h"

namespace ogive::chart
{
using input::Fields;
using input::NamesPattern;
using input::Need;

namespace
{
const std::string overrides_form = "\"Section/entry=value\", parted by semicolons";
const std::string condition_form = "\"AXIS=LEVEL|LEVEL, AXIS=LEVEL; ...\"";
const std::string measure_form   = "\"axis NAME\", \"core seconds\", \"wall seconds\", \"work\", \"value of Q\", "
                                   "\"size of Q\", \"error of Q\" or \"spread of Q over AXIS\"";

/// A list whose items exist already: reading it again changes nothing.
void list(Fields &f, const input::About &about, std::vector<std::string> names)
{
  f.names(about, names);
}

template <class Item, class Each>
void subsections(Fields &f, const std::string &section, std::vector<Item> &items, const Each &each)
{
  if (items.empty())
    return;
  f.enter(section);
  for (Item &item : items)
  {
    f.enter(item.name);
    each(item);
    f.leave();
  }
  f.leave();
}

void axis_fields(Fields &f, Axis &a)
{
  f.text({"title", "what tables and charts call it; by default its name"}, a.title);
  f.text({"unit", "unit of the levels' numbers, for the charts"}, a.unit);
  list(f, {"levels", "names of its levels", Need::mandatory}, names_of(a.levels));
  f.text({"overrides", "what a level sets in the scene unless its own subsection says; {} is the level's name"},
         a.overrides.text, overrides_form);
  for (Level &l : a.levels)
  {
    f.enter(l.name);
    f.text({"title", "what tables and charts call it; by default its name"}, l.title);
    f.number({"number", "its place along a chart's axis; by default its name, if that is a number"}, l.number);
    f.text({"overrides", "what it sets in the scene"}, l.overrides.text, overrides_form);
    f.text({"like", "an earlier level: in every case this one sets what that one does, and its own overrides over it, "
                    "and it applies where that one does"},
           l.like, "the name of an earlier level");
    f.text({"only with", "the level is left out of variants where this does not hold"}, l.only_with.text,
           condition_form);
    f.text({"except with", "the level is left out of variants where this holds"}, l.except_with.text, condition_form);
    f.leave();
  }
}

void judged_fields(Fields &f, Judged &q)
{
  f.quantity({"reference", "what the value is compared with, instead of the scene's own reference"}, q.reference,
             q.dimension);
  f.choice({"kind", "what the reference is worth", Need::mandatory, {"reference", {}}}, q.kind,
           {"exact", "code", "test", "memory"});
  f.text({"source", "where the reference comes from", Need::mandatory, {"reference", {}}}, q.source);
  f.quantity({"at least", "a variant below it has failed, on maps"}, q.at_least, q.dimension);
  f.quantity({"at most", "a variant above it has failed, on maps"}, q.at_most, q.dimension);
  f.number({"error at most", "a variant whose relative error is greater in size has failed, on maps"},
           q.error_at_most, input::bounds::positive);
  f.text({"bound source", "where the bounds come from, for maps"}, q.bound_source);
}

void case_fields(Fields &f, Case &c, const Study &study)
{
  f.text({"title", "what tables and maps call it; by default the scene's title"}, c.title);
  f.text({"group", "heading over the case and those after it of the same group, on maps"}, c.group);
  f.text({"scene", "the scene file, as seen from the study", Need::mandatory}, c.scene, "a scene file");
  f.text({"overrides", "set in all variants of the case"}, c.overrides.text, overrides_form);

  std::vector<std::string> choices = names_of(study.axes), used;
  choices.emplace_back("none");
  for (const CaseAxis &a : c.axes)
    used.push_back(a.axis);
  f.names({"axes", "the axes that it is varied along; by default all; or none"}, used, NamesPattern(choices));
  std::vector<std::string> quantities = names_of(c.quantities);
  f.names({"quantities", "what its table shows, out of the scene's observers and the checks of the summary; by "
                         "default all observers"},
          quantities, NamesPattern(names_of(c.known)));
  if (!c.quantities.empty())
    f.choice({"metric", "the quantity that maps print; by default the first one with a bound"}, c.metric,
             names_of(c.quantities));

  if (!c.axes.empty())
    f.enter("Axes");
  for (CaseAxis &a : c.axes)
    if (const int index = study.axis_index(a.axis); index >= 0)
    {
      const std::vector<std::string> levels = names_of(study.axes[static_cast<std::size_t>(index)].levels);
      f.enter(a.axis);
      f.names({"levels", "the levels that the case uses; by default all"}, a.levels, NamesPattern(levels));
      f.text({"overrides", "what a level sets in this case, instead of the axis' own; {} is the level's name"},
             a.overrides.text, overrides_form);
      for (const std::string &level : levels)
        f.text({"overrides at " + level, "what the level sets in this case, instead of its own"}, a.at[level].text,
               overrides_form);
      for (const std::string &level : levels)
        f.text({"does not apply at " + level,
                "why the level has no meaning in this case: it is not run, and maps say so"},
               a.without_meaning[level]);
      f.leave();
    }
  if (!c.axes.empty())
    f.leave();
  subsections(f, "Quantities", c.quantities, [&](Judged &q) { judged_fields(f, q); });
}

void chart_fields(Fields &f, ChartSpec &c, const Study &study)
{
  const Fields::Words<bool> scales{{"linear", false}, {"log", true}};
  f.text({"title", "stands above the chart; by default its name"}, c.title);
  f.text({"x", "what runs to the right", Need::mandatory}, c.x.text, measure_form);
  f.text({"y", "what runs up", Need::mandatory}, c.y.text, measure_form);
  f.choice({"x scale", "how x runs"}, c.x_log, scales);
  f.choice({"y scale", "how y runs"}, c.y_log, scales);
  f.names({"cases", "a picture for each; by default all that have the quantities"}, c.cases,
          NamesPattern(names_of(study.cases)));
  f.names({"series", "a curve for each combination of the levels of these axes; by default of all that x and y do "
                     "not run along"},
          c.series, NamesPattern(names_of(study.axes)));
  f.text({"only", "only variants for which this holds are drawn"}, c.only.text, condition_form);
}

void map_fields(Fields &f, MapSpec &m, const Study &study)
{
  f.text({"title", "stands above the map; by default its name"}, m.title);
  f.names({"cases", "the rows of the map; by default all"}, m.cases, NamesPattern(names_of(study.cases)));
  f.names({"columns", "a column for each combination of the levels of these axes", Need::mandatory}, m.columns,
          NamesPattern(names_of(study.axes)));
  f.text({"only", "only variants for which this holds are judged"}, m.only.text, condition_form);
}
} // namespace

void study_fields(Fields &f, Study &s)
{
  f.text({"name", "by default the name of the file"}, s.name);
  f.text({"title", "one line for people"}, s.title);
  f.text({"overrides", "set in all variants of all cases"}, s.overrides.text, overrides_form);
  f.quantity({"row limit", "wall time after which a run is ended and its row counts as too long; 0: none"}, s.row_limit,
             units::time, input::bounds::not_negative);
  list(f, {"axes", "names of the axes, each with a subsection of Axes"}, names_of(s.axes));
  list(f, {"cases", "names of the cases, each with a subsection of Cases", Need::mandatory}, names_of(s.cases));
  f.names({"spreads over", "axes over which tables.md gives the greatest minus the least value"}, s.spreads,
          NamesPattern(names_of(s.axes)));
  list(f, {"charts", "names of the charts"}, names_of(s.charts));
  list(f, {"maps", "names of the maps of what survives"}, names_of(s.maps));

  subsections(f, "Axes", s.axes, [&](Axis &a) { axis_fields(f, a); });
  subsections(f, "Cases", s.cases, [&](Case &c) { case_fields(f, c, s); });
  subsections(f, "Charts", s.charts, [&](ChartSpec &c) { chart_fields(f, c, s); });
  subsections(f, "Maps", s.maps, [&](MapSpec &m) { map_fields(f, m, s); });
}
} // namespace ogive::chart
