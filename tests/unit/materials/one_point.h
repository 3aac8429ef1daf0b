// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"

#include <cmath>
#include <string>

namespace ogive::materials::test
{
/// A copper-like material with a number for every law, so that any combination
/// of laws can be built from it. Values are chosen for the tests, not for copper.
inline Parameters parameters(const std::string &eos, const std::string &strength,
                             const std::string &damage = "none")
{
  Parameters p;
  p.name          = "test";
  p.density       = 8930;
  p.young_modulus = 117e9;
  p.poisson_ratio = .35;
  p.eos.law              = eos;
  p.eos.bulk_sound_speed = 3940;
  p.eos.slope            = 1.49;
  p.eos.gamma            = 1.9;
  p.strength.law               = strength;
  p.strength.yield_stress      = 90e6;
  p.strength.hardening_modulus = 250e6;
  p.strength.hardening         = 292e6;
  p.strength.exponent          = .31;
  p.strength.rate_coefficient  = .025;
  p.strength.thermal_exponent  = 1.09;
  p.strength.reference_rate    = 2.;
  p.damage.law = damage;
  p.damage.d1 = .4;
  p.damage.d2 = 1.1;
  p.damage.d3 = -.7;
  p.damage.d4 = .014;
  p.damage.d5 = .9;
  p.damage.critical        = .4;
  p.damage.reference_rate  = 3.;
  p.damage.failure_strain  = .35;
  p.damage.failure_tension = 1.2e9;
  p.thermal                = {383, 294, 1356, .9};
  return p;
}

inline double shear_modulus(const Parameters &p)
{
  return p.young_modulus / (2 * (1 + p.poisson_ratio));
}
inline double bulk_modulus(const Parameters &p)
{
  return p.young_modulus / (3 * (1 - 2 * p.poisson_ratio));
}

/// One point driven along a strain path, with its energy kept as a leapfrog
/// would: half of the step's work before the update, half after.
struct OnePoint
{
  std::unique_ptr<const Material> material;
  Points                          points;

  explicit OnePoint(const Parameters &p)
    : material(make_material(p))
  {
    points.resize(1);
    material->initialise(points, 0, 1);
  }

  /// `strain` = D dt and w = W dt of the middle of the step.
  Status step(const Sym3 &strain, double dt, double w_xy = 0, double w_yz = 0, double w_zx = 0)
  {
    const double e[6] = {strain.xx, strain.yy, strain.zz, strain.xy, strain.yz, strain.zx};
    const double w[3] = {w_xy, w_yz, w_zx};
    const double rho  = points.density[0] * std::exp(-strain.trace());
    Increments   inc{{e, e + 1, e + 2, e + 3, e + 4, e + 5}, {w, w + 1, w + 2}, &rho, dt};
    const double mass = points.density[0] + rho;
    points.energy[0] += stress().contract(strain) / mass;
    std::size_t  bad    = 99;
    const Status status = material->update(points, 0, 1, inc, bad);
    points.energy[0] += stress().contract(strain) / mass;
    return status;
  }

  Sym3   stress() const { return points.stress(0); }
  Sym3   deviator() const { return stress().deviator(); }
  double pressure() const { return -stress().trace() / 3; }
  double mises() const { return von_mises(deviator()); }
};
} // namespace ogive::materials::test
