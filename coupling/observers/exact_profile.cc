// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/exact_profile.h"

#include "core/base/error.h"
#include "core/materials/hugoniot.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
ShockTube::ShockTube(double gamma, GasAtRest left, GasAtRest right)
    : gamma_(gamma), left_(left), right_(right)
{
  // the sum of both jumps grows with pressure and vanishes between the two
  double low = std::min(left.pressure, right.pressure), high = std::max(left.pressure, right.pressure);
  for (double middle = .5 * (low + high); middle > low && middle < high; middle = .5 * (low + high))
    (jump(left, middle) + jump(right, middle) < 0 ? low : high) = middle;
  pressure_ = high;
  velocity_ = .5 * (jump(right, high) - jump(left, high));
}

double ShockTube::sound(const GasAtRest &g) const
{
  return std::sqrt(gamma_ * g.pressure / g.density);
}

double ShockTube::jump(const GasAtRest &g, double p) const
{
  if (p > g.pressure)
    return (p - g.pressure) * std::sqrt(2 / (g.density * ((gamma_ + 1) * p + (gamma_ - 1) * g.pressure)));
  return 2 * sound(g) / (gamma_ - 1) * (std::pow(p / g.pressure, (gamma_ - 1) / (2 * gamma_)) - 1);
}

double ShockTube::reach(const GasAtRest &g) const
{
  const double ratio = pressure_ / g.pressure;
  return sound(g) * (ratio > 1 ? std::sqrt((gamma_ + 1) / (2 * gamma_) * (ratio - 1) + 1) : 1.);
}

ExactState ShockTube::behind(const GasAtRest &g, double contact, double s) const
{
  if (s >= reach(g))
    return {g.density, 0, g.pressure};
  const double ratio = pressure_ / g.pressure, c = sound(g);
  if (ratio > 1)
  {
    const double k = (gamma_ - 1) / (gamma_ + 1);
    return {g.density * (ratio + k) / (k * ratio + 1), contact, pressure_};
  }
  const double tail = contact + c * std::pow(ratio, (gamma_ - 1) / (2 * gamma_));
  if (s <= tail)
    return {g.density * std::pow(ratio, 1 / gamma_), contact, pressure_};
  const double share = (2 + (gamma_ - 1) * s / c) / (gamma_ + 1); // local sound speed over c
  return {g.density * std::pow(share, 2 / (gamma_ - 1)), 2 / (gamma_ + 1) * (s - c),
          g.pressure * std::pow(share, 2 * gamma_ / (gamma_ - 1))};
}

ExactState ShockTube::at(double s) const
{
  if (s >= velocity_)
    return behind(right_, velocity_, s);
  ExactState mirrored = behind(left_, -velocity_, -s);
  mirrored.velocity   = -mirrored.velocity;
  return mirrored;
}

namespace
{
class ClosingHalves final : public ExactProfile
{
public:
  ClosingHalves(const input::Body &b, const materials::Parameters &p)
      : middle_(.5 * (b.shape.lower[0] + b.shape.upper[0])), half_(b.shape.upper[0] - middle_),
        speed_(b.velocity_field_speed), drift_(b.velocity[0]),
        shock_(materials::hugoniot(p, speed_)), ahead_{p.density, 0, b.pressure}
  {
  }

  ExactState at(double x, double t) const override
  {
    const double d = x - middle_ - drift_ * t;
    if (std::abs(d) < (shock_.speed - speed_) * t)
      return {shock_.density, drift_, shock_.pressure};
    ExactState s = ahead_;
    s.velocity   = drift_ - std::copysign(speed_, d);
    return s;
  }

  double until() const override { return half_ / shock_.speed; }
  double greatest_pressure() const override { return shock_.pressure; }

private:
  double           middle_, half_, speed_, drift_;
  materials::Shock shock_;
  ExactState       ahead_;
};

class Tube final : public ExactProfile
{
public:
  Tube(const input::Body &b, const materials::Parameters &p)
      : plane_(b.step_plane), to_left_(plane_ - b.shape.lower[0]), to_right_(b.shape.upper[0] - plane_),
        greatest_(std::max(b.pressure, b.pressure_beyond)),
        tube_(p.eos.gamma, {p.density, b.pressure}, {b.density_beyond, b.pressure_beyond})
  {
  }

  ExactState at(double x, double t) const override { return tube_.at((x - plane_) / t); }
  double     until() const override
  {
    return std::min(to_left_ / tube_.reach_left(), to_right_ / tube_.reach_right());
  }
  double greatest_pressure() const override { return greatest_; }

private:
  double    plane_, to_left_, to_right_, greatest_;
  ShockTube tube_;
};
} // namespace

std::unique_ptr<ExactProfile> exact_profile(const input::Body &b, const input::Scene &scene,
                                            const std::string &entry)
{
  const auto refuse = [&](const std::string &wrong, const std::string &expected) {
    throw InputError({"", 0, entry}, wrong, expected);
  };
  const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                     [&](const materials::Parameters &m) { return m.name == b.material; });
  if (material == scene.materials.end())
    refuse("the body has no material", "one");
  if (b.velocity_field == "closing" && !b.has_step())
  {
    if (material->strength.law != "fluid")
      refuse("the exact shock is known for a fluid, and \"" + b.material + "\" carries shear",
             "a material with strength law \"fluid\"");
    if (!(b.velocity_field_speed > 0))
      refuse("the halves of the body do not approach", "a field speed > 0");
    return std::make_unique<ClosingHalves>(b, *material);
  }
  if (b.has_step() && b.velocity_field.empty() && b.velocity.isZero(0))
  {
    if (material->eos.law != "ideal-gas" || material->strength.law != "fluid" || !(b.pressure > 0))
      refuse("the exact shock tube is known for an ideal gas with a pressure on both sides",
             "a material with EOS law \"ideal-gas\" and strength law \"fluid\", and a pressure");
    return std::make_unique<Tube>(b, *material);
  }
  refuse("no exact solution is known for how the body \"" + b.name + "\" starts",
         "velocity field \"closing\", or a step plane at rest");
  return nullptr;
}
} // namespace ogive::coupling
