// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/summary.h"

#include "core/base/error.h"
#include "tests/unit/io/scratch.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace
{
using namespace ogive;
using io::Summary;
using Json = nlohmann::ordered_json;

using SummaryFile = ogive::test::Scratch;

Summary example()
{
  Summary s;
  s.scene      = "taylor-copper-227";
  s.title      = "A \"bar\"";
  s.dimension  = "3-d";
  s.steps      = std::int64_t{1} << 40;
  s.end_time_s = 8e-5;
  s.particles  = 12;
  s.quantities = {{.name = "final_length", .value = .0214, .unit = "m", .reference = .02142, .source = "a paper", .kind = "code"},
                  {.name = "foot_radius", .value = .0072, .unit = "m", .reference = {}, .source = {}, .kind = {}}};
  s.ledger     = {{"kinetic", 1.25}, {"plastic_work", std::nan("")}, {"contact", -INFINITY}};
  s.checks     = {.mass_drift = 1e-17, .energy_drift = std::nan("")};
  s.limiter    = Summary::Limiter{.entity = "element", .body = "bar", .why = "thin", .id = 3, .where = {.1, .2, .3}, .dt = 2e-8, .share = .75};
  return s;
}

TEST_F(SummaryFile, HasTheEntriesThatScriptsRelyOn)
{
  io::write_summary(in("summary.json"), example());
  const Json all = Json::parse(ogive::test::bytes_of(in("summary.json")));

  // The list of the command's documentation, in its order.
  std::vector<std::string> names;
  for (const auto &[name, value] : all.items())
    names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"scene", "title", "version", "commit", "ranks", "dimension", "wall_s", "core_s", "steps", "end_time_s", "counts", "quantities", "ledger", "checks", "throughput", "limiter", "certificates", "warnings"}));
  EXPECT_EQ(all["scene"], "taylor-copper-227");
  EXPECT_EQ(all["title"], "A \"bar\"");
  EXPECT_EQ(all["steps"], std::int64_t{1} << 40);
  EXPECT_EQ(all["end_time_s"], 8e-5);
  EXPECT_EQ(all["counts"]["particles"], 12);
  EXPECT_EQ(all["counts"]["elements"], 0);
  EXPECT_EQ(all["limiter"]["body"], "bar");
  EXPECT_EQ(all["checks"]["mass_drift"], 1e-17);
  EXPECT_TRUE(all["checks"].contains("hourglass_fraction"));
  for (const char *name : {"gradient_fallbacks", "eroded_elements", "eroded_mass_share"})
    EXPECT_TRUE(all["checks"].contains(name)) << name;
}

TEST_F(SummaryFile, ListsWhatSeamsReflect)
{
  Summary s = example();
  s.certificates.push_back({.interface = "seam", .method = "tied", .bodies = {"zone", "rest"}, .sizes = {1e-3, 2e-3},
                            .wavelength = .032, .limit = .1, .worst = .05, .figures = {{"P", "zone", .032, .05}}});
  const Json all = Json::parse(io::to_json(s))["certificates"];
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]["interface"], "seam");
  EXPECT_EQ(all[0]["bodies"], (Json{"zone", "rest"}));
  EXPECT_EQ(all[0]["limit"], .1);
  EXPECT_EQ(all[0]["figures"][0]["wave"], "P");
  EXPECT_EQ(all[0]["figures"][0]["reflection"], .05);
}

// Two of three ranks have 2 and 4 units of work: the most, 4, over the mean, 2.
TEST_F(SummaryFile, TellsHowRanksShareTheWork)
{
  Summary s = example();
  s.ranks   = 3;
  s.shares  = {{.particles = 10, .particle_work = 2}, {.particles = 20, .particle_work = 4, .messages = 2.5}, {}};
  const Json all = Json::parse(io::to_json(s))["parallel"];
  EXPECT_EQ(all["imbalance"]["particle_work"], 2.);
  EXPECT_EQ(all["imbalance"]["element_work"], 1.) << "none is even";
  ASSERT_EQ(all["ranks"].size(), 3u);
  EXPECT_EQ(all["ranks"][1]["particles"], 20);
  EXPECT_EQ(all["ranks"][1]["messages_per_step"], 2.5);
  EXPECT_FALSE(Json::parse(io::to_json(example())).contains("parallel"));
}

TEST_F(SummaryFile, ComparesWithTheReference)
{
  const Json q = Json::parse(io::to_json(example()))["quantities"];
  EXPECT_EQ(q["final_length"]["value"], .0214);
  EXPECT_NEAR(q["final_length"]["relative_error"].get<double>(), -.00002 / .02142, 1e-12);
  EXPECT_EQ(q["final_length"]["kind"], "code");
  for (const char *name : {"reference", "relative_error", "source", "kind"})
    EXPECT_TRUE(q["foot_radius"][name].is_null()) << name;

  // A negative reference: the error's sign is that of value - reference.
  EXPECT_DOUBLE_EQ(*(Summary::Quantity{.name = {}, .value = -3, .unit = {}, .reference = -4, .source = {}, .kind = {}}.relative_error()), .25);
  EXPECT_FALSE((Summary::Quantity{.name = {}, .value = 3, .unit = {}, .reference = 0, .source = {}, .kind = {}}.relative_error()));
}

TEST_F(SummaryFile, WhatIsNotFiniteIsNull)
{
  const std::string text = io::to_json(example());
  const Json        all  = Json::parse(text);
  EXPECT_EQ(all["ledger"]["kinetic"], 1.25);
  EXPECT_TRUE(all["ledger"]["plastic_work"].is_null());
  EXPECT_TRUE(all["ledger"]["contact"].is_null());
  EXPECT_TRUE(all["checks"]["energy_drift"].is_null());
  EXPECT_TRUE(all["throughput"]["sph_particle_steps_per_core_s"].is_null());
  EXPECT_TRUE(Json::parse(io::to_json({}))["limiter"].is_null());
}
} // namespace
