// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/checks.h"
#include "core/input/shape_geometry.h"

#include <algorithm>
#include <cmath>

namespace ogive::input
{
namespace
{
bool is_loaded(const Scene &s, const Body &b)
{
  return std::any_of(s.boundaries.begin(), s.boundaries.end(), [&](const Boundary &c) {
    if (c.body != b.name || c.history.always_zero())
      return false;
    switch (c.kind)
    {
      case BoundaryKind::fixed:
      case BoundaryKind::absorbing: return false;
      case BoundaryKind::velocity: return !c.velocity.isZero(0);
      case BoundaryKind::displacement: return !c.displacement.isZero(0);
      case BoundaryKind::pressure: return c.pressure != 0;
      case BoundaryKind::body_force: return !c.acceleration.isZero(0);
    }
    return false;
  });
}

/// Motion that is more than a translation cannot be judged by bounding boxes.
bool moves_otherwise(const Scene &s, const Body &b)
{
  return !b.spin.isZero(0) || !b.velocity_field.empty() || b.has_initial_state() || is_loaded(s, b) ||
         b.shape.kind == ShapeKind::mesh;
}

void check_planes(const Scene &s, const Body &b, const Listing &listing)
{
  const std::string section = "Bodies/" + b.name;
  if (s.dimension == Dimension::axisymmetric && b.velocity.x() != 0)
    throw InputError(listing.where(section, "velocity"), "x is the radius: a body cannot fly along it",
                     "0 along x; \"velocity field\" lets a body swell or shrink");
  const bool spin_possible = s.dimension == Dimension::three_d || s.dimension == Dimension::plane_strain;
  if (!b.spin.isZero(0) && !spin_possible)
    throw InputError(listing.where(section, "spin"), "a scene of dimension " + describe(s.dimension) +
                       " has no motion out of its space",
                     "no spin");
  if (b.shape.kind == ShapeKind::mesh)
    return;
  const BoundingBox box = bounding_box(b.shape, s.dimension);
  for (const SymmetryPlane &p : s.symmetry)
  {
    // only bodies that the plane cuts are held by it
    if (box.lower[p.axis] >= -1e-9 * (box.upper[p.axis] - box.lower[p.axis]))
      continue;
    const std::string axis(1, "xyz"[p.axis]);
    if (b.velocity[p.axis] != 0)
      throw InputError(listing.where(section, "velocity"),
                       "the symmetry plane \"" + axis + "\" cuts the body, which cannot move across it",
                       "0 along " + axis);
    for (int i = 0; i < 3; ++i)
      if (i != p.axis && b.spin[i] != 0)
        throw InputError(listing.where(section, "spin"),
                         "the symmetry plane \"" + axis + "\" cuts the body, which cannot turn out of it",
                         "no spin, or one about " + axis);
  }
}

bool anything_moves(const Scene &s)
{
  return std::any_of(s.bodies.begin(), s.bodies.end(),
                     [&](const Body &b) {
                       return !b.velocity.isZero(0) || !b.spin.isZero(0) || !b.velocity_field.empty() ||
                              b.has_initial_state() || is_loaded(s, b);
                     }) ||
         std::any_of(s.walls.begin(), s.walls.end(), [](const RigidWall &w) { return !w.velocity.isZero(0); });
}

/// Whether one bounding box, moving with a constant velocity relative to the
/// other, comes within `reach` of it before the end.
bool boxes_meet(const BoundingBox &a, const BoundingBox &b, const Vec3 &velocity, double reach, double end, int dim)
{
  double from = 0, to = end;
  for (int i = 0; i < dim; ++i)
  {
    const double gap_low  = b.lower[i] - a.upper[i] - reach; // a below b
    const double gap_high = b.upper[i] - a.lower[i] + reach; // until a is above b
    if (velocity[i] == 0)
    {
      if (gap_low > 0 || gap_high < 0)
        return false;
      continue;
    }
    const double t0 = gap_low / velocity[i], t1 = gap_high / velocity[i];
    from            = std::max(from, std::min(t0, t1));
    to              = std::min(to, std::max(t0, t1));
  }
  return from <= to;
}

/// Separating boxes touch at time 0 only; that is no approach.
bool approaches(const Scene &s, const Body &a, const Body &b)
{
  if (moves_otherwise(s, b))
    return true;
  const Vec3 relative = a.velocity - b.velocity;
  if (relative.isZero(0))
    return false;
  const BoundingBox p = bounding_box(a.shape, s.dimension), q = bounding_box(b.shape, s.dimension);
  const double      reach = .5 * (a.spacing + b.spacing);
  const int         dim   = space_dimension(s.dimension);
  for (int i = 0; i < dim; ++i)
  {
    // apart or touching along this axis, and drawing apart
    const bool above = p.lower[i] >= q.upper[i] - 1e-6 * (q.upper[i] - q.lower[i]);
    const bool below = p.upper[i] <= q.lower[i] + 1e-6 * (q.upper[i] - q.lower[i]);
    if ((above && relative[i] > 0) || (below && relative[i] < 0))
      return false;
  }
  return boxes_meet(p, q, relative, reach, s.end_time, dim);
}

bool approaches(const Scene &s, const Body &a, const RigidWall &w)
{
  const double gap   = -support(a.shape, s.dimension, -w.normal) - w.point.dot(w.normal);
  const double speed = (w.velocity - a.velocity).dot(w.normal);
  return speed > 0 && gap <= speed * s.end_time + .5 * a.spacing;
}

bool approaches(const Scene &s, const Body &a, const SymmetryPlane &p)
{
  const double gap = bounding_box(a.shape, s.dimension).lower[p.axis];
  return gap >= 0 && a.velocity[p.axis] < 0 && gap <= -a.velocity[p.axis] * s.end_time;
}

const Body &body_named(const Scene &s, const std::string &name)
{
  return *std::find_if(s.bodies.begin(), s.bodies.end(), [&](const Body &b) { return b.name == name; });
}

/// A translating body that may touch something must come to do so. Bodies tied
/// together strike as one.
void check_aim(const Scene &s, const Body &b, const Listing &listing)
{
  std::vector<const Body *> group{&b};
  for (const Interface &i : s.interfaces)
    for (const auto &[one, other] : {std::pair{&i.particles, &i.mesh}, std::pair{&i.slave, &i.master}})
      if (i.body.empty() && (*one == b.name || *other == b.name))
        group.push_back(&body_named(s, *one == b.name ? *other : *one));

  bool        has_target = !s.walls.empty(), hits = false;
  std::string targets;
  for (const Body *member : group)
  {
    for (const Contact &c : s.contacts)
      if (c.first == member->name || c.second == member->name)
      {
        const Body &other = body_named(s, c.first == member->name ? c.second : c.first);
        has_target        = true;
        targets += (targets.empty() ? "\"" : ", \"") + other.name + "\"";
        hits = hits || moves_otherwise(s, *member) || approaches(s, *member, other);
      }
    for (const RigidWall &w : s.walls)
    {
      targets += (targets.empty() ? "\"" : ", \"") + w.name + "\"";
      hits = hits || moves_otherwise(s, *member) || approaches(s, *member, w);
    }
    for (const SymmetryPlane &p : s.symmetry)
      hits = hits || approaches(s, *member, p);
  }
  if (has_target && !hits)
    throw InputError(listing.where("Bodies/" + b.name, "velocity"),
                     "the body never hits what it may touch (" + targets + ") before the end time",
                     "a velocity towards it, or a later end time");
}
} // namespace

void check_motion(const Scene &s, const Listing &listing)
{
  for (const Body &b : s.bodies)
    check_planes(s, b, listing);
  if (!anything_moves(s))
    throw InputError(listing.where("Bodies/" + s.bodies.front().name, "velocity"),
                     "nothing moves: no body has a velocity, no wall, and no boundary acts",
                     "a velocity, spin, velocity field, moving wall, boundary, or pressure");
  for (const Body &b : s.bodies)
    if (!b.velocity.isZero(0) && !moves_otherwise(s, b))
      check_aim(s, b, listing);
}
} // namespace ogive::input
