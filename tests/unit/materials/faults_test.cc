// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "core/materials/laws.h"
#include "one_point.h"

#include <gtest/gtest.h>

#include <functional>

namespace ogive::materials
{
namespace
{
std::string refusal(const Parameters &p)
{
  try
    {
      make_material(p);
    }
  catch (const InputError &e)
    {
      return e.what();
    }
  return "";
}
} // namespace

TEST(Faults, MissingOrImpossibleNumbersAreNamed)
{
  using Spoil = std::function<void(Parameters &)>;
  struct Case
  {
    std::string eos, strength, damage, entry;
    Spoil       spoil;
  };
  const std::string jc = "johnson-cook";
  const std::vector<Case> cases = {
    {"linear", "elastic", "none", "density", [](Parameters &p) { p.density = none; }},
    {"linear", "elastic", "none", "density", [](Parameters &p) { p.density = -1; }},
    {"linear", "elastic", "none", "density", [](Parameters &p) { p.density = HUGE_VAL; }},
    {"linear", "elastic", "none", "EOS/bulk modulus", [](Parameters &p) { p.young_modulus = none; }},
    {"linear", "elastic", "none", "poisson ratio", [](Parameters &p) { p.poisson_ratio = none; }},
    {"linear", "elastic", "none", "poisson ratio", [](Parameters &p) { p.poisson_ratio = .5; }},
    {"linear", "elastic", "none", "young modulus", [](Parameters &p) { p.young_modulus = 0; }},
    {"linear", "elastic", "none", "shear modulus", [](Parameters &p) { p.shear_modulus = 10e9; }},
    {"mie-grueneisen", "elastic", "none", "shear modulus", [](Parameters &p) { p.young_modulus = none; }},
    {"mie-grueneisen", "fluid", "none", "EOS/bulk sound speed", [](Parameters &p) { p.eos.bulk_sound_speed = none; }},
    {"mie-grueneisen", "fluid", "none", "EOS/slope", [](Parameters &p) { p.eos.slope = none; }},
    {"mie-grueneisen", "fluid", "none", "EOS/gamma", [](Parameters &p) { p.eos.gamma = none; }},
    {"ideal-gas", "fluid", "none", "EOS/gamma", [](Parameters &p) { p.eos.gamma = 1; }},
    {"linear", "elastic", "none", "EOS/tension cutoff", [](Parameters &p) { p.eos.tension_cutoff = -1; }},
    {"linear", "perfect-plastic", "none", "Strength/yield stress", [](Parameters &p) { p.strength.yield_stress = none; }},
    {"linear", "linear-hardening", "none", "Strength/hardening modulus", [](Parameters &p) { p.strength.hardening_modulus = none; }},
    {"linear", jc, "none", "Strength/yield stress", [](Parameters &p) { p.strength.yield_stress = 0; }},
    {"linear", jc, "none", "Strength/hardening", [](Parameters &p) { p.strength.hardening = none; }},
    {"linear", jc, "none", "Strength/exponent", [](Parameters &p) { p.strength.exponent = none; }},
    {"linear", jc, "none", "Strength/rate coefficient", [](Parameters &p) { p.strength.rate_coefficient = none; }},
    {"linear", jc, "none", "Strength/thermal exponent", [](Parameters &p) { p.strength.thermal_exponent = none; }},
    {"linear", jc, "none", "Strength/reference rate", [](Parameters &p) { p.strength.reference_rate = 0; }},
    {"linear", jc, "none", "Thermal/specific heat", [](Parameters &p) { p.thermal.specific_heat = none; }},
    {"linear", jc, "none", "Thermal/melt temperature", [](Parameters &p) { p.thermal.melt_temperature = none; }},
    {"linear", jc, "none", "Thermal/melt temperature", [](Parameters &p) { p.thermal.melt_temperature = 294; }},
    {"linear", jc, "none", "Thermal/reference temperature", [](Parameters &p) { p.thermal.reference_temperature = none; }},
    {"linear", jc, "none", "Thermal/taylor-quinney", [](Parameters &p) { p.thermal.taylor_quinney = 1.1; }},
    {"linear", jc, jc, "Damage/d1", [](Parameters &p) { p.damage.d1 = none; }},
    {"linear", jc, jc, "Damage/d5", [](Parameters &p) { p.damage.d5 = none; }},
    {"linear", jc, jc, "Damage/critical", [](Parameters &p) { p.damage.critical = 1.5; }},
    {"linear", jc, jc, "Damage/reference rate", [](Parameters &p) { p.damage.reference_rate = none; }},
    {"linear", jc, "plastic-strain", "Damage/failure strain", [](Parameters &p) { p.damage.failure_strain = none; }},
    {"linear", jc, "tension", "Damage/failure tension", [](Parameters &p) { p.damage.failure_tension = none; }},
    {"linar", jc, "none", "EOS/law", [](Parameters &) {}},
    {"", jc, "none", "EOS/law", [](Parameters &) {}},
    {"linear", "plastic", "none", "Strength/law", [](Parameters &) {}},
    {"linear", jc, "spall", "Damage/law", [](Parameters &) {}},
  };
  for (const Case &c : cases)
    {
      Parameters p = test::parameters(c.eos, c.strength, c.damage);
      c.spoil(p);
      EXPECT_EQ(refusal(p).substr(0, c.entry.size() + 2), "\"" + c.entry + "\"") << refusal(p);
    }
  EXPECT_NE(refusal(test::parameters("linar", jc)).find("linear, mie-grueneisen, ideal-gas"),
            std::string::npos);
}

TEST(Faults, LawsAskOnlyForWhatTheyNeed)
{
  Parameters p;
  p.density      = 1.2;
  p.eos.law      = "ideal-gas";
  p.eos.gamma    = 1.4;
  p.strength.law = "fluid";
  EXPECT_EQ(refusal(p), "");
  p.eos.law          = "linear";
  p.eos.bulk_modulus = 2e9;
  p.strength.law     = "elastic";
  p.shear_modulus    = 1e9;
  EXPECT_EQ(refusal(p), "");
}

// One spoilt value in a block of good ones: found, named, and at the right index.
TEST(Faults, SpoiltValuesAreFoundInABlock)
{
  const Parameters  p = test::parameters("mie-grueneisen", "johnson-cook", "johnson-cook");
  const auto        m = make_material(p);
  const std::size_t n = 150, begin = 5, victim = 101;
  struct Block
  {
    Points                                      points;
    std::array<std::vector<double>, 6>          e;
    std::array<std::vector<double>, 3>          w;
    std::vector<double>                         rho;
  };
  const double nan = std::nan(""), inf = HUGE_VAL;
  using Spoil      = std::function<void(Block &)>;
  const std::vector<std::pair<Spoil, Status>> cases = {
    {[](Block &) {}, Status::ok},
    {[&](Block &b) { b.e[4][victim - begin] = nan; }, Status::not_finite},
    {[&](Block &b) { b.e[0][victim - begin] = inf; }, Status::not_finite},
    {[&](Block &b) { b.w[1][victim - begin] = nan; }, Status::not_finite},
    {[&](Block &b) { b.rho[victim - begin] = nan; }, Status::not_finite},
    {[&](Block &b) { b.rho[victim - begin] = 0; }, Status::density_not_positive},
    {[&](Block &b) { b.rho[victim - begin] = -3; }, Status::density_not_positive},
    {[&](Block &b) { b.rho[victim - begin] = 4 * 8930; }, Status::sound_speed_imaginary},
    {[&](Block &b) { b.points.sigma[3][victim] = nan; }, Status::not_finite},
    {[&](Block &b) { b.points.energy[victim] = nan; }, Status::not_finite},
    {[&](Block &b) { b.points.energy[victim] = -inf; }, Status::not_finite},
    {[&](Block &b) { b.points.damage[victim] = nan; }, Status::not_finite},
    {[&](Block &b) { b.points.plastic_strain[victim] = nan; }, Status::not_finite},
    {[&](Block &b) { b.points.temperature[victim] = nan; }, Status::not_finite},
    {[&](Block &b) { b.points.energy[victim] = -5e7; }, Status::sound_speed_imaginary},
  };
  for (std::size_t k = 0; k < cases.size(); ++k)
    {
      Block b;
      b.points.resize(begin + n);
      m->initialise(b.points, 0, begin + n);
      for (auto &a : b.e)
        a.assign(n, 3e-4);
      for (auto &a : b.w)
        a.assign(n, 1e-3);
      b.rho.assign(n, 8930 * std::exp(-9e-4));
      cases[k].first(b);
      Increments inc;
      for (int a = 0; a < 6; ++a)
        inc.strain[a] = b.e[a].data();
      for (int a = 0; a < 3; ++a)
        inc.spin[a] = b.w[a].data();
      inc.density     = b.rho.data();
      inc.dt          = 1e-7;
      std::size_t bad = 0;
      EXPECT_EQ(m->update(b.points, begin, begin + n, inc, bad), cases[k].second) << "case " << k;
      if (k > 0)
        {
          EXPECT_EQ(bad, victim) << "case " << k;
        }
    }
}

TEST(Faults, EveryStatusIsDescribed)
{
  for (const Status s : {Status::ok, Status::not_finite, Status::density_not_positive,
                         Status::sound_speed_imaginary})
    EXPECT_STRNE(describe(s), "unknown");
}
} // namespace ogive::materials
