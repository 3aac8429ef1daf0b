// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/base/units.h"

#include <limits>
#include <map>
#include <string>
#include <vector>

/// A study as it stands in its file: which scenes are run in which variants, and
/// what is drawn of the results. Filled by read_study(), or by hand in a test.
namespace ogive::chart
{
inline constexpr double not_set = std::numeric_limits<double>::quiet_NaN();

/// One "Section/entry=value" over what a scene says.
struct Override
{
  std::string       path, value;
  InputError::Where place; ///< where the study says so

  std::string text() const { return path + "=" + value; }
};

struct OverrideList
{
  std::string           text; ///< as in the file
  std::vector<Override> items;
};

/// "viscosity=owen|monaghan, method=sph; case=bar": one of the alternatives,
/// parted by semicolons, holds with all its terms.
struct Condition
{
  struct Term
  {
    std::string              axis; ///< or "case"
    std::vector<std::string> levels;
  };
  std::string                    text;
  std::vector<std::vector<Term>> alternatives;
};

struct Level
{
  std::string  name, title;
  double       number = not_set; ///< its place on a chart's axis
  OverrideList overrides;
  std::string  like = {}; ///< an earlier level: this one sets the same in every case, and its own overrides over that
  Condition    only_with, except_with;
};

struct Axis
{
  std::string        name, title, unit;
  OverrideList       overrides; ///< of every level that has none itself; "{}" is the level's name
  std::vector<Level> levels;
};

/// What a case says of one axis.
struct CaseAxis
{
  std::string                         axis;
  std::vector<std::string>            levels;    ///< empty: all
  OverrideList                        overrides; ///< instead of the axis' own
  std::map<std::string, OverrideList> at;        ///< instead of the level's own
  std::map<std::string, std::string>  without_meaning; ///< why a level does not apply; empty: it does
};

/// Why a level of the axis, or one that it is like, means nothing to the case;
/// null where it applies.
const std::string *why_not(const Axis &, const CaseAxis &, const Level &);

/// The level that this one is like; null if it is like none.
const Level *model_of(const Axis &, const Level &);

/// A number of the summary: a quantity of an observer, or one of its checks.
struct Measured
{
  std::string      name;
  units::Dimension dimension;
  bool             observed = true; ///< else one of the checks
};

/// How a case judges one of them. Numbers in SI; not_set where the study says nothing.
struct Judged : Measured
{
  double      reference = not_set;
  std::string kind, source;
  double      at_least = not_set, at_most = not_set, error_at_most = not_set;
  std::string bound_source; ///< where the bounds come from

  bool bounded() const;
};

struct Case
{
  std::string           name, title, scene; ///< scene: an absolute path
  std::string           group;              ///< heads this line of a map and those after it of the same group
  OverrideList          overrides;
  std::vector<CaseAxis> axes; ///< those it uses
  std::vector<Measured> known;
  std::vector<Judged>   quantities;
  std::string           metric; ///< what a map prints; empty: the first with a bound

  const CaseAxis *find_axis(const std::string &name) const;
  const Judged   *find_quantity(const std::string &name) const;
  bool            knows(const std::string &quantity) const;
};

/// What a chart shows along an axis of the picture.
struct Measure
{
  enum class Kind
  {
    axis_number,
    core_seconds,
    wall_seconds,
    work,
    value,
    size,
    error,
    spread
  };
  std::string text; ///< as in the file
  Kind        kind = Kind::work;
  std::string name; ///< of the axis or the quantity
  std::string over; ///< axis of a spread
};

struct ChartSpec
{
  std::string              name, title;
  Measure                  x, y;
  bool                     x_log = false, y_log = false;
  std::vector<std::string> cases, series; ///< series empty: every axis but those that x and y run over
  Condition                only;
};

struct MapSpec
{
  std::string              name, title;
  std::vector<std::string> cases, columns; ///< axes
  Condition                only;
};

struct Study
{
  std::string              name, title, file;
  OverrideList             overrides;
  double                   row_limit = 0; ///< s of wall time; 0: none
  std::vector<std::string> spreads;       ///< axes
  std::vector<Axis>        axes;
  std::vector<Case>        cases;
  std::vector<ChartSpec>   charts;
  std::vector<MapSpec>     maps;

  int         axis_index(const std::string &name) const; ///< -1 if there is none
  const Case *find_case(const std::string &name) const;
};

/// Names of the summary's checks, as in summary.json.
const std::vector<std::string> &check_names();

template <class Item>
std::vector<std::string> names_of(const std::vector<Item> &items)
{
  std::vector<std::string> names;
  for (const Item &item : items)
    names.push_back(item.name);
  return names;
}
} // namespace ogive::chart
