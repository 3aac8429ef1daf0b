// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/io/memory_archive.h"
#include "coupling/observers/observer.h"

#include <cmath>
#include <functional>
#include <string>

/// Samples made by hand, whose answer is known, as an observer sees them.
namespace ogive::coupling::synthetic
{
/// n particles along x in [lower, upper], of the given state.
struct Point
{
  double velocity = 0, pressure = 0, density = 1;
};

inline Sample row(double lower, double upper, int n, const std::function<Point(double x)> &state)
{
  Sample       s;
  const double step = (upper - lower) / n;
  for (int i = 0; i < n; ++i)
  {
    const double x = lower + (i + .5) * step;
    const Point  p = state(x);
    for (int a = 0; a < 3; ++a)
    {
      s.x[a].push_back(a == 0 ? x : 0.);
      s.v[a].push_back(a == 0 ? p.velocity : 0.);
    }
    for (int c = 0; c < 6; ++c)
      s.sigma[c].push_back(c < 3 ? -p.pressure : 0.);
    s.density.push_back(p.density);
    s.volume.push_back(step);
    s.mass.push_back(p.density * step);
    s.radius.push_back(.5 * step);
  }
  s.x0 = s.centre = s.centre0 = s.x;
  return s;
}

/// What an observer sees of one body.
inline RowFrame frame(double time, const Sample &s)
{
  RowFrame f;
  f.time   = time;
  f.sample = [&s](int) -> const Sample & { return s; };
  return f;
}

inline double seen(Observer &o, double time, const Sample &s)
{
  o.row(frame(time, s));
  return o.value();
}

/// A uniaxial scene of one body from -1 to 1 m.
inline input::Scene scene(const std::string &eos, const std::string &strength)
{
  input::Scene s;
  s.dimension = input::Dimension::uniaxial;
  materials::Parameters m;
  m.name         = "stuff";
  m.density      = 2;
  m.eos.law      = eos;
  m.strength.law = strength;
  s.materials.push_back(m);
  input::Body b;
  b.name        = "body";
  b.material    = "stuff";
  b.method      = input::Method::sph;
  b.shape.lower = {-1, 0, 0};
  b.shape.upper = {1, 0, 0};
  b.spacing     = .01;
  s.bodies.push_back(b);
  return s;
}

inline std::unique_ptr<Observer> observer(const std::string &quantity, const input::Scene &s,
                                          double parameter = 0)
{
  input::Observer o;
  o.name = o.quantity = quantity;
  o.body              = "body";
  o.parameter         = parameter;
  return make_observer(o, s);
}
} // namespace ogive::coupling::synthetic
