// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_shapes.h"

#include "core/base/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::fem
{
namespace
{
using blocks::Raw;
using dealii::Point;
using input::ShapeKind;

double far_of(const input::Body &body)
{
  return body.spacing_far > 0 ? body.spacing_far : body.spacing;
}

bool symmetric(const input::Scene &scene, int axis)
{
  return std::any_of(scene.symmetry.begin(), scene.symmetry.end(),
                     [axis](const auto &plane) { return plane.axis == axis; });
}

unsigned int count(double length, double spacing)
{
  return static_cast<unsigned int>(std::max(1., std::round(length / spacing)));
}

double nose_length(const input::Shape &shape)
{
  if (shape.nose == input::Nose::blunt || shape.kind != ShapeKind::cylinder)
    return 0;
  return shape.nose == input::Nose::hemispherical && shape.nose_length <= 0 ? shape.radius : shape.nose_length;
}

/// Height of the column over the section point at distance r, and of the tallest.
double column(const input::Shape &shape, double r)
{
  return shape.length + (nose_length(shape) > 0 ? nose_height(shape, r) : 0.);
}

std::vector<double> levels(const input::Body &body)
{
  const unsigned int  n = count(body.shape.length + nose_length(body.shape), body.spacing);
  std::vector<double> z(n + 1);
  for (unsigned int i = 0; i <= n; ++i)
    z[i] = body.shape.length * i / n;
  return z;
}

bool has_bore(const input::Shape &shape)
{
  return shape.kind == ShapeKind::ring || shape.kind == ShapeKind::shell;
}

/// Names of the faces of a body of revolution; q gives radius and height of a
/// point (for spheres: distance from the centre and 0).
template <int dim>
auto round_names(const input::Body &body, std::function<std::array<double, 2>(const Point<dim> &)> q)
{
  const input::Shape shape     = body.shape;
  const double       tolerance = 1e-6 * body.spacing;
  const bool         ball      = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::shell;
  return [=](const std::vector<Point<dim>> &corners) -> std::string {
    const auto all = [&](auto &&test) {
      return std::all_of(corners.begin(), corners.end(), [&](const Point<dim> &p) { return test(q(p)); });
    };
    if (has_bore(shape) && all([&](auto s) { return std::abs(s[0] - shape.inner_radius) < tolerance; }))
      return "inner";
    if (all([&](auto s) { return std::abs(s[0] - shape.radius) < tolerance; }))
      return has_bore(shape) || ball ? "outer" : "side";
    if (!ball && all([&](auto s) { return std::abs(s[1]) < tolerance; }))
      return "bottom";
    return "top";
  };
}

/// Quadrants or octants to keep when local directions e_i lie along the normals
/// of symmetry planes through the body's base.
blocks::Kept kept_parts(const input::Body &body, const input::Scene &scene, const std::array<Vec3, 3> &e)
{
  blocks::Kept kept;
  for (const auto &plane : scene.symmetry)
    for (int i = 0; i < 3; ++i)
      if (std::abs(std::abs(e[i][plane.axis]) - 1) < 1e-9 &&
          std::abs(body.shape.base[plane.axis]) < 1e-9 * body.spacing)
        (e[i][plane.axis] > 0 ? kept.negative : kept.positive)[i] = false;
  return kept;
}

template <int dim>
ShapeMesh<dim> box(const input::Body &body, const input::Scene &scene)
{
  std::array<unsigned int, dim> n;
  std::array<double, dim>       low, high;
  for (int i = 0; i < dim; ++i)
  {
    low[i]  = body.shape.lower[i];
    high[i] = body.shape.upper[i];
    if (symmetric(scene, i))
      low[i] = std::max(low[i], 0.);
    if (!(high[i] > low[i]))
      throw InputError({"", 0, body.name}, "the box is empty on the kept side of the symmetry planes");
    n[i] = count(high[i] - low[i], body.spacing);
  }
  ShapeMesh<dim> mesh;
  mesh.raw.add(n, [&](const Point<dim> &u) {
    Point<dim> p;
    for (int i = 0; i < dim; ++i)
      p[i] = u[i] == 1 ? high[i] : low[i] + u[i] * (high[i] - low[i]);
    return p;
  });
  mesh.face_name = [low, high, tolerance = 1e-6 * body.spacing](const std::vector<Point<dim>> &corners) {
    for (int i = 0; i < dim; ++i)
      for (const auto &[at, sign] : {std::pair{low[i], '-'}, std::pair{high[i], '+'}})
        if (std::all_of(corners.begin(), corners.end(),
                        [&](const auto &p) { return std::abs(p[i] - at) < tolerance; }))
          return std::string{"xyz"[i], sign};
    return std::string("side");
  };
  return mesh;
}

Raw<2> section(const input::Body &body, const blocks::Kept &kept)
{
  const input::Shape &s = body.shape;
  const Raw<2> quadrant = has_bore(s) ? blocks::ring_quadrant(s.inner_radius, s.radius, body.spacing, far_of(body))
                                      : blocks::disc_quadrant(s.radius, body.spacing, far_of(body));
  return blocks::mirror_all(quadrant, kept, 1e-6 * body.spacing);
}

ShapeMesh<2> plane_section(const input::Body &body, const input::Scene &scene)
{
  ShapeMesh<2> mesh;
  mesh.raw = section(body, kept_parts(body, scene, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}));
  const Point<2> base(body.shape.base[0], body.shape.base[1]);
  for (auto &p : mesh.raw.vertices)
    p = Point<2>(p + base);
  mesh.face_name = round_names<2>(body, [base](const Point<2> &p) {
    return std::array<double, 2>{p.distance(base), 1e300};
  });
  return mesh;
}

/// Half section of a cylinder, disc or ring: x = r, y along the axis.
ShapeMesh<2> half_section(const input::Body &body, const input::Scene &scene)
{
  const input::Shape &s     = body.shape;
  const double        inner = has_bore(s) ? s.inner_radius : 0;
  if (std::abs(s.axis[0]) > 1e-9)
    throw InputError({"", 0, body.name}, "in axial symmetry the axis of a body is the axis of the scene");
  const double sign = s.axis[1] < 0 || s.axis[2] < 0 ? -1 : 1;
  double       base = s.base[1], cut = 0;
  if (symmetric(scene, 1) && sign * base < 0)
    cut = sign > 0 ? -base : 0;
  input::Body kept = body;
  kept.shape.length -= cut;
  base += sign * cut;
  const std::vector<double> radii = blocks::graded(s.radius - inner, body.spacing, far_of(body));
  const std::vector<double> z     = levels(kept);
  ShapeMesh<2>              mesh;
  const auto                nr = static_cast<unsigned int>(radii.size() - 1);
  const auto                nz = static_cast<unsigned int>(z.size() - 1);
  mesh.raw.add({nr, nz}, [&](const Point<2> &u) {
    const double r = inner + (s.radius - inner) * radii[static_cast<std::size_t>(std::lround(u[0] * nr))];
    const double h = z[static_cast<std::size_t>(std::lround(u[1] * nz))] / kept.shape.length;
    return Point<2>(r, h * column(kept.shape, r));
  });
  if (sign < 0) // a turn about the radius would leave r > 0: reflect, and restore the handedness
    mesh.raw = mesh.raw.mirrored(1);
  for (auto &p : mesh.raw.vertices)
    p[1] += base;
  const double bottom = s.base[1];
  mesh.face_name      = round_names<2>(body, [=](const Point<2> &p) {
    return std::array<double, 2>{p[0], sign * (p[1] - bottom)};
  });
  return mesh;
}

/// Half section of a ball or shell of revolution.
ShapeMesh<2> half_ball(const input::Body &body, const input::Scene &scene)
{
  blocks::Kept kept = kept_parts(body, scene, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  kept.negative[0]  = false;
  ShapeMesh<2> mesh;
  mesh.raw            = section(body, kept);
  const double centre = body.shape.base[1];
  for (auto &p : mesh.raw.vertices)
    p[1] += centre;
  mesh.face_name = round_names<2>(body, [centre](const Point<2> &p) {
    return std::array<double, 2>{std::hypot(p[0], p[1] - centre), 1e300};
  });
  return mesh;
}

/// Right-handed local frame with e[2] along the axis and the others along
/// coordinate axes where possible.
std::array<Vec3, 3> frame(const Vec3 &axis)
{
  const Vec3 e3 = axis.normalized();
  int        flat = 0; // coordinate most nearly normal to the axis
  for (int i = 1; i < 3; ++i)
    if (std::abs(e3[i]) < std::abs(e3[flat]))
      flat = i;
  Vec3 e1 = Vec3::Unit(flat);
  e1 -= e1.dot(e3) * e3;
  e1.normalize();
  return {e1, e3.cross(e1), e3};
}

ShapeMesh<3> solid(const input::Body &body, const input::Scene &scene)
{
  const input::Shape &s    = body.shape;
  const bool          ball = s.kind == ShapeKind::sphere || s.kind == ShapeKind::shell;
  std::array<Vec3, 3> e{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (!ball)
    e = frame(s.axis);
  const blocks::Kept kept = kept_parts(body, scene, e);
  ShapeMesh<3>       mesh;
  if (ball)
    mesh.raw = blocks::mirror_all(s.kind == ShapeKind::sphere
                                    ? blocks::ball_octant(s.radius, body.spacing)
                                    : blocks::shell_octant(s.inner_radius, s.radius, body.spacing),
                                  kept, 1e-6 * body.spacing);
  else
  {
    mesh.raw = blocks::extrude(section(body, kept), levels(body));
    for (auto &p : mesh.raw.vertices)
      p[2] *= column(s, std::hypot(p[0], p[1])) / s.length;
  }
  for (auto &p : mesh.raw.vertices)
  {
    Point<3> q;
    for (int i = 0; i < 3; ++i)
      q[i] = s.base[i] + e[0][i] * p[0] + e[1][i] * p[1] + e[2][i] * p[2];
    p = q;
  }
  mesh.face_name = round_names<3>(body, [s, e, ball](const Point<3> &p) {
    const Vec3   d = Vec3(p[0], p[1], p[2]) - s.base;
    const double z = d.dot(e[2]);
    return ball ? std::array<double, 2>{d.norm(), 1e300} : std::array<double, 2>{(d - z * e[2]).norm(), z};
  });
  return mesh;
}
} // namespace

double nose_height(const input::Shape &shape, double r)
{
  const double R = shape.radius, n = nose_length(shape), s = std::min(r / R, 1.);
  switch (shape.nose)
  {
    case input::Nose::blunt: return 0;
    case input::Nose::hemispherical: return n * std::sqrt(1 - s * s);
    case input::Nose::conical: return n * (1 - s);
    case input::Nose::ogive:
    { // tangent ogive: an arc of radius rho that meets the shank without a kink
      const double rho = (R * R + n * n) / (2 * R), d = s * R + rho - R;
      return std::sqrt(std::max(0., rho * rho - d * d));
    }
  }
  return 0;
}

template <>
ShapeMesh<1> mesh_shape<1>(const input::Body &body, const input::Scene &scene)
{
  if (body.shape.kind != ShapeKind::box)
    throw InputError({"", 0, body.name}, "in one dimension a body is a box");
  return box<1>(body, scene);
}

template <>
ShapeMesh<2> mesh_shape<2>(const input::Body &body, const input::Scene &scene)
{
  const bool axisymmetric = scene.dimension == input::Dimension::axisymmetric;
  switch (body.shape.kind)
  {
    case ShapeKind::box: return box<2>(body, scene);
    case ShapeKind::cylinder:
      if (!axisymmetric)
        throw InputError({"", 0, body.name}, "a cylinder has no plane strain section",
                         "disc or box in plane strain");
      return half_section(body, scene);
    case ShapeKind::disc:
    case ShapeKind::ring: return axisymmetric ? half_section(body, scene) : plane_section(body, scene);
    case ShapeKind::sphere:
    case ShapeKind::shell:
      if (!axisymmetric)
        throw InputError({"", 0, body.name}, "a sphere has no plane strain section",
                         "disc or ring in plane strain");
      return half_ball(body, scene);
    case ShapeKind::mesh: break;
  }
  throw InputError({"", 0, body.name}, "not a generated shape");
}

template <>
ShapeMesh<3> mesh_shape<3>(const input::Body &body, const input::Scene &scene)
{
  if (body.shape.kind == ShapeKind::box)
    return box<3>(body, scene);
  return solid(body, scene);
}
} // namespace ogive::fem
