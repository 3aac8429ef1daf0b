// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"

#include <memory>
#include <vector>

namespace ogive::materials
{
/// At the start, of one point.
struct StartState
{
  double density;  ///< kg/m^3
  double pressure; ///< Pa, made by heat
};

/// A material whose points start in given states instead of undeformed and at
/// rest; in all else it is the one within. Its `initialise` takes as many points
/// as there are states, in their order.
class StartedMaterial final : public Material
{
public:
  /// InputError (without a place) where no heat makes such a pressure.
  StartedMaterial(std::shared_ptr<const Material>, std::vector<StartState>);

  /// The same for some of the points, those that are named, in their order.
  std::shared_ptr<const StartedMaterial> of_points(const std::vector<std::size_t> &) const;

  void   initialise(Points &, std::size_t begin, std::size_t end) const override;
  Status update(Points &p, std::size_t begin, std::size_t end, const Increments &inc,
                std::size_t &bad) const override
  {
    return within_->update(p, begin, end, inc, bad);
  }
  const Parameters &parameters() const override { return within_->parameters(); }
  double            sound_speed() const override { return within_->sound_speed(); }
  double            bulk_modulus() const override { return within_->bulk_modulus(); }
  double            shear_modulus() const override { return within_->shear_modulus(); }

private:
  std::shared_ptr<const Material> within_;
  std::vector<StartState>         states_;
  std::vector<double>             energy_, speed_; ///< J/kg; longitudinal sound speed, m/s
};
} // namespace ogive::materials
