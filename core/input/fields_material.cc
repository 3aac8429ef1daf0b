// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/declarations.h"
#include "core/input/scene_fields.h"
#include "core/materials/laws.h"

#include <algorithm>
#include <cmath>

namespace ogive::input
{
namespace
{
using materials::Parameters;

constexpr units::Dimension per_second = units::rate;

// Which numbers a law needs is known to the law: it is built once when the
// material is read, and what it misses is reported in the file's terms.
void eos_fields(Fields &f, materials::EosParameters &e)
{
  f.enter("EOS");
  f.choice({"law", "equation of state", Need::mandatory}, e.law, materials::eos_laws());
  f.quantity({"bulk modulus", "linear: bulk modulus, by default from the elastic constants"}, e.bulk_modulus,
             units::pressure, bounds::positive);
  f.quantity({"bulk sound speed", "mie-grueneisen: c0 of U_s = c0 + s u_p"}, e.bulk_sound_speed, units::velocity,
             bounds::positive);
  f.number({"slope", "mie-grueneisen: s of U_s = c0 + s u_p"}, e.slope, bounds::not_negative);
  f.number({"gamma", "mie-grueneisen: Grueneisen parameter; ideal-gas: adiabatic exponent"}, e.gamma,
           bounds::not_negative);
  f.quantity({"tension cutoff", "greatest tensile mean stress"}, e.tension_cutoff, units::pressure,
             bounds::not_negative);
  f.leave();
}

void strength_fields(Fields &f, materials::StrengthParameters &s)
{
  f.enter("Strength");
  f.choice({"law", "strength law", Need::mandatory}, s.law, materials::strength_laws());
  f.quantity({"yield stress", "initial yield stress; A of Johnson and Cook"}, s.yield_stress, units::pressure,
             bounds::not_negative);
  f.quantity({"hardening modulus", "linear-hardening: slope of the yield stress over plastic strain"},
             s.hardening_modulus, units::pressure);
  f.quantity({"hardening", "johnson-cook: B"}, s.hardening, units::pressure, bounds::not_negative);
  f.number({"exponent", "johnson-cook: n"}, s.exponent, bounds::positive);
  f.number({"rate coefficient", "johnson-cook: C"}, s.rate_coefficient, bounds::not_negative);
  f.number({"thermal exponent", "johnson-cook: m"}, s.thermal_exponent, bounds::positive);
  f.quantity({"reference rate", "johnson-cook: strain rate at which C does not act"}, s.reference_rate, per_second,
             bounds::positive);
  f.leave();
}

void damage_fields(Fields &f, materials::DamageParameters &d)
{
  f.enter("Damage");
  f.choice({"law", "damage law"}, d.law, materials::damage_laws());
  f.number({"d1", "johnson-cook: D1"}, d.d1);
  f.number({"d2", "johnson-cook: D2"}, d.d2);
  f.number({"d3", "johnson-cook: D3"}, d.d3);
  f.number({"d4", "johnson-cook: D4"}, d.d4);
  f.number({"d5", "johnson-cook: D5"}, d.d5);
  f.number({"critical", "damage at which a point has failed"}, d.critical, bounds::positive_fraction);
  f.quantity({"reference rate", "johnson-cook: strain rate at which D4 does not act"}, d.reference_rate, per_second,
             bounds::positive);
  f.number({"failure strain", "plastic-strain: plastic strain at failure"}, d.failure_strain, bounds::positive);
  f.quantity({"failure tension", "tension: tensile mean stress at failure"}, d.failure_tension, units::pressure,
             bounds::positive);
  f.leave();
}

void thermal_fields(Fields &f, materials::ThermalParameters &t)
{
  f.enter("Thermal");
  f.quantity({"specific heat", "heat capacity per mass"}, t.specific_heat, units::specific_heat, bounds::positive);
  f.quantity({"reference temperature", "temperature at the start, and that of the strength law"},
             t.reference_temperature, units::temperature, bounds::positive);
  f.quantity({"melt temperature", "temperature without strength"}, t.melt_temperature, units::temperature,
             bounds::positive);
  f.number({"taylor-quinney", "share of the plastic work that heats"}, t.taylor_quinney, bounds::fraction);
  f.leave();
}

void physics_fields(Fields &f, Parameters &p)
{
  f.quantity({"density", "density at rest", Need::mandatory}, p.density, units::density, bounds::positive);
  f.quantity({"young modulus", "Young's modulus"}, p.young_modulus, units::pressure, bounds::positive);
  f.number({"poisson ratio", "Poisson's ratio"}, p.poisson_ratio, Bound{-1, .5, true, true});
  f.quantity({"shear modulus", "by default from Young's modulus and Poisson's ratio"}, p.shear_modulus, units::pressure,
             bounds::positive);
  eos_fields(f, p.eos);
  strength_fields(f, p.strength);
  damage_fields(f, p.damage);
  thermal_fields(f, p.thermal);
}

/// One optional line for each number of the material.
void source_fields(Fields &f, Parameters &p)
{
  static const std::vector<std::string> entries = [] {
    Names      names;
    Parameters any;
    physics_fields(names, any);
    return names.names();
  }();
  f.enter("Sources");
  for (const std::string &entry : entries)
  {
    materials::Source source{entry, {}, {}};
    const auto        known = std::find_if(p.sources.begin(), p.sources.end(),
                                           [&](const materials::Source &s) { return s.entry == entry; });
    const bool        new_one = known == p.sources.end();
    materials::Source &s      = new_one ? source : *known;
    f.source({entry, "where the value comes from"}, s.kind, s.text);
    if (new_one && !source.kind.empty())
      p.sources.push_back(source);
  }
  f.leave();
}

void range_fields(Fields &f, Parameters &p)
{
  const std::pair<const char *, units::Dimension> variables[] = {{"plastic strain", units::none},
                                                                 {"strain rate", units::rate},
                                                                 {"temperature", units::temperature},
                                                                 {"pressure", units::pressure}};
  f.enter("Ranges");
  for (const auto &[what, dimension] : variables)
  {
    materials::Range  range{what, materials::none, materials::none};
    const auto        known   = std::find_if(p.ranges.begin(), p.ranges.end(),
                                             [&, w = what](const materials::Range &r) { return r.what == w; });
    const bool        new_one = known == p.ranges.end();
    materials::Range &r       = new_one ? range : *known;
    f.range({what, "range in which the constants were fitted or checked"}, r.low, r.high, dimension);
    if (new_one && !std::isnan(range.low))
      p.ranges.push_back(range);
  }
  f.leave();
}
} // namespace

void material_fields(Fields &f, Parameters &p)
{
  f.text({"title", "what the material is"}, p.title);
  physics_fields(f, p);
  source_fields(f, p);
  range_fields(f, p);
}
} // namespace ogive::input
