// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/rank_share.h"

#include <array>
#include <cstdint>
#include <optional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ogive::io
{
/// What summary.json holds. A number that is not known, or not finite, is
/// written as null.
struct Summary
{
  struct Quantity
  {
    std::string           name; ///< snake_case, stable
    double                value = 0;
    std::string           unit;
    std::optional<double> reference; ///< same unit
    std::string           source;
    std::string           kind; ///< "exact", "code", "test", "memory"; empty without reference

    /// (value - reference)/|reference|; empty without a reference, or if it is 0.
    std::optional<double> relative_error() const;
  };

  /// Relative to the amounts at the start.
  struct Checks
  {
    double mass_drift = 0, momentum_drift = 0, angular_momentum_drift = 0, energy_drift = 0;
    double hourglass_fraction = 0; ///< of the internal energy
    double eroded_elements = 0, eroded_mass_share = 0;
    double gradient_fallbacks = 0; ///< most particles at once whose gradient was not corrected
    std::map<std::string, double> added_mass_fraction; ///< by mass scaling, of bodies that got any
  };

  /// Who set the step most often.
  struct Limiter
  {
    std::string           entity, body, why;
    std::int64_t          id    = -1;
    std::array<double, 3> where = {0, 0, 0}; ///< m
    double                dt    = 0;         ///< s
    double                share = 0;         ///< of all steps
  };

  /// What a seam reflects (coupling/certificate.h).
  struct Certificate
  {
    struct Figure
    {
      std::string wave, from; ///< "P" or "S"; body that it comes from
      double      wavelength = 0, reflection = 0; ///< m; share of the amplitude
    };
    std::string                interface, method;
    std::array<std::string, 2> bodies;
    std::array<double, 2>      sizes{};        ///< spacing or edge, m
    double                     wavelength = 0; ///< that the limit speaks of, m
    double                     limit = 0, worst = 0;
    std::vector<Figure>        figures;
  };

  std::string                                 scene, title, version, commit;
  int                                         ranks = 1;
  std::string                                 dimension;
  double                                      wall_s = 0, core_s = 0;
  std::int64_t                                steps = 0;
  double                                      end_time_s = 0;
  std::int64_t                                particles = 0, elements = 0;
  std::vector<Quantity>                       quantities;
  std::vector<std::pair<std::string, double>> ledger; ///< J
  Checks                                      checks;
  std::optional<double>                       sph_particle_steps_per_core_s, fem_element_steps_per_core_s;
  std::optional<double>                       fem_share_skipped; ///< of the element-steps: nothing had reached the elements
  std::optional<Limiter>                      limiter;
  std::vector<Certificate>                    certificates; ///< of seams that were looked at
  std::vector<std::string>                    warnings;
  std::vector<RankShare>                      shares; ///< of each rank; none where there is one
};

/// The text of summary.json, entries in the order above; "parallel" last, on several
/// ranks only.
std::string to_json(const Summary &);

/// Writes it as a whole. Throws RunError.
void write_summary(const std::string &path, const Summary &);
} // namespace ogive::io
