// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace ogive::input
{
/// A velocity field that sets up a wave, a shock or a flow: v = speed * shape(x).
struct WaveField
{
  const char *name;
  /// Largest length about 1.
  Vec3 (*shape)(const Body &, const Vec3 &x);
};

namespace wave_fields
{
inline Vec3 middle(const Shape &s)
{
  return .5 * (s.lower + s.upper);
}

inline Vec3 closing(const Body &b, const Vec3 &x)
{
  const double d = x[0] - middle(b.shape)[0];
  return (d > 0 ? -1. : d < 0 ? 1. : 0.) * Vec3::UnitX();
}

inline Vec3 converging(const Body &b, const Vec3 &x)
{
  const Shape &s = b.shape;
  Vec3         d = x - (s.kind == ShapeKind::box ? middle(s) : s.base);
  if (s.kind == ShapeKind::cylinder || s.kind == ShapeKind::disc || s.kind == ShapeKind::ring)
  {
    const Vec3 e = s.axis.normalized();
    d -= d.dot(e) * e;
  }
  const double r = d.norm();
  return r > 0 ? Vec3(-d / r) : Vec3(Vec3::Zero());
}

inline Vec3 standing_wave(const Body &b, const Vec3 &x)
{
  const double length = b.shape.upper[0] - b.shape.lower[0];
  return std::cos(b.half_waves * std::numbers::pi * (x[0] - b.shape.lower[0]) / length) * Vec3::UnitX();
}

inline Vec3 shear(const Body &b, const Vec3 &x)
{
  return 2 * (x[1] - middle(b.shape)[1]) / (b.shape.upper[1] - b.shape.lower[1]) * Vec3::UnitX();
}

inline Vec3 stretch(const Body &b, const Vec3 &x)
{
  return 2 * (x[0] - middle(b.shape)[0]) / (b.shape.upper[0] - b.shape.lower[0]) * Vec3::UnitX();
}

inline Vec3 draw(const Body &b, const Vec3 &x)
{
  const Vec3   d    = x - middle(b.shape);
  const double half = .5 * (b.shape.upper[0] - b.shape.lower[0]);
  int          across = 0;
  for (int a = 1; a < 3; ++a)
    across += b.shape.upper[a] > b.shape.lower[a];
  return Vec3(d[0], across > 0 ? -d[1] / across : 0., across > 1 ? -d[2] / across : 0.) / half;
}

inline Vec3 saw_tooth(const Body &b, const Vec3 &x)
{
  std::int64_t parity = 0;
  for (int a = 0; a < 3; ++a)
    if (const double length = b.shape.upper[a] - b.shape.lower[a]; length > 0)
    {
      const double step = length / std::max(1., std::round(length / b.spacing)); // as boxes are filled
      // particles lie in the middle of their cell, nodes at its lower end but for rounding
      parity += static_cast<std::int64_t>(std::floor((x[a] - b.shape.lower[a]) / step + 1e-6));
    }
  return (parity % 2 == 0 ? 1. : -1.) * Vec3::UnitX();
}

inline constexpr std::array fields{WaveField{"closing", closing}, WaveField{"converging", converging},
                                   WaveField{"standing-wave", standing_wave}, WaveField{"shear", shear},
                                   WaveField{"saw-tooth", saw_tooth}, WaveField{"stretch", stretch}, WaveField{"draw", draw}};
} // namespace wave_fields

///   closing        -sign(x - middle) along x: the halves of a box run at each other
///   converging     -r/|r|: towards the middle of a box, the centre of a sphere or
///                  shell, the axis of a cylinder, disc or ring
///   standing-wave  cos(n pi (x - lower)/length) along x, n = Body::half_waves: a
///                  mode of a bar with free ends
///   shear          2 (y - middle)/height along x
///   stretch        2 (x - middle)/length along x: the ends of a box run apart at
///                  +-1; a speed below 0 compresses
///   draw           the same, and drawing in across it so that the volume stays
///   saw-tooth      +-1 along x, from one particle or node of a box to the next (in
///                  2-D and 3-D as on a chessboard): what a central difference, or
///                  an element of one point, cannot see
/// Null for another name.
inline const WaveField *find_wave_field(const std::string &name)
{
  const auto found = std::find_if(wave_fields::fields.begin(), wave_fields::fields.end(),
                                  [&](const WaveField &f) { return name == f.name; });
  return found == wave_fields::fields.end() ? nullptr : &*found;
}
} // namespace ogive::input
