// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/entry.h"
#include "core/materials/parameters.h"

#include <cmath>

namespace ogive::materials
{
/// Isotropic constants from whatever pair the material gives, Pa; `none` where
/// it does not say. Throws InputError if the given ones contradict each other.
struct ElasticConstants
{
  double shear = none, bulk = none;

  static ElasticConstants of(const Parameters &p)
  {
    ElasticConstants c;
    const char      *why = "the elastic constants";
    const bool has_young = !std::isnan(p.young_modulus), has_ratio = !std::isnan(p.poisson_ratio);
    if (has_young)
      positive(p.young_modulus, "young modulus", why);
    if (has_ratio && !(p.poisson_ratio > -1 && p.poisson_ratio < .5))
      reject("poisson ratio", "is " + std::to_string(p.poisson_ratio), "-1 < value < 0.5");
    if (!std::isnan(p.shear_modulus))
      c.shear = not_negative(p.shear_modulus, "shear modulus", why);
    else if (has_young)
      c.shear = p.young_modulus / (2 * (1 + given(p.poisson_ratio, "poisson ratio", why)));

    if (!std::isnan(p.eos.bulk_modulus))
      c.bulk = positive(p.eos.bulk_modulus, "EOS/bulk modulus", why);
    else if (has_ratio && !std::isnan(c.shear))
      c.bulk = 2 * c.shear * (1 + p.poisson_ratio) / (3 * (1 - 2 * p.poisson_ratio));

    if (has_young && has_ratio && !std::isnan(p.shear_modulus))
      {
        const double expected = p.young_modulus / (2 * (1 + p.poisson_ratio));
        if (std::abs(expected - p.shear_modulus) > 1e-3 * expected)
          reject("shear modulus",
                 "contradicts the given young modulus and poisson ratio",
                 std::to_string(expected) + " Pa, or to leave one of the three out");
      }
    return c;
  }
};
} // namespace ogive::materials
