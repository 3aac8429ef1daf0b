// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/hugoniot.h"

#include "core/materials/laws.h"

#include <cmath>
#include <limits>

namespace ogive::materials
{
namespace
{
EosResponse<double> respond(const Parameters &p, double density, double energy)
{
  const AnyEos eos = Laws<AnyEos>::build(p.eos.law, p, "EOS/law");
  return std::visit([&](const auto &law) { return law.at(density, energy); }, eos);
}
} // namespace

Shock hugoniot(const Parameters &p, double u)
{
  if (p.strength.law != Fluid::name)
    reject("Strength/law", "is \"" + p.strength.law + "\"",
           "\"fluid\": only its shock is known in closed form");
  const AnyEos eos    = Laws<AnyEos>::build(p.eos.law, p, "EOS/law");
  const double energy = .5 * u * u;
  // grows with density as far as the equation of state reaches
  const auto excess = [&](double density)
  {
    const EosResponse<double> r = std::visit([&](const auto &law) { return law.at(density, energy); }, eos);
    return r.sound_speed_squared > 0 ? r.pressure * (1 / p.density - 1 / density) - u * u
                                     : std::numeric_limits<double>::infinity();
  };
  double low = p.density, high = 2 * p.density;
  while (excess(high) < 0 && high < 1e6 * p.density)
    high *= 2;
  if (!(excess(high) >= 0))
    reject("EOS/law", "has no shock to " + std::to_string(u) + " m/s", "a smaller velocity");
  for (double middle = .5 * (low + high); middle > low && middle < high; middle = .5 * (low + high))
    (excess(middle) < 0 ? low : high) = middle;
  const double pressure = std::visit([&](const auto &law) { return law.at(low, energy); }, eos).pressure;
  return {low, pressure, pressure / (p.density * u)};
}

double cold_pressure(const Parameters &p, double density)
{
  return respond(p, density, 0.).pressure;
}

double energy_at(const Parameters &p, double density, double pressure)
{
  const double unit  = pressure > 0 ? pressure / density : 1.; // an energy of about the right size
  const double zero  = respond(p, density, 0.).pressure;
  if (pressure == zero)
    return 0;
  const double slope = (respond(p, density, unit).pressure - zero) / unit;
  if (!(slope > 0))
    throw InputError("the law \"" + p.eos.law + "\" has one pressure at each density, whatever the heat");
  return (pressure - zero) / slope;
}

double sound_speed_squared(const Parameters &p, double density, double energy)
{
  return respond(p, density, energy).sound_speed_squared;
}
} // namespace ogive::materials
