// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/outcome.h"

#include "core/input/quantities.h"
#include "core/io/files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace ogive::chart
{
namespace
{
using Json = nlohmann::ordered_json;

std::optional<double> number(const Json &j)
{
  return j.is_number() ? std::optional<double>(j.get<double>()) : std::nullopt;
}

std::string text(const Json &j)
{
  return j.is_string() ? j.get<std::string>() : "";
}

Json parse(const std::string &file)
{
  try
  {
    return Json::parse(io::read_whole(file));
  }
  catch (const Json::exception &)
  {
    throw InputError({file, 0, {}}, "cannot be understood", "the summary of a run", "remove the row's folder");
  }
}

std::string short_number(double v)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}
} // namespace

const char *describe(Status s)
{
  return s == Status::done ? "done" : s == Status::failed ? "failed" : "too long";
}

const Outcome::Quantity *Outcome::find(const std::string &quantity) const
{
  const auto it =
    std::find_if(quantities.begin(), quantities.end(), [&](const Quantity &q) { return q.name == quantity; });
  return it == quantities.end() ? nullptr : &*it;
}

std::optional<double> Outcome::check(const std::string &name) const
{
  for (const Check &c : checks)
    if (c.name == name)
      return c.value;
  return {};
}

std::optional<double> Outcome::work() const
{
  if (status != Status::done)
    return {};
  return static_cast<double>(steps) * static_cast<double>(particles + elements);
}

void read_summary(const std::string &file, Outcome &o)
{
  const Json all = parse(file);
  try
  {
    o.core_s    = number(all.at("core_s"));
    o.steps     = all.at("steps").get<std::int64_t>();
    o.particles = all.at("counts").at("particles").get<std::int64_t>();
    o.elements  = all.at("counts").at("elements").get<std::int64_t>();
    for (const auto &[name, q] : all.at("quantities").items())
      o.quantities.push_back({name, text(q.at("unit")), text(q.at("kind")), number(q.at("value")),
                              number(q.at("reference")), text(q.at("source"))});
    for (const std::string &name : check_names())
      o.checks.push_back({name, number(all.at("checks").at(name))});
  }
  catch (const Json::exception &)
  {
    throw InputError({file, 0, {}}, "lacks entries", "the summary of a run", "remove the row's folder");
  }
}

std::string commit_of_summary(const std::string &file)
{
  const Json all = parse(file);
  return all.contains("commit") ? text(all.at("commit")) : "";
}

std::optional<double> value_of(const Outcome &o, const std::string &name)
{
  if (o.status != Status::done)
    return {};
  if (const Outcome::Quantity *q = o.find(name))
    return q->value;
  return o.check(name);
}

std::optional<double> reference_of(const Case &c, const Outcome &o, const std::string &name)
{
  if (const Judged *judged = c.find_quantity(name); judged && !std::isnan(judged->reference))
    return judged->reference;
  const Outcome::Quantity *q = o.find(name);
  return q ? q->reference : std::nullopt;
}

std::optional<double> error_of(const Case &c, const Outcome &o, const std::string &name)
{
  const std::optional<double> value = value_of(o, name), reference = reference_of(c, o, name);
  if (!value || !reference || *reference == 0)
    return {};
  return (*value - *reference) / std::abs(*reference);
}

std::string unit_of(const Case &c, const std::string &name)
{
  for (const Measured &m : c.known)
    if (m.name == name)
      return input::summary_unit(m.dimension);
  return "1";
}

namespace
{
/// How a quantity breaks its bounds; empty if it keeps them.
std::string breach(const Case &c, const Outcome &o, const Judged &q)
{
  if (!q.bounded())
    return {};
  const std::optional<double> value = value_of(o, q.name), error = error_of(c, o, q.name);
  if (!value)
    return q.name + " has no value";
  if (*value < q.at_least)
    return q.name + " " + short_number(*value) + " is below " + short_number(q.at_least);
  if (*value > q.at_most)
    return q.name + " " + short_number(*value) + " is above " + short_number(q.at_most);
  if (std::isnan(q.error_at_most))
    return {};
  if (!error)
    return q.name + " has no reference";
  return std::abs(*error) > q.error_at_most ? q.name + " is off by " + short_number(100 * *error) + " %" : "";
}
} // namespace

Verdict judge(const Case &c, const Outcome &o)
{
  if (o.status != Status::done)
    return {false, std::string(describe(o.status)) + (o.reason.empty() ? "" : ": " + o.reason)};
  for (const Judged &q : c.quantities)
    if (const std::string wrong = breach(c, o, q); !wrong.empty())
      return {false, wrong, q.name};
  return {};
}
} // namespace ogive::chart
