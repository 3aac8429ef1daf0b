// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/shape_geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

namespace ogive::input
{
namespace
{
/// In plane strain discs and rings are circles about their base.
bool is_plane_circle(const Shape &s, Dimension d)
{
  return d == Dimension::plane_strain && (s.kind == ShapeKind::disc || s.kind == ShapeKind::ring);
}

bool is_ball(const Shape &s)
{
  return s.kind == ShapeKind::sphere || s.kind == ShapeKind::shell;
}

/// Distances from the base along the axis that carry the outline.
std::vector<double> stations(const Shape &s)
{
  std::vector<double> t{0, s.length};
  const double        nose = total_length(s) - s.length;
  for (int k = 1; nose > 0 && k <= 16; ++k)
    t.push_back(s.length + nose * k / 16);
  return t;
}

constexpr double fractions[] = {.001, .1, .25, .5, .75, .9, .999};
} // namespace

double total_length(const Shape &s)
{
  if (s.kind != ShapeKind::cylinder || s.nose == Nose::blunt)
    return s.length;
  return s.length + (s.nose == Nose::hemispherical ? s.radius : s.nose_length);
}

double radius_at(const Shape &s, double t)
{
  const double x = t - s.length;
  if (x <= 0 || s.kind != ShapeKind::cylinder)
    return s.radius;
  switch (s.nose)
  {
    case Nose::blunt:
      return s.radius;
    case Nose::hemispherical:
      return std::sqrt(std::max(0., s.radius * s.radius - x * x));
    case Nose::conical:
      return s.radius * std::max(0., 1 - x / s.nose_length);
    case Nose::ogive:
    {
      // tangent ogive: an arc that leaves the shank without a kink
      const double arc = (s.radius * s.radius + s.nose_length * s.nose_length) / (2 * s.radius);
      return std::max(0., std::sqrt(std::max(0., arc * arc - x * x)) + s.radius - arc);
    }
  }
  return s.radius;
}

bool contains(const Shape &s, Dimension d, const Vec3 &p, double margin)
{
  if (s.kind == ShapeKind::mesh)
    return false;
  if (s.kind == ShapeKind::box)
  {
    for (int i = 0; i < space_dimension(d); ++i)
      if (p[i] <= s.lower[i] + margin || p[i] >= s.upper[i] - margin)
        return false;
    return true;
  }
  const Vec3   arm   = p - s.base;
  const bool   hollow = s.kind == ShapeKind::ring || s.kind == ShapeKind::shell;
  const double inner = hollow ? s.inner_radius + margin : -1;
  if (is_ball(s) || is_plane_circle(s, d))
    return arm.norm() < s.radius - margin && arm.norm() > inner;
  const double t = arm.dot(s.axis), r = (arm - t * s.axis).norm();
  return t > margin && t < total_length(s) - margin && r < radius_at(s, t) - margin && r > inner;
}

double support(const Shape &s, Dimension d, const Vec3 &n)
{
  if (s.kind == ShapeKind::box)
  {
    double h = 0;
    for (int i = 0; i < space_dimension(d); ++i)
      h += std::max(s.lower[i] * n[i], s.upper[i] * n[i]);
    return h;
  }
  if (is_ball(s) || is_plane_circle(s, d))
    return s.base.dot(n) + s.radius * n.norm();
  const double along = s.axis.dot(n), across = (n - along * s.axis).norm();
  double       h = -std::numeric_limits<double>::infinity();
  for (const double t : stations(s))
    h = std::max(h, s.base.dot(n) + t * along + radius_at(s, t) * across);
  return h;
}

BoundingBox bounding_box(const Shape &s, Dimension d)
{
  BoundingBox b{Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < space_dimension(d); ++i)
  {
    b.upper[i] = support(s, d, Vec3::Unit(i));
    b.lower[i] = -support(s, d, -Vec3::Unit(i));
  }
  if (d == Dimension::axisymmetric)
    b.lower.x() = std::max(0., b.lower.x());
  return b;
}

namespace
{
std::vector<Vec3> box_points(const Shape &s, int dim)
{
  std::vector<Vec3> points;
  const auto        at = [&](int axis, double f) {
    return axis < dim ? s.lower[axis] + f * (s.upper[axis] - s.lower[axis]) : 0.;
  };
  for (const double x : fractions)
    for (const double y : fractions)
      for (const double z : fractions)
        points.emplace_back(at(0, x), at(1, y), at(2, z));
  return points;
}

/// Points on circles about the axis, in the plane of the coordinates for two
/// dimensions.
void add_circle(std::vector<Vec3> &points, const Vec3 &centre, const Vec3 &axis, double r, Dimension d)
{
  constexpr int n = 16;
  const bool    plane = d != Dimension::three_d;
  const Vec3    u = plane && d == Dimension::axisymmetric ? Vec3(Vec3::UnitX()) : Vec3(axis.unitOrthogonal());
  const Vec3    w = axis.cross(u);
  for (int k = 0; k < (d == Dimension::axisymmetric ? 1 : n); ++k)
  {
    const double angle = 2 * std::numbers::pi * k / n;
    points.push_back(centre + r * (std::cos(angle) * u + std::sin(angle) * w));
  }
}
} // namespace

std::vector<Vec3> inner_points(const Shape &s, Dimension d)
{
  std::vector<Vec3> points;
  if (s.kind == ShapeKind::mesh)
    return points;
  if (s.kind == ShapeKind::box)
    return box_points(s, space_dimension(d));
  const bool   hollow = s.kind == ShapeKind::ring || s.kind == ShapeKind::shell;
  const double inner  = hollow ? s.inner_radius : 0;
  for (const double f : fractions)
  {
    if (is_plane_circle(s, d))
    {
      add_circle(points, s.base, Vec3::UnitZ(), inner + f * (s.radius - inner), d);
      continue;
    }
    for (const double g : fractions)
      if (is_ball(s))
      {
        const double r = inner + f * (s.radius - inner), angle = std::numbers::pi * g;
        const Vec3   pole = d == Dimension::three_d ? Vec3::UnitZ() : Vec3::UnitY();
        add_circle(points, s.base + r * std::cos(angle) * pole, pole, r * std::sin(angle), d);
      }
      else
      {
        const double t = g * total_length(s);
        add_circle(points, s.base + t * s.axis, s.axis, inner + f * (radius_at(s, t) - inner), d);
      }
  }
  return points;
}

bool find_overlap(const Shape &a, const Shape &b, const Scene &scene, Vec3 &point)
{
  const Dimension   d  = scene.dimension;
  const int         dim = space_dimension(d);
  const BoundingBox p = bounding_box(a, d), q = bounding_box(b, d);
  const Vec3        lower = p.lower.cwiseMax(q.lower), upper = p.upper.cwiseMin(q.upper);
  double            margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < dim; ++i)
    margin = std::min({margin, 1e-6 * (p.upper[i] - p.lower[i]), 1e-6 * (q.upper[i] - q.lower[i])});
  for (int i = 0; i < dim; ++i)
    if (upper[i] - lower[i] <= 2 * margin)
      return false;

  const auto in_both = [&](const Vec3 &x) {
    for (const SymmetryPlane &s : scene.symmetry)
      if (x[s.axis] < 0)
        return false;
    return contains(a, d, x, margin) && contains(b, d, x, margin);
  };
  std::vector<Vec3> candidates = inner_points(a, d);
  const auto        others     = inner_points(b, d);
  candidates.insert(candidates.end(), others.begin(), others.end());
  // odd, so that the middle of the common part is a point of the lattice
  constexpr int n = 21;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < (dim > 1 ? n : 1); ++j)
      for (int k = 0; k < (dim > 2 ? n : 1); ++k)
        candidates.push_back(lower +
                             Vec3((i + .5) / n, (j + .5) / n, (k + .5) / n).cwiseProduct(upper - lower));
  const auto hit = std::find_if(candidates.begin(), candidates.end(), in_both);
  if (hit == candidates.end())
    return false;
  point = *hit;
  return true;
}
} // namespace ogive::input
