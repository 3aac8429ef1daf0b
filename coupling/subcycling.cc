// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/subcycling.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
Subcycling::Subcycling(const input::Subcycling &given, bool both_solvers)
  : who_(given.who)
  , limit_(given.energy_limit)
{
  if (who_ == "none")
    return;
  if (!both_solvers)
    throw InputError({"", 0, "Subcycling/who"}, "only one of particles and elements is there: none can step more often",
                     "none, or a scene with bodies of method sph and of method fem");
  if (!(given.steps >= 1) || given.steps != std::floor(given.steps))
    throw InputError({"", 0, "Subcycling/steps"}, "a part of a step", "a whole number from 1 to 64");
  most_ = static_cast<std::size_t>(given.steps);
}

input::Subcycling Subcycling::settled(input::Subcycling given, double elements_dt, double particles_dt,
                                      bool elements_wait)
{
  constexpr double most = 8;
  if (given.who != "auto")
    return given;
  const double ratio = std::max(elements_dt, particles_dt) / std::min(elements_dt, particles_dt);
  const bool   wait  = particles_dt < elements_dt; // the elements
  given.who          = !(ratio >= 2) || (wait && !elements_wait) ? "none" : wait ? "particles" : "elements";
  given.steps        = given.who == "none" ? 1. : std::min(std::floor(ratio), most);
  return given;
}

StepLimit Subcycling::limit(const StepLimit &fine, const StepLimit &coarse) const
{
  // Whole parts of the finer bound: a part that is shorter than it may be costs
  // more than a longer step of the other saves.
  StepLimit whole = fine;
  if (on() && !state_.ended)
    whole.dt *= std::clamp(std::floor(coarse.dt / fine.dt), 1., static_cast<double>(most_));
  whole.tighten(coarse);
  return whole;
}

std::size_t Subcycling::parts(const TimeStep &whole, double fine_dt) const
{
  if (!on() || state_.ended)
    return 1;
  // A step of n parts of the bound must not need n + 1 by rounding.
  const double wanted = std::ceil(whole.drift / fine_dt * (1 - 1e-12));
  return std::clamp(static_cast<std::size_t>(std::max(wanted, 1.)), std::size_t(1), most_);
}

TimeStep Subcycling::part(const TimeStep &whole, std::size_t n, std::size_t j) const
{
  if (!on())
    return whole;
  const double drift = whole.drift / static_cast<double>(n);
  return {whole.time + static_cast<double>(j) * drift, (state_.last + drift) / 2, drift};
}

bool Subcycling::review(double error, const std::function<double()> &now)
{
  if (!on() || state_.ended)
    return false;
  state_.ended = std::abs(error) > limit_ * (reference_ > 0 ? reference_ : now());
  return state_.ended;
}

void Subcycling::save(ArchiveWriter &archive, const std::string &prefix) const
{
  if (!on())
    return;
  archive.write(prefix + "/last_part", state_.last);
  archive.write(prefix + "/ended", static_cast<std::int64_t>(state_.ended));
}

void Subcycling::load(const ArchiveReader &archive, const std::string &prefix)
{
  if (!on())
    return;
  state_.last  = archive.number(prefix + "/last_part");
  state_.ended = archive.integer(prefix + "/ended") != 0;
  kept_        = state_;
}
} // namespace ogive::coupling
