// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/app/ranks_compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>

namespace ogive::test
{
namespace
{
double number(const nlohmann::json &value)
{
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::vector<std::string> cells_of(const std::string &line)
{
  std::vector<std::string> cells;
  std::istringstream       in(line);
  for (std::string cell; std::getline(in, cell, ',');)
    cells.push_back(cell);
  return cells;
}

std::string unit_of(const std::string &column)
{
  return column.substr(column.find(" [") + 1);
}

/// What differences of a column are measured by: energies lend and borrow from
/// each other, components of a vector have one length, and momenta that are zero but for
/// rounding are measured by sqrt(2 m K). What has no unit is relative already.
std::map<std::string, double> scales_by_unit(const Numbers &n)
{
  std::map<std::string, double> scales;
  for (std::size_t c = 0; c < n.columns.size(); ++c)
    for (const double v : n.history[c])
      if (std::isfinite(v))
        scales[unit_of(n.columns[c])] = std::max(scales[unit_of(n.columns[c])], std::abs(v));
  if (scales.contains("[N s]"))
    scales["[N s]"] = std::max(scales["[N s]"], std::sqrt(2 * scales["[kg]"] * scales["[J]"]));
  if (scales.contains("[m]")) // a column may hold nothing but rounding: at a centimetre
    scales["[m]"] = std::max(scales["[m]"], .01);
  if (scales.contains("[N m s]")) // at a tenth of a metre, the size of what scenes hold
    scales["[N m s]"] = std::max(scales["[N m s]"], .1 * scales["[N s]"]);
  return scales;
}

double column_scale(const Numbers &n, std::size_t c, const std::map<std::string, double> &by_unit)
{
  const std::string unit = unit_of(n.columns[c]);
  if (unit == "[1]")
    return 1;
  if (unit != "[-]" && unit != "[s]")
    return by_unit.at(unit);
  double scale = 0;
  for (const double v : n.history[c])
    scale = std::isfinite(v) ? std::max(scale, std::abs(v)) : scale;
  return scale;
}

double relative(double a, double b, double scale)
{
  if (!std::isfinite(a) || !std::isfinite(b))
    return std::isnan(a) == std::isnan(b) && (std::isnan(a) || a == b) ? 0. : std::numeric_limits<double>::infinity();
  return a == b ? 0. : std::abs(a - b) / scale;
}
} // namespace

void Largest::take(double difference, const std::string &name)
{
  if (difference > value)
  {
    value = difference;
    where = name;
  }
}

Numbers numbers_of(const std::string &directory)
{
  const nlohmann::json s = summary(directory);
  Numbers              n;
  n.ranks = s.at("ranks").get<int>();
  for (const auto &[name, quantity] : s.at("quantities").items())
  {
    n.quantities.emplace_back(name, number(quantity.at("value")));
    n.scales.push_back(quantity.at("unit") == "1" || name == "symmetry_error" ? 1. : std::abs(n.quantities.back().second));
  }
  for (const auto &[name, check] : s.at("checks").items())
    if (!check.is_object())
      n.checks.emplace_back(name, number(check));

  std::istringstream in(read_file(directory + "/history.csv"));
  std::string        line;
  std::getline(in, line);
  n.columns = cells_of(line);
  n.history.resize(n.columns.size());
  while (std::getline(in, line))
  {
    const auto cells = cells_of(line);
    for (std::size_t c = 0; c < n.columns.size(); ++c)
      n.history[c].push_back(std::strtod(cells.at(c).c_str(), nullptr));
  }
  return n;
}

Difference difference(const Numbers &n, const Numbers &reference)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Difference       d;
  if (n.quantities.size() != reference.quantities.size() || n.checks.size() != reference.checks.size())
    d.quantities.take(infinite, "other names");
  else
  {
    for (std::size_t k = 0; k < n.quantities.size(); ++k)
    {
      const auto &[name, value] = reference.quantities[k];
      d.quantities.take(relative(n.quantities[k].second, value, reference.scales[k]), name);
    }
    for (std::size_t k = 0; k < n.checks.size(); ++k)
      d.checks.take(relative(n.checks[k].second, reference.checks[k].second, 1.), reference.checks[k].first);
  }
  if (n.columns != reference.columns || n.history[0].size() != reference.history[0].size())
  {
    d.history.take(infinite, "other rows or columns");
    return d;
  }
  const auto by_unit = scales_by_unit(reference);
  for (std::size_t c = 0; c < n.columns.size(); ++c)
    for (std::size_t k = 0; k < n.history[c].size(); ++k)
      d.history.take(relative(n.history[c][k], reference.history[c][k], column_scale(reference, c, by_unit)),
                     n.columns[c]);
  return d;
}

Outcome run_on(int ranks, const std::string &scene_file, const std::vector<std::string> &settings,
               const std::string &directory)
{
  std::vector<std::string> arguments = {"run", scene(scene_file), "-o", directory};
  if (ranks > 0)
    arguments.insert(arguments.end(), {"-n", std::to_string(ranks)});
  for (const std::string &s : settings)
    arguments.insert(arguments.end(), {"--set", s});
  return ogive(arguments);
}
} // namespace ogive::test
