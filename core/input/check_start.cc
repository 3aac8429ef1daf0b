// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/checks.h"
#include "core/input/shape_geometry.h"
#include "core/input/wave_field.h"

#include <cmath>
#include <utility>

namespace ogive::input
{
namespace
{
/// Points of the box's section by the plane x_axis = 0, 5 an edge.
std::vector<Vec3> section(const BoundingBox &box, int axis, int dim)
{
  constexpr int     n = 5;
  std::vector<Vec3> points;
  for (int k = 0; k < n * n; ++k)
  {
    const double share[2] = {(k % n + .5) / n, (k / n + .5) / n};
    Vec3         x        = Vec3::Zero();
    for (int a = 0, c = 0; a < dim; ++a)
      if (a != axis)
        x[a] = box.lower[a] + share[c++] * (box.upper[a] - box.lower[a]);
    points.push_back(x);
  }
  return points;
}

void check_field(const Scene &s, const Body &b, const Listing &listing)
{
  const std::string path   = "Bodies/" + b.name;
  const auto        refuse = [&](const char *entry, const std::string &wrong, const std::string &expected)
  { throw InputError(listing.where(path, entry), wrong, expected); };
  const std::string &name = b.velocity_field;
  if (name.starts_with("radial-inverse") && (b.shape.kind == ShapeKind::box || b.shape.kind == ShapeKind::mesh))
    refuse("velocity field", "the field \"" + name + "\" flows about the middle of a round body",
           "a round shape, such as \"ring\" or \"shell\"");
  if (name == "twist" && s.dimension != Dimension::three_d)
    refuse("velocity field", "nothing twists in a scene of dimension " + describe(s.dimension), "dimension 3d");
  if ((name == "bend" || name == "bending-mode") && s.dimension == Dimension::axisymmetric)
    refuse("velocity field", "x is the radius: the field \"" + name + "\" has no meaning there",
           "dimension plane-strain or 3d");
  const WaveField *field = find_wave_field(name);
  if (!field)
    return;
  const bool box = b.shape.kind == ShapeKind::box;
  if (b.velocity_field == "converging" ? b.shape.kind == ShapeKind::mesh : !box)
    refuse("velocity field", "the field \"" + b.velocity_field + "\" has no meaning for this shape",
           b.velocity_field == "converging" ? "a named shape" : "shape \"box\"");
  if (s.dimension == Dimension::axisymmetric)
    refuse("velocity field", "x is the radius: the field \"" + b.velocity_field + "\" has no meaning there",
           "dimension uniaxial, plane-strain or 3d");
  if ((b.velocity_field == "shear" || b.velocity_field == "draw") && s.dimension == Dimension::uniaxial)
    refuse("velocity field",
           b.velocity_field == "shear" ? "there is no shear in a uniaxial scene" :
                                         "a uniaxial scene has no sides to draw in",
           "dimension plane-strain or 3d");
  if (b.velocity_field == "standing-wave" && b.half_waves != std::round(b.half_waves))
    refuse("half waves",
           "a bar with free ends has no mode of " + units::format_number(b.half_waves) + " half waves",
           "a whole number, such as 1");
  for (const SymmetryPlane &p : s.symmetry)
  {
    const BoundingBox extent = bounding_box(b.shape, s.dimension);
    if (extent.lower[p.axis] > 0)
      continue;
    for (const Vec3 &x : section(extent, p.axis, space_dimension(s.dimension)))
      if (b.velocity_field == "saw-tooth" || std::abs(field->shape(b, x)[p.axis]) > 1e-9)
        refuse("velocity field",
               "the field \"" + b.velocity_field + "\" is not its own mirror image at the symmetry plane \"" +
                   std::string(1, "xyz"[p.axis]) + "\"",
               "no such plane, or a body whose middle lies on it");
  }
}

void check_state(const Scene &s, const Body &b, const Listing &listing)
{
  if (!b.has_initial_state())
    return;
  const std::string path  = "Bodies/" + b.name;
  const char *entry = b.has_start_density() ? "start density" : b.pressure > 0 ? "pressure" : "step plane";
  if (b.method != Method::sph)
    throw InputError(listing.where(path, entry), "a state at the start is for particles only", "method sph");
  if (!b.has_step())
    return;
  const BoundingBox box = bounding_box(b.shape, s.dimension);
  if (!(b.step_plane > box.lower[0] && b.step_plane < box.upper[0]))
    throw InputError(listing.where(path, "step plane"),
                     "the plane x = " + units::format_number(b.step_plane) + " m does not cut the body",
                     "more than " + units::format_number(box.lower[0]) + " m and less than " +
                         units::format_number(box.upper[0]) + " m");
}
/// What may die must be able to, and nothing else may hold on to it.
void check_erosion(const Scene &s, const Body &b, const Listing &listing)
{
  if (!b.erosion.on)
    return;
  const auto refuse = [&](const std::string &wrong, const std::string &expected)
  { throw InputError(listing.where("Bodies/" + b.name, "erosion"), wrong, expected); };
  for (const materials::Parameters &m : s.materials)
    if (m.name == b.material && m.damage.law == "none" && b.erosion.strain == 0 && b.erosion.step == 0)
      refuse("the material \"" + b.material + "\" never fails", "a material with damage, or an erosion strain or step");
  const std::string &element = b.element.empty() ? s.fem.element : b.element;
  if (element != "one-point" && s.dimension != Dimension::uniaxial)
    refuse("only one-point elements die, and those of the body are \"" + element + "\"", "element = one-point");
  if (s.fem.correction != "none")
    refuse("the correction of the elements' viscosity does not let go of dead elements", "FEM/correction = none");
  if (b.coarsen > 0)
    refuse("elements around hanging nodes do not die", "erosion none, or a mesh without coarsening");
  for (const Interface &i : s.interfaces)
    if (i.slave == b.name || i.master == b.name)
      refuse("the interface \"" + i.name + "\" ties the body to another, whose nodes do not let go of dead elements",
             "erosion none, or no such interface");
    else if (i.mesh == b.name)
      refuse("the interface \"" + i.name + "\" ties particles to the body, and they do not let go of dead elements",
             "erosion none, or no such interface");
  for (const Boundary &boundary : s.boundaries)
    if (boundary.body == b.name &&
        (boundary.kind == BoundaryKind::pressure || boundary.kind == BoundaryKind::absorbing))
      refuse("the boundary \"" + boundary.name + "\" does not let go of the faces of dead elements",
             "erosion none, or no pressure and no dashpots on the body");
}

/// What turns into particles must be able to.
void check_conversion(const Scene &s, const Body &b, const Listing &listing)
{
  if (b.method != Method::automatic)
    return;
  const auto refuse = [&](const char *entry, const std::string &wrong, const std::string &expected)
  { throw InputError(listing.where("Bodies/" + b.name, entry), wrong, expected); };
  const std::string &element = b.element.empty() ? s.fem.element : b.element;
  if (element != "one-point" && s.dimension != Dimension::uniaxial)
    refuse("element", "only one-point elements turn into particles, and those of the body are \"" + element + "\"",
           "element = one-point");
  if (b.coarsen > 0)
    refuse("coarsen", "elements around hanging nodes do not turn into particles",
           "method fem, or a mesh without coarsening (spacing far grades a disc without hanging nodes)");
  if (s.fem.correction != "none")
    refuse("method", "the correction of the elements' viscosity does not let go of elements",
           "method fem, or FEM/correction = none");
  if (s.fem.mass_scaling_step > 0)
    refuse("method", "mass that was added for the sake of the step cannot go over to particles",
           "method fem, or no FEM/mass scaling step");
  if (s.sph.configuration == "reference")
    refuse("method", "particles that come in later have no place in a reference configuration",
           "SPH/configuration = current");
  for (const auto &[entry, value] : {std::pair{"particles per edge", b.conversion.per_edge},
                                     std::pair{"conversion layers", b.conversion.layers}})
    if (value != std::floor(value))
      refuse(entry, units::format_number(value) + " is not a whole number", "a whole number, such as 2");
  for (const Interface &i : s.interfaces)
    if (i.slave == b.name || i.master == b.name || i.mesh == b.name || i.particles == b.name)
      refuse("method", "the interface \"" + i.name + "\" joins the body to another, and does not let go of elements",
             "method fem or sph, or no such interface");
  for (const Boundary &boundary : s.boundaries)
    if (boundary.body == b.name && boundary.kind == BoundaryKind::body_force)
      refuse("method", "the body force \"" + boundary.name + "\" knows no particles", "method fem, or no body force");
  for (const Body &other : s.bodies)
    if (other.name == b.name + "-particles")
      throw InputError(listing.where("Bodies/" + other.name, "method"),
                       "results call the particles of \"" + b.name + "\" by this name", "another name");
}
} // namespace

void check_start(const Scene &s, const Listing &listing)
{
  for (const Body &b : s.bodies)
  {
    check_field(s, b, listing);
    check_state(s, b, listing);
    check_erosion(s, b, listing);
    check_conversion(s, b, listing);
  }
}
} // namespace ogive::input
