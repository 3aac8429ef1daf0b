// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/summary.h"

#include "core/io/files.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace ogive::io
{
namespace
{
using Json = nlohmann::ordered_json;

Json number(std::optional<double> value)
{
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json text_or_null(const std::string &text)
{
  return text.empty() ? Json(nullptr) : Json(text);
}

Json to_json(const std::vector<Summary::Quantity> &quantities)
{
  Json all = Json::object();
  for (const Summary::Quantity &q : quantities)
    all[q.name] = {{"value", number(q.value)},
                   {"unit", q.unit},
                   {"reference", number(q.reference)},
                   {"relative_error", number(q.relative_error())},
                   {"source", text_or_null(q.source)},
                   {"kind", text_or_null(q.kind)}};
  return all;
}

Json to_json(const Summary::Checks &c)
{
  Json checks = {{"mass_drift", number(c.mass_drift)},
          {"momentum_drift", number(c.momentum_drift)},
          {"angular_momentum_drift", number(c.angular_momentum_drift)},
          {"energy_drift", number(c.energy_drift)},
          {"hourglass_fraction", number(c.hourglass_fraction)},
          {"eroded_elements", number(c.eroded_elements)},
          {"eroded_mass_share", number(c.eroded_mass_share)},
          {"gradient_fallbacks", number(c.gradient_fallbacks)}};
  if (!c.added_mass_fraction.empty())
    checks["added_mass_fraction"] = c.added_mass_fraction;
  return checks;
}

Json to_json(const std::optional<Summary::Limiter> &l)
{
  if (!l)
    return nullptr;
  return {{"entity", l->entity},
          {"body", text_or_null(l->body)},
          {"id", l->id},
          {"where_m", Json::array({number(l->where[0]), number(l->where[1]), number(l->where[2])})},
          {"why", l->why},
          {"dt_s", number(l->dt)},
          {"share", number(l->share)}};
}

Json to_json(const std::vector<Summary::Certificate> &certificates)
{
  Json all = Json::array();
  for (const Summary::Certificate &c : certificates)
  {
    Json figures = Json::array();
    for (const auto &f : c.figures)
      figures.push_back({{"wave", f.wave}, {"from", f.from}, {"wavelength_m", number(f.wavelength)},
                         {"reflection", number(f.reflection)}});
    all.push_back({{"interface", c.interface},
                   {"method", c.method},
                   {"bodies", c.bodies},
                   {"sizes_m", c.sizes},
                   {"wavelength_m", number(c.wavelength)},
                   {"limit", number(c.limit)},
                   {"worst", number(c.worst)},
                   {"figures", figures}});
  }
  return all;
}

Json to_json(const std::vector<RankShare> &shares)
{
  Json ranks = Json::array();
  for (const RankShare &s : shares)
    ranks.push_back({{"particles", s.particles},
                     {"halo_particles", s.halo_particles},
                     {"elements", s.elements},
                     {"nodes", s.nodes},
                     {"shared_nodes", s.shared_nodes},
                     {"particle_work", number(s.particle_work)},
                     {"element_work", number(s.element_work)},
                     {"messages_per_step", number(s.messages)},
                     {"bytes_per_step", number(s.bytes)},
                     {"joint_operations_per_step", number(s.together)},
                     {"solver_s", number(s.solver_s)},
                     {"waited_s", number(s.waited_s)},
                     {"memory_bytes", number(s.memory)}});
  return {{"imbalance",
           {{"particle_work", number(imbalance(shares, [](auto &s) { return s.particle_work; }))},
            {"element_work", number(imbalance(shares, [](auto &s) { return s.element_work; }))},
            {"solver_s", number(imbalance(shares, [](auto &s) { return s.solver_s; }))}}},
          {"ranks", ranks}};
}
} // namespace

std::optional<double> Summary::Quantity::relative_error() const
{
  if (!reference || *reference == 0)
    return {};
  return (value - *reference) / std::abs(*reference);
}

std::string to_json(const Summary &s)
{
  Json ledger = Json::object();
  for (const auto &[name, joule] : s.ledger)
    ledger[name] = number(joule);

  Json all = {{"scene", s.scene},
                    {"title", s.title},
                    {"version", s.version},
                    {"commit", s.commit},
                    {"ranks", s.ranks},
                    {"dimension", s.dimension},
                    {"wall_s", number(s.wall_s)},
                    {"core_s", number(s.core_s)},
                    {"steps", s.steps},
                    {"end_time_s", number(s.end_time_s)},
                    {"counts", {{"particles", s.particles}, {"elements", s.elements}}},
                    {"quantities", to_json(s.quantities)},
                    {"ledger", ledger},
                    {"checks", to_json(s.checks)},
                    {"throughput",
                     {{"sph_particle_steps_per_core_s", number(s.sph_particle_steps_per_core_s)},
                      {"fem_element_steps_per_core_s", number(s.fem_element_steps_per_core_s)},
                       {"fem_share_skipped", number(s.fem_share_skipped)}}},
                    {"limiter", to_json(s.limiter)},
                    {"certificates", to_json(s.certificates)},
                    {"warnings", s.warnings}};
  if (!s.shares.empty())
    all["parallel"] = to_json(s.shares);
  // A name of a body need not be valid UTF-8; a run must not fail on that at its end.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::string &path, const Summary &summary)
{
  write_whole(path, to_json(summary));
}
} // namespace ogive::io
