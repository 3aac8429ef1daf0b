// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/cavity.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ogive::coupling
{
double BlakeCavity::speed() const
{
  return std::sqrt((lambda + 2 * shear) / density);
}

BlakeCavity::Potential BlakeCavity::at(double r, double t) const
{
  const double tau = t - (r - radius) / speed();
  if (tau <= 0)
    return {0, 0, 0};
  const double b2 = 4 * shear / (density * radius * radius), d = 2 * shear / (density * speed() * radius);
  const double w = std::sqrt(b2 - d * d), decay = std::exp(-d * tau), push = pressure * radius / density;
  const double f     = -push / b2 * (1 - decay * (std::cos(w * tau) + d / w * std::sin(w * tau)));
  const double slope = -push / w * decay * std::sin(w * tau);
  return {f, slope, -push - 2 * d * slope - b2 * f};
}

double BlakeCavity::displacement(double r, double t) const
{
  const Potential p = at(r, t);
  return -p.f / (r * r) - p.slope / (speed() * r);
}

// The equation of f, integrated once, gives the integral of f.
double BlakeCavity::displacement_integral(double r, double t) const
{
  const double tau = t - (r - radius) / speed();
  if (tau <= 0)
    return 0;
  const Potential p  = at(r, t);
  const double    b2 = 4 * shear / (density * radius * radius), d = 2 * shear / (density * speed() * radius);
  const double    integral = (-pressure * radius / density * tau - p.slope - 2 * d * p.f) / b2;
  return -integral / (r * r) - p.f / (speed() * r);
}

double BlakeCavity::displacement(double r, double t, const input::History &history) const
{
  double u = history.at(0) * displacement(r, t);
  for (std::size_t k = 1; k < history.time.size(); ++k)
  {
    const double begin = std::max(0., history.time[k - 1]), end = std::max(0., history.time[k]);
    const double slope = (history.factor[k] - history.factor[k - 1]) / (history.time[k] - history.time[k - 1]);
    u += slope * (displacement_integral(r, t - begin) - displacement_integral(r, t - end));
  }
  return u;
}

double BlakeCavity::radial_stress(double r, double t) const
{
  const Potential p = at(r, t);
  return density * p.curvature / r + 4 * shear * (p.slope / (speed() * r * r) + p.f / (r * r * r));
}

double BlakeCavity::hoop_stress(double r, double t) const
{
  const Potential p = at(r, t);
  return lambda / (speed() * speed()) * p.curvature / r + 2 * shear * displacement(r, t) / r;
}

namespace
{
struct Loaded
{
  BlakeCavity    cavity;
  input::History history;
};

Loaded cavity_of(const input::Observer &o, const input::Scene &scene)
{
  const auto refuse = [&](const std::string &wrong, const std::string &expected) {
    throw InputError({"", 0, "Observers/" + o.name + "/body"}, wrong, expected);
  };
  const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const auto &b) { return b.name == o.body; });
  if (body == scene.bodies.end() || body->shape.kind != input::ShapeKind::shell)
    refuse("the body is no shell", "a body with shape = shell");
  const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                     [&](const auto &m) { return m.name == body->material; });
  if (material == scene.materials.end() || material->strength.law != "elastic" || material->eos.law != "linear")
    refuse("the material is not linear elastic", "EOS law \"linear\" and strength law \"elastic\"");
  const input::Boundary *inside = nullptr;
  for (const auto &b : scene.boundaries)
    if (b.body == o.body && b.face == "inner" && b.kind == input::BoundaryKind::pressure)
    {
      if (inside)
        refuse("two pressures act inside", "one boundary of the body with face = inner and kind = pressure");
      inside = &b;
    }
  if (!inside)
    refuse("no pressure acts inside", "a boundary of the body with face = inner and kind = pressure");
  const double shear = material->shear_modulus;
  return {{body->shape.inner_radius, inside->pressure, material->density,
           material->eos.bulk_modulus - 2. / 3 * shear, shear},
          inside->history};
}
} // namespace

CavityError::CavityError(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene), centre_(scene.bodies.at(body()).shape.base)
{
  Loaded loaded = cavity_of(o, scene);
  cavity_       = loaded.cavity;
  history_      = std::move(loaded.history);
}

double CavityError::measure(const Sample &s, double time)
{
  double wrong = 0, whole = 0;
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const Vec3   from = at(s.x0, i) - centre_;
    const double r    = from.norm();
    if (r >= parameter())
      continue;
    const Vec3 exact = cavity_.displacement(std::max(r, cavity_.radius), time, history_) / r * from;
    wrong += s.mass[i] * (at(s.x, i) - at(s.x0, i) - exact).squaredNorm();
    whole += s.mass[i] * exact.squaredNorm();
  }
  return whole > 0 ? std::sqrt(wrong / whole) : std::numeric_limits<double>::quiet_NaN();
}
} // namespace ogive::coupling
