// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/checks.h"
#include "core/input/shape_geometry.h"

#include <algorithm>
#include <cmath>

namespace ogive::input
{
namespace
{
std::string in_mm(double metres)
{
  return units::format_number(std::round(metres * 1e9) / 1e6) + " mm";
}

std::string in_mm(const Vec3 &x)
{
  return "(" + units::format_number(std::round(x.x() * 1e9) / 1e6) + ", " +
         units::format_number(std::round(x.y() * 1e9) / 1e6) + ", " +
         units::format_number(std::round(x.z() * 1e9) / 1e6) + ") mm";
}

/// One body seen with its place in the text.
struct Place
{
  const Body    &body;
  const Scene   &scene;
  const Listing &listing;

  [[noreturn]] void refuse(const std::string &entry, const std::string &wrong, const std::string &expected) const
  {
    throw InputError(listing.where("Bodies/" + body.name, entry), wrong, expected);
  }
};

bool has_axis(const Shape &s)
{
  return s.kind == ShapeKind::cylinder || s.kind == ShapeKind::disc || s.kind == ShapeKind::ring;
}

void check_kind(const Place &p)
{
  const Shape    &s = p.body.shape;
  const Dimension d = p.scene.dimension;
  if (d == Dimension::uniaxial && s.kind != ShapeKind::box)
    p.refuse("shape", "a uniaxial scene has no round or meshed bodies", "\"box\"");
  if (d == Dimension::plane_strain && s.kind == ShapeKind::cylinder)
    p.refuse("shape", "in plane strain a cylinder has no meaning", "\"box\", \"disc\", \"ring\" or \"mesh\"");
  if (d == Dimension::plane_strain && (s.kind == ShapeKind::sphere || s.kind == ShapeKind::shell))
    p.refuse("shape", "in plane strain a ball has no meaning", "\"disc\" or \"ring\", which are circles in the plane");
  if (s.kind == ShapeKind::mesh && p.body.method == Method::sph)
    p.refuse("method", "particles are not made from a mesh file", "\"fem\"");
  const std::string &element = p.body.element.empty() ? p.scene.fem.element : p.body.element;
  if (d == Dimension::axisymmetric && p.body.method != Method::sph && element == "spectral")
    p.refuse("element", "spectral elements have no rings: their nodes on the axis would have no mass",
             "\"one-point\", \"area-weighted\" or \"b-bar\"");
  if (element == "spectral" && p.body.method != Method::sph)
    for (const Interface &i : p.scene.interfaces)
      if (i.mesh == p.body.name || i.slave == p.body.name || i.master == p.body.name)
        p.refuse("element", "the interface \"" + i.name + "\" ties the body, and ties know no spectral shape functions",
                 "\"one-point\" or \"b-bar\", or no such interface");
  if (d != Dimension::uniaxial && (element == "b-bar" || element == "full"))
    for (const Interface &i : p.scene.interfaces)
      if (i.mesh == p.body.name && i.method == "pair-flux")
        p.refuse("element", "the seam \"" + i.name + "\" feeds on noise next to elements that it cannot damp",
                 "\"one-point\", or method = tied in Interfaces/" + i.name);
  if (element == "spectral" && p.body.method != Method::sph && p.body.coarsen > 0)
    p.refuse("coarsen", "spectral elements have no hanging nodes", "another element, or a mesh without coarsening");
  if (d != Dimension::axisymmetric && p.body.method != Method::sph && element == "area-weighted")
    p.refuse("element", "only rings are weighed over their section", "\"one-point\" or \"b-bar\"");
  if (element == "area-weighted" && p.body.method != Method::sph && p.scene.fem.mass_scaling_step > 0)
    p.refuse("element", "area-weighted elements take no added mass", "\"one-point\" or \"b-bar\", or no mass scaling");
  if (element == "area-weighted" && p.body.method != Method::sph && p.scene.fem.step_bound == "power-iteration")
    p.refuse("element", "power iteration needs a symmetric stiffness, which area-weighted elements lack",
             "\"one-point\" or \"b-bar\", or FEM/step bound = element");
}

/// Checks that dimensions of a shape are such that it has a volume.
void check_volume(const Place &p)
{
  const Shape &s = p.body.shape;
  if (s.kind == ShapeKind::box)
    for (int i = 0; i < space_dimension(p.scene.dimension); ++i)
      if (!(s.lower[i] < s.upper[i]))
        p.refuse("upper", "the body is empty: along " + std::string(1, "xyz"[i]) + " it ends at " + in_mm(s.upper[i]) +
                            " and begins at " + in_mm(s.lower[i]),
                 "more than \"lower\"");
  if ((s.kind == ShapeKind::ring || s.kind == ShapeKind::shell) && s.inner_radius >= s.radius)
    p.refuse("inner radius", "the body is empty: its inner radius is not below its outer one",
             "less than " + in_mm(s.radius));
  if (s.kind == ShapeKind::cylinder && s.nose == Nose::ogive && s.nose_length < s.radius)
    p.refuse("nose length", "an ogive that leaves the shank smoothly is at least as long as its radius",
             "at least " + in_mm(s.radius));
}

struct Extent
{
  std::string entry;
  double      length;
};

std::vector<Extent> extents(const Shape &s, Dimension d)
{
  // an axisymmetric body is meshed from the axis outwards
  const double across = d == Dimension::axisymmetric ? s.radius : 2 * s.radius;
  std::vector<Extent> e;
  switch (s.kind)
  {
    case ShapeKind::box:
      for (int i = 0; i < space_dimension(d); ++i)
        e.push_back({"upper", s.upper[i] - s.lower[i]});
      break;
    case ShapeKind::cylinder:
      e = {{"radius", across}, {"length", s.length}};
      break;
    case ShapeKind::disc:
      e = {{"radius", across}, {"thickness", s.length}};
      break;
    case ShapeKind::ring:
      e = {{"inner radius", s.radius - s.inner_radius}, {"thickness", s.length}};
      break;
    case ShapeKind::sphere:
      e = {{"radius", across}};
      break;
    case ShapeKind::shell:
      e = {{"inner radius", s.radius - s.inner_radius}};
      break;
    case ShapeKind::mesh:
      break;
  }
  if (d == Dimension::plane_strain && has_axis(s))
    e.pop_back();
  return e;
}

void check_spacing(const Place &p)
{
  for (const Extent &e : extents(p.body.shape, p.scene.dimension))
    if (e.length < p.body.spacing * (1 - 1e-9))
      p.refuse("spacing", "the body is smaller than its spacing: \"" + e.entry + "\" leaves " + in_mm(e.length),
               "at most " + in_mm(e.length));
  constexpr double most  = 1e9;
  double           count = 1;
  if (p.body.shape.kind != ShapeKind::mesh)
  {
    const BoundingBox box = bounding_box(p.body.shape, p.scene.dimension);
    for (int i = 0; i < space_dimension(p.scene.dimension); ++i)
      count *= (box.upper[i] - box.lower[i]) / p.body.spacing;
  }
  if (!(count <= most))
    p.refuse("spacing", "a body of this size would have about " + units::format_number(std::round(count)) + " points",
             "a spacing that leaves fewer than " + units::format_number(most));
  if (p.body.spacing_far > 0 && p.body.spacing_far < p.body.spacing)
    p.refuse("spacing far", "the mesh would grow finer away from the impact", "0 or at least \"spacing\"");
}

void check_coarsening(const Place &p)
{
  const Body &b = p.body;
  if (b.coarsen != std::round(b.coarsen))
    p.refuse("coarsen", "an edge doubles a whole number of times, not " + units::format_number(b.coarsen),
             "0, 1, 2 ... 6");
  if (b.coarsen == 0)
    return;
  if (b.shape.kind == ShapeKind::mesh || b.shape.nose != Nose::blunt)
    p.refuse("coarsen", b.shape.kind == ShapeKind::mesh ? "a mesh file has the elements that it has" :
                                                          "a body with a nose cannot be coarsened",
             "a box, a round body without a nose, or 0");
  if (!(b.coarsen_distance > 0))
    p.refuse("coarsen distance", "a coarsened body needs a distance at which the edge doubles", "a length > 0");
  if (b.spacing_far > 0)
    p.refuse("spacing far", "the body is coarsened by hanging nodes already", "one of the two gradings");
  if (p.scene.dimension == Dimension::axisymmetric && b.coarsen_from.x() != 0)
    p.refuse("coarsen from", "the impact is off the axis of symmetry", "x = 0");
  const double coarsest = b.spacing * std::exp2(b.coarsen);
  for (const Extent &e : extents(b.shape, p.scene.dimension))
    if (e.length < coarsest * (1 - 1e-9))
      p.refuse("coarsen", "the body is smaller than its coarsest element, " + in_mm(coarsest) + ": \"" + e.entry +
                            "\" leaves " + in_mm(e.length),
               "fewer doublings, or a smaller spacing");
}

void check_axis(const Place &p)
{
  if (p.scene.dimension != Dimension::axisymmetric)
    return;
  const Shape &s = p.body.shape;
  if (s.kind == ShapeKind::box && s.lower.x() < 0)
    p.refuse("lower", "the body reaches beyond the axis: x is the radius", "x >= 0");
  if (s.kind == ShapeKind::box || s.kind == ShapeKind::mesh)
    return;
  if (s.base.x() != 0)
    p.refuse("base", "the body is off the axis of symmetry", "x = 0");
  if (has_axis(s) && std::abs(s.axis.x()) > 1e-12)
    p.refuse("axis", "the axis of the body is not that of the scene", "\"0, 1\" or \"0, -1\"");
}

void check_planes(const Place &p)
{
  for (const SymmetryPlane &plane : p.scene.symmetry)
  {
    const std::string axis(1, "xyz"[plane.axis]);
    if (plane.axis >= space_dimension(p.scene.dimension) ||
        (p.scene.dimension == Dimension::axisymmetric && plane.axis == 0))
      throw InputError(p.listing.where("", "symmetry planes"),
                       "there is no plane \"" + axis + "\" in a scene of dimension " + describe(p.scene.dimension),
                       p.scene.dimension == Dimension::axisymmetric ? "\"y\"; the axis needs none" :
                                                                      "one of its coordinates");
    if (p.body.shape.kind == ShapeKind::mesh)
      continue;
    const BoundingBox box = bounding_box(p.body.shape, p.scene.dimension);
    if (box.upper[plane.axis] <= 0)
      p.refuse("shape",
               "the body lies wholly on the side of the symmetry plane \"" + axis + "\" that is cut away: its greatest " +
                 axis + " is " + in_mm(box.upper[plane.axis]),
               axis + " > 0");
  }
}

void check_walls(const Place &p)
{
  if (p.body.shape.kind == ShapeKind::mesh)
    return;
  for (const RigidWall &w : p.scene.walls)
  {
    const double least = -support(p.body.shape, p.scene.dimension, -w.normal) - w.point.dot(w.normal);
    const double size  = least + support(p.body.shape, p.scene.dimension, w.normal) + w.point.dot(w.normal);
    if (least < -1e-6 * std::abs(size))
      p.refuse("shape", "the body reaches " + in_mm(-least) + " behind the wall \"" + w.name + "\"",
               "a body on the side that the wall's normal points to");
  }
}

/// Particles and elements that share a layer of the material.
bool blended(const Scene &s, const std::string &a, const std::string &b)
{
  return std::any_of(s.interfaces.begin(), s.interfaces.end(), [&](const Interface &i) {
    return i.method == "blended" && ((i.particles == a && i.mesh == b) || (i.particles == b && i.mesh == a));
  });
}

void check_overlaps(const Scene &s, const Listing &listing)
{
  for (std::size_t b = 1; b < s.bodies.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
    {
      const Shape &first = s.bodies[a].shape, &second = s.bodies[b].shape;
      Vec3         point;
      if (blended(s, s.bodies[a].name, s.bodies[b].name))
        continue;
      if (first.kind == ShapeKind::mesh || second.kind == ShapeKind::mesh || !find_overlap(first, second, s, point))
        continue;
      const std::string section = "Bodies/" + s.bodies[b].name;
      throw InputError(listing.where(section, second.kind == ShapeKind::box ? "lower" : "base"),
                       "the body overlaps \"" + s.bodies[a].name + "\", for one at " + in_mm(point),
                       "bodies that are apart or touch");
    }
}
} // namespace

void check_geometry(const Scene &s, const Listing &listing)
{
  for (const Body &b : s.bodies)
  {
    const Place place{b, s, listing};
    check_kind(place);
    check_volume(place);
    check_axis(place);
    check_spacing(place);
    check_coarsening(place);
    check_planes(place);
    check_walls(place);
  }
  check_overlaps(s, listing);
}
} // namespace ogive::input
