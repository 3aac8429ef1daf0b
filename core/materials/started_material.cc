// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/started_material.h"

#include "core/base/error.h"
#include "core/materials/hugoniot.h"

#include <cmath>

namespace ogive::materials
{
StartedMaterial::StartedMaterial(std::shared_ptr<const Material> within, std::vector<StartState> states)
    : within_(std::move(within)), states_(std::move(states))
{
  for (const StartState &s : states_)
  {
    energy_.push_back(energy_at(parameters(), s.density, s.pressure));
    const double bulk = sound_speed_squared(parameters(), s.density, energy_.back());
    speed_.push_back(std::sqrt(bulk + 4. / 3. * shear_modulus() / s.density));
  }
}

std::shared_ptr<const StartedMaterial> StartedMaterial::of_points(const std::vector<std::size_t> &points) const
{
  std::vector<StartState> states;
  for (const std::size_t i : points)
    states.push_back(states_.at(i));
  return std::make_shared<const StartedMaterial>(within_, std::move(states));
}

void StartedMaterial::initialise(Points &points, std::size_t begin, std::size_t end) const
{
  require(end - begin == states_.size(), "one state a point");
  within_->initialise(points, begin, end);
  for (std::size_t i = begin; i < end; ++i)
  {
    const StartState &s   = states_[i - begin];
    points.density[i]     = s.density;
    points.energy[i]      = energy_[i - begin];
    points.sound_speed[i] = speed_[i - begin];
    for (int a = 0; a < 3; ++a)
      points.sigma[a][i] = -s.pressure;
  }
}
} // namespace ogive::materials
