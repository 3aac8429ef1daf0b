// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/bench_report.h"

#include "core/base/error.h"
#include "core/io/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

namespace ogive::apps
{
namespace
{
using Json = nlohmann::ordered_json;

template <class... A>
std::string text(const char *format, A... values)
{
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

Json json_of(const BenchReport &r)
{
  Json kernels = Json::array();
  for (const Kernel &k : r.kernels)
  {
    Json entry = {{"name", k.name}, {"unit", k.unit}, {"what", k.what}, {"per_core_s", k.per_second}};
    if (k.bytes > 0)
      entry.update({{"bytes", k.bytes}, {"limit_by_memory", k.by_memory(r.limits)}});
    if (k.operations > 0)
      entry.update({{"operations", k.operations}, {"limit_by_arithmetic", k.by_arithmetic(r.limits)}});
    if (k.share_of_limit(r.limits) > 0)
      entry["share_of_limit"] = k.share_of_limit(r.limits);
    kernels.push_back(entry);
  }
  Json figures = Json::object();
  for (const auto &[name, value] : r.figures)
    figures[name] = value;
  return {{"commit", r.commit},
          {"processor", r.processor},
          {"memory_bytes_per_s", r.limits.bytes_per_s},
          {"multiply_add_flops_per_s", r.limits.flops},
          {"kernels", kernels},
          {"figures", figures}};
}

BenchReport report_of(const Json &json)
{
  BenchReport r;
  r.commit             = json.at("commit");
  r.processor          = json.at("processor");
  r.limits.bytes_per_s = json.at("memory_bytes_per_s");
  r.limits.flops       = json.at("multiply_add_flops_per_s");
  for (const Json &entry : json.at("kernels"))
  {
    Kernel k;
    k.name       = entry.at("name");
    k.unit       = entry.at("unit");
    k.what       = entry.at("what");
    k.per_second = entry.at("per_core_s");
    k.bytes      = entry.value("bytes", 0.);
    k.operations = entry.value("operations", 0.);
    r.kernels.push_back(k);
  }
  for (const auto &[name, value] : json.at("figures").items())
    r.figures.emplace_back(name, value.get<double>());
  return r;
}

double limit(double of_machine, double of_one)
{
  return of_one > 0 ? of_machine / of_one : std::numeric_limits<double>::infinity();
}
} // namespace

double Kernel::by_memory(const MachineLimits &l) const
{
  return limit(l.bytes_per_s, bytes);
}

double Kernel::by_arithmetic(const MachineLimits &l) const
{
  return limit(l.flops, operations);
}

double Kernel::share_of_limit(const MachineLimits &l) const
{
  return per_second / std::min(by_memory(l), by_arithmetic(l));
}

std::string describe(const BenchReport &r, const std::vector<BenchReport> &kept)
{
  std::string out = text("one core of %s: %.3g GB/s of memory (triad), %.3g Gflop/s (multiply-adds)\n",
                         r.processor.c_str(), 1e-9 * r.limits.bytes_per_s, 1e-9 * r.limits.flops);
  for (const Kernel &k : r.kernels)
  {
    out += text("%-20s %8.3g M %s/s  (%s)\n", k.name.c_str(), 1e-6 * k.per_second, k.unit.c_str(), k.what.c_str());
    if (k.bytes > 0 && k.operations > 0)
      out += text("%-20s %.0f bytes at least, %.0f operations: at most %.3g M/s and %.3g M/s; it reaches %.0f %% and "
                  "%.0f %%\n",
                  "", k.bytes, k.operations, 1e-6 * k.by_memory(r.limits), 1e-6 * k.by_arithmetic(r.limits),
                  100 * k.per_second / k.by_memory(r.limits), 100 * k.per_second / k.by_arithmetic(r.limits));
    if (kept.empty())
      continue;
    const auto &last = kept.back().kernels;
    const auto  then = std::find_if(last.begin(), last.end(), [&](const Kernel &l) { return l.name == k.name; });
    if (then != last.end())
      out += text("%-20s %.2f of the %.3g M/s kept of %s\n", "", k.per_second / then->per_second,
                  1e-6 * then->per_second, kept.back().commit.c_str());
  }
  for (const auto &[name, value] : r.figures)
    out += text("%-32s %.4g\n", name.c_str(), value);
  if (!kept.empty() && kept.back().processor != r.processor)
    out += "the kept result is of another processor: " + kept.back().processor + "\n";
  return out;
}

std::string to_json(const BenchReport &report)
{
  return json_of(report).dump(2) + "\n";
}

std::vector<BenchReport> read_kept(const std::string &path)
{
  std::vector<BenchReport> kept;
  if (path.empty() || !std::filesystem::exists(path))
    return kept;
  try
  {
    for (const Json &entry : Json::parse(io::read_whole(path)))
      kept.push_back(report_of(entry));
  }
  catch (const Json::exception &e)
  {
    throw InputError({path, 0, ""}, std::string("this is no list of kept results (") + e.what() + ")",
                     "a file that --keep wrote, or a name that is free");
  }
  return kept;
}

void keep(const std::string &path, const BenchReport &report)
{
  std::vector<BenchReport> kept = read_kept(path);
  kept.push_back(report);
  Json all = Json::array();
  for (const BenchReport &r : kept)
    all.push_back(json_of(r));
  io::write_whole(path, all.dump(2) + "\n");
}

std::string processor_name()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const auto at = line.find(": "); at != std::string::npos)
        return line.substr(at + 2);
  return "an unnamed processor";
}
} // namespace ogive::apps
