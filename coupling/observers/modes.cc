// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/modes.h"

#include "core/materials/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ogive::coupling
{
namespace
{
int body_of(const input::Observer &o, const input::Scene &scene)
{
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == o.body)
      return static_cast<int>(b);
  throw InputError("observer \"" + o.name + "\" names the body \"" + o.body +
                   "\", which is not in the scene");
}

const materials::Parameters &material_of(const input::Body &b, const input::Scene &scene)
{
  for (const materials::Parameters &m : scene.materials)
    if (m.name == b.material)
      return m;
  throw InputError("the body \"" + b.name + "\" is made of \"" + b.material +
                   "\", which is not in the scene");
}
} // namespace

StandingWave::StandingWave(const input::Body &b, const input::Scene &scene, const std::string &entry)
    : lower_(b.shape.lower[0])
{
  if (b.velocity_field != "standing-wave" || scene.dimension != input::Dimension::uniaxial)
    throw InputError({"", 0, entry},
                     "the body \"" + b.name + "\" does not start with a wave that can be followed",
                     "velocity field \"standing-wave\" in a uniaxial scene");
  const double length = b.shape.upper[0] - lower_;
  number_             = b.half_waves * std::numbers::pi / length;
  wavelength_         = 2 * length / b.half_waves;
  density_            = material_of(b, scene).density;
  sound_speed_        = materials::make_material(material_of(b, scene))->sound_speed();
}

double StandingWave::energy(const Sample &s, double dt) const
{
  double momentum = 0, mass = 0, stress = 0, volume = 0;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const double shape = std::cos(number_ * (s.x0[0][i] - lower_));
    momentum += s.mass[i] * shape * s.v[0][i];
    mass += s.mass[i] * shape * shape;
  }
  for (std::size_t i = 0; i < s.density.size(); ++i)
  {
    const double shape = std::sin(number_ * (s.centre0[0][i] - lower_));
    stress += s.volume[i] * shape * s.sigma[0][i];
    volume += s.volume[i] * shape * shape;
  }
  const double before = momentum / mass, sigma = stress / volume,
               after = before + dt * number_ * sigma / density_;
  return .5 * mass * before * after + .5 * volume * sigma * sigma / (density_ * sound_speed_ * sound_speed_);
}

WaveEnergy::WaveEnergy(const input::Observer &o, const input::Scene &scene)
    : body_(body_of(o, scene)), wave_(scene.bodies[body_], scene, "Observers/" + o.name + "/body")
{
}

void WaveEnergy::row(const RowFrame &frame)
{
  const double now = wave_.energy(frame.sample(body_), step_);
  if (start_ < 0)
    start_ = now;
  value_ = measure(now / start_, frame.time);
}

void WaveEnergy::recall(const std::vector<double> &numbers)
{
  step_  = numbers.at(0);
  start_ = numbers.at(1);
  value_ = numbers.at(2);
}

double WaveAmplitudeLoss::measure(double kept, double time) const
{
  return time > 0 ? 1 - std::pow(std::max(kept, 0.), .5 * wave().wavelength() / (wave().sound_speed() * time))
                  : 0.;
}

OscillationNoise::OscillationNoise(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene)
{
  if (scene.dimension != input::Dimension::uniaxial || scene.bodies[body()].method != input::Method::sph)
    throw InputError({"", 0, "Observers/" + o.name + "/body"},
                     "short waves are told apart in a row of particles only",
                     "a body with method sph in a uniaxial scene");
}

double OscillationNoise::measure(const Sample &s, double)
{
  const std::size_t        n = s.mass.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return s.x0[0][a] < s.x0[0][b]; });
  if (cosines_.empty())
    for (std::size_t k = n / 2 + 1; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i)
        cosines_.push_back(std::cos(std::numbers::pi * k * (i + .5) / n));
  std::vector<double> v(n);
  for (std::size_t i = 0; i < n; ++i)
    v[i] = s.v[0][order[i]];
  if (start_ < 0)
    start_ = std::inner_product(v.begin(), v.end(), v.begin(), 0.);
  double sum = 0;
  for (auto row = cosines_.begin(); row != cosines_.end(); row += static_cast<std::ptrdiff_t>(n))
  {
    const double c = std::inner_product(v.begin(), v.end(), row, 0.);
    sum += 2. / n * c * c;
  }
  return sum / start_;
}

void OscillationNoise::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  start_ = numbers.at(1);
}
} // namespace ogive::coupling
