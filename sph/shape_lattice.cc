// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/shape_lattice.h"

#include "core/base/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::sph
{
namespace
{
using input::Nose;
using input::Shape;
using input::ShapeKind;

[[noreturn]] void refuse(const std::string &body, const std::string &why, const std::string &expected)
{
  throw InputError({"", 0, "Bodies/" + body + "/shape"}, why, expected);
}

/// Radius of the nose at distance s from its shoulder.
double nose_radius(const Shape &shape, double s)
{
  const double r = shape.radius, l = shape.nose_length, t = s / l;
  if (shape.nose == Nose::hemispherical)
    return r * std::sqrt(std::max(0., 1 - t * t));
  if (shape.nose == Nose::conical)
    return r * (1 - t);
  const double rho = (r * r + l * l) / (2 * r); // tangent ogive
  return std::sqrt(std::max(0., rho * rho - s * s)) + r - rho;
}

/// Volume (3-D) or area (2-D, the nose as a wedge) of the nose, Simpson.
double nose_volume(const Shape &shape, int dim)
{
  constexpr int n     = 4000;
  double        total = 0;
  for (int k = 0; k <= n; ++k)
  {
    const double r = nose_radius(shape, shape.nose_length * k / n);
    const double w = k == 0 || k == n ? 1 : k % 2 ? 4 : 2;
    total += w * (dim == 3 ? std::numbers::pi * r * r : 2 * r);
  }
  return total * shape.nose_length / (3. * n);
}

ShapeLattice box(const Shape &shape, double spacing, int dim, bool turned,
                 std::span<const input::SymmetryPlane> planes, const std::string &body)
{
  ShapeLattice out;
  Vec3         lower = shape.lower;
  for (const auto &p : planes)
    if (lower[p.axis] < 0)
    {
      lower[p.axis]       = 0;
      out.halved[p.axis]  = true;
    }
    else if (lower[p.axis] == 0)
      out.halved[p.axis] = true;
  std::array<int, 3> n{1, 1, 1};
  Vec3               step = Vec3::Zero();
  out.volume              = 1;
  double cell             = 1;
  for (int a = 0; a < dim; ++a)
  {
    const double length = shape.upper[a] - lower[a];
    if (!(length > 0))
      refuse(body, "the box is empty", "upper > lower, on the side x >= 0 of the symmetry planes");
    n[a]    = std::max(1, static_cast<int>(std::lround(length / spacing)));
    step[a] = length / n[a];
    out.volume *= turned && a == 0 ? std::numbers::pi * (shape.upper[a] + lower[a]) * length : length;
    cell *= step[a];
  }
  out.spacing = std::pow(cell, 1. / dim);
  out.cell    = step;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        Vec3 x = Vec3::Zero();
        for (int a = 0; a < dim; ++a)
          x[a] = lower[a] + step[a] * ((a == 0 ? i : a == 1 ? j : k) + .5);
        out.points.push_back(x);
      }
  return out;
}

/// A body of revolution, or its section in two dimensions: a profile over the
/// axial coordinate, in a frame that follows the coordinate axes where it can.
struct Round
{
  Shape       shape;
  int         dim;
  bool        axial; ///< has a length within the model
  Vec3        along = Vec3::Zero(), across[2];
  double      low = 0, high = 0; ///< axial range, nose included

  Round(const Shape &s, int dim_, bool turned)
    : shape(s)
    , dim(dim_)
  {
    const bool ball = s.kind == ShapeKind::sphere || s.kind == ShapeKind::shell;
    axial = !ball && (dim == 3 || turned || (s.kind == ShapeKind::cylinder && std::abs(s.axis.normalized()[2]) < .5));
    const bool nose = axial && s.kind == ShapeKind::cylinder && s.nose != Nose::blunt;
    if (nose && s.nose == Nose::hemispherical && !(s.nose_length > 0))
      shape.nose_length = s.radius;
    if (!nose)
      shape.nose = Nose::blunt;
    along = axial ? Vec3(s.axis.normalized()) : dim == 3 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
    low   = axial ? 0 : dim == 3 ? -s.radius : 0;
    high  = axial ? s.length + (nose ? shape.nose_length : 0.) : dim == 3 ? s.radius : 0;
    int smallest = 0;
    for (int a = 1; a < 3; ++a)
      if (std::abs(along[a]) < std::abs(along[smallest]))
        smallest = a;
    across[0] = dim == 2 && axial ? Vec3(Vec3::UnitZ().cross(along)) :
                                    Vec3((Vec3::Unit(smallest) - along[smallest] * along).normalized());
    across[1] = along.cross(across[0]);
  }

  bool inside(double s, double r) const
  {
    if (!axial)
    {
      const double d = std::hypot(s, r);
      return d < shape.radius && d > shape.inner_radius;
    }
    if (s < low || s > high)
      return false;
    return r < (s <= shape.length ? shape.radius : nose_radius(shape, s - shape.length)) &&
           (shape.inner_radius == 0 || r > shape.inner_radius);
  }

  double volume() const
  {
    const double pi = std::numbers::pi, r = shape.radius, q = shape.inner_radius;
    if (!axial)
      return dim == 3 ? 4 * pi / 3 * (r * r * r - q * q * q) : pi * (r * r - q * q);
    const double nose = shape.nose == Nose::blunt ? 0. : nose_volume(shape, dim);
    return nose + (dim == 3 ? pi * (r * r - q * q) : 2 * (r - q)) * (shape.length - low);
  }
};

/// Halves the shape at a plane through its centre, or shortens it at a plane
/// across its axis; the share of the volume that stays.
double clip(Round &round, int axis, const std::string &body, ShapeLattice &out)
{
  const double reach = 1e-9 * (round.shape.radius + round.shape.length), at = round.shape.base[axis];
  const double tilt = round.along[axis];
  if (round.axial && std::abs(tilt) > 1 - 1e-9)
  {
    const double end = at + tilt * (tilt > 0 ? round.low : round.high);
    if (end > reach)
      return 1;
    out.halved[axis] = true;
    if (end > -reach)
      return 1;
    if (tilt < 0)
      refuse(body, "a symmetry plane cuts the nose end", "an axis that points away from the plane");
    round.low = -at;
    if (!(round.low < round.shape.length))
      refuse(body, "nothing is left on the positive side of a symmetry plane", "a body with x >= 0");
    return 1;
  }
  if (at - round.shape.radius > -reach && std::abs(tilt) < 1e-9)
    return 1;
  if (std::abs(at) > reach || (round.axial && std::abs(tilt) > 1e-9))
    refuse(body, "a symmetry plane cuts a round body off its centre", "the plane through its axis or centre");
  out.halved[axis] = true;
  return .5;
}

/// Of the solid that a section turned about x = 0 stands for.
double turned_volume(const Shape &shape, std::span<const input::SymmetryPlane> planes, const std::string &body)
{
  ShapeLattice unused;
  Round        solid(shape, 3, true);
  double       share = 1;
  for (const auto &p : planes)
    if (p.axis != 0)
      share *= clip(solid, p.axis, body, unused);
  return share * solid.volume();
}

ShapeLattice round_body(const Shape &shape, double spacing, int dim, bool turned,
                        std::span<const input::SymmetryPlane> planes, const std::string &body)
{
  ShapeLattice out;
  Round        round(shape, dim, turned);
  double       share = 1;
  for (const auto &p : planes)
    share *= clip(round, p.axis, body, out);
  if (!(shape.radius > shape.inner_radius) || (round.axial && !(shape.length > 0)))
    refuse(body, "the shape is empty", "radius > inner radius and length > 0");
  out.volume = turned ? turned_volume(shape, planes, body) : share * round.volume();

  const double body_length = round.axial ? round.shape.length - round.low : 2 * shape.radius;
  const int    n_body      = std::max(1, static_cast<int>(std::lround(body_length / spacing)));
  const double step        = round.axial ? body_length / n_body : spacing;
  const bool   flat        = dim == 2 && !round.axial;
  const bool   line        = dim == 2 && round.axial;
  // A section fits its radius, or its wall, exactly.
  const double bore    = line ? shape.inner_radius : 0.;
  const int    n_wall  = std::max(1, static_cast<int>(std::lround((shape.radius - bore) / spacing)));
  const double across  = line ? (shape.radius - bore) / n_wall : spacing;
  const int    m       = line ? n_wall : static_cast<int>(std::ceil(shape.radius / spacing)) + 1;
  const int    first_s     = round.axial ? 0 : flat ? 0 : -m;
  const int    last_s      = round.axial ? static_cast<int>(std::ceil((round.high - round.low) / step)) : flat ? 1 : m;
  out.spacing = dim == 3 ? std::cbrt(spacing * spacing * step) : std::sqrt(across * (flat ? spacing : step));
  for (int a = 0; a < 3; ++a) // exact along the axes, the mean where the body lies askew
    out.cell[a] = round.axial ? std::hypot(round.along[a] * step, (Vec3::Unit(a) - round.along[a] * round.along).norm() * across) :
                                spacing;
  for (int k = first_s; k < last_s; ++k)
    for (int j = -m; j < m; ++j)
      for (int i = line ? 0 : -m; i < (line ? 1 : m); ++i)
      {
        const double s = flat ? 0. : round.low + (k + .5) * step - (round.axial ? 0. : round.low);
        const double u = j < 0 ? (j + .5) * across - bore : (j + .5) * across + bore;
        const double w = line ? 0. : (i + .5) * spacing;
        if (!round.inside(s, std::hypot(u, w)))
          continue;
        const Vec3 x    = shape.base + s * round.along + u * round.across[0] + w * round.across[1];
        bool       keep = true;
        for (const auto &p : planes)
          keep &= x[p.axis] > 0;
        if (keep)
          out.points.push_back(x);
      }
  return out;
}
} // namespace

ShapeLattice lattice_in(const Shape &shape, double spacing, int dim, bool turned,
                        std::span<const input::SymmetryPlane> scene_planes, const std::string &body)
{
  std::vector<input::SymmetryPlane> planes(scene_planes.begin(), scene_planes.end());
  if (turned)
    planes.push_back({0});

  if (!(spacing > 0))
    throw InputError({"", 0, "Bodies/" + body + "/spacing"}, "missing or not positive", "a length > 0");
  if (shape.kind == ShapeKind::mesh)
    refuse(body, "particles cannot fill a mesh file", "one of the named shapes, or method fem");
  if (dim == 1 && shape.kind != ShapeKind::box)
    refuse(body, "one dimension holds boxes only", "shape box");
  ShapeLattice out = shape.kind == ShapeKind::box ? box(shape, spacing, dim, turned, planes, body) :
                                                    round_body(shape, spacing, dim, turned, planes, body);
  if (out.points.empty())
    refuse(body, "no particle fits", "a spacing smaller than the body");
  return out;
}
} // namespace ogive::sph
