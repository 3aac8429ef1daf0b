// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/scene_fields.h"

namespace ogive::input
{
namespace
{
/// Shapes of the subsection to which an entry applies in this dimension.
Use with(std::vector<std::string> shapes)
{
  return {"shape", std::move(shapes)};
}

void round_fields(Fields &f, Shape &s, Dimension dimension)
{
  const bool flat = dimension == Dimension::plane_strain;
  // in plane strain discs and rings are circles in the plane: no axis, no thickness
  const std::vector<std::string> along =
    flat ? std::vector<std::string>{"cylinder"} : std::vector<std::string>{"cylinder", "disc", "ring"};
  const std::vector<std::string> plates =
    flat ? std::vector<std::string>{"none"} : std::vector<std::string>{"disc", "ring"};

  f.vector({"base", "centre of the face that the axis leaves from; centre of a sphere, shell or plane circle",
            Need::mandatory, with({"cylinder", "disc", "ring", "sphere", "shell"})},
           s.base, units::length);
  f.direction({"axis", "direction of the axis; a nose points along it", Need::optional, with(along)}, s.axis);
  f.quantity({"inner radius", "inner radius", Need::mandatory, with({"ring", "shell"})}, s.inner_radius, units::length,
             bounds::positive);
  f.quantity({"radius", "outer radius", Need::mandatory, with({"cylinder", "disc", "ring", "sphere", "shell"})},
             s.radius, units::length, bounds::positive);
  f.quantity({"length", "length along the axis, without the nose", Need::mandatory, with({"cylinder"})}, s.length,
             units::length, bounds::positive);
  f.quantity({"thickness", "extent along the axis", Need::mandatory, with(plates)}, s.length, units::length,
             bounds::positive);
  f.choice({"nose", "form of the front", Need::optional, with({"cylinder"})}, s.nose,
           {{"blunt", Nose::blunt},
            {"hemispherical", Nose::hemispherical},
            {"conical", Nose::conical},
            {"ogive", Nose::ogive}});
  f.quantity({"nose length", "length of the nose", Need::mandatory, {"nose", {"conical", "ogive"}}}, s.nose_length,
             units::length, bounds::positive);
}

void shape_fields(Fields &f, Shape &s, Dimension dimension)
{
  f.choice({"shape", "what the body looks like", Need::mandatory}, s.kind,
           {{"box", ShapeKind::box},
            {"cylinder", ShapeKind::cylinder},
            {"disc", ShapeKind::disc},
            {"ring", ShapeKind::ring},
            {"sphere", ShapeKind::sphere},
            {"shell", ShapeKind::shell},
            {"mesh", ShapeKind::mesh}});
  f.vector({"lower", "corner with the least coordinates", Need::mandatory, with({"box"})}, s.lower, units::length);
  f.vector({"upper", "corner with the greatest coordinates", Need::mandatory, with({"box"})}, s.upper, units::length);
  round_fields(f, s, dimension);
  f.text({"mesh file", "mesh of quadrilaterals or hexahedra, seen from the scene file", Need::mandatory, with({"mesh"})},
         s.mesh_file, "a file name");
  f.text({"mesh part", "group of the mesh file's cells that the body is made of, by name; by default all its cells",
          Need::optional, with({"mesh"})},
         s.mesh_part, "the name of a group");
  f.quantity({"mesh unit", "length of one unit of the mesh file", Need::optional, with({"mesh"})}, s.mesh_unit,
             units::length, bounds::positive);
}

void erosion_fields(Fields &f, Erosion &e)
{
  std::string when = e.on ? "failure" : "none";
  f.choice({"erosion", "elements that die: with \"failure\" those whose damage has reached 1", Need::optional,
            {"method", {"fem"}}},
           when, {"none", "failure"});
  e.on = when == "failure";
  f.number({"erosion strain", "plastic strain at which an element dies as well; 0: not by it", Need::optional,
            {"erosion", {"failure"}}},
           e.strain, bounds::not_negative);
  f.quantity({"erosion step", "bound of the step below which an element dies as well; 0: not by it", Need::optional,
              {"erosion", {"failure"}}},
             e.step, units::time, bounds::not_negative);
}

void conversion_fields(Fields &f, Conversion &c)
{
  const Use automatic{"method", {"auto"}};
  f.number({"particles per edge", "particles along an edge of an element that converts", Need::optional, automatic},
           c.per_edge, Bound{1, 3});
  f.number({"conversion strain", "plastic strain at which an element turns into particles; 0: not by it",
            Need::optional, automatic},
           c.strain, bounds::not_negative);
  f.number({"conversion damage", "damage at which it does; 0: not by it", Need::optional, automatic}, c.damage,
           Bound{0, 1});
  f.number({"conversion volume", "natural logarithm of the change of volume, either way, at which it does; 0: not by it",
            Need::optional, automatic},
           c.volume, bounds::not_negative);
  f.quantity({"conversion step", "bound of the step below which it does; 0: not by it", Need::optional, automatic},
             c.step, units::time, bounds::not_negative);
  f.number({"conversion layers", "elements around one that must convert which go with it", Need::optional, automatic},
           c.layers, Bound{0, 10});
  f.quantity({"zone radius", "elements whose centre lies within it of the zone centre are particles from the start",
              Need::optional, automatic},
             c.zone_radius, units::length, bounds::not_negative);
  const Use zone{"zone radius", {}};
  f.vector({"zone centre", "the point that the zone radius is measured from", Need::optional, zone}, c.zone_centre,
           units::length);
  f.vector({"zone along", "the radius is measured from the line through the zone centre in this direction; zero: from "
                          "the point itself",
            Need::optional, zone},
           c.zone_along, units::none);
}

void state_fields(Fields &f, Body &b)
{
  f.quantity({"start density", "density at the start, by default the material's: less is a body stretched alike along "
                               "all axes, in tension; particles only"},
             b.start_density, units::density, bounds::positive);
  f.quantity({"pressure", "pressure at the start, made by heat: an ideal gas has none without it; particles only"},
             b.pressure, units::pressure, bounds::not_negative);
  f.quantity({"step plane", "x past which the body starts with another density and pressure; particles only"},
             b.step_plane, units::length);
  f.quantity({"density beyond", "density at the start past the step plane", Need::mandatory, {"step plane", {}}},
             b.density_beyond, units::density, bounds::positive);
  f.quantity({"pressure beyond", "pressure at the start past the step plane", Need::mandatory, {"step plane", {}}},
             b.pressure_beyond, units::pressure, bounds::positive);
}
} // namespace

void body_fields(Fields &f, Body &b, Dimension dimension)
{
  shape_fields(f, b.shape, dimension);
  f.text({"material", "name of a material, from the library or from \"materials\"; \"from mesh\": the one called as "
                      "the mesh part", Need::mandatory}, b.material,
         "the name of a material");
  f.choice({"method", "how the body is computed: elements, particles, or elements that turn into particles", Need::mandatory}, b.method,
           {{"fem", Method::fem}, {"sph", Method::sph}, {"auto", Method::automatic}});
  f.quantity({"spacing", "distance of particles, or element edge", Need::mandatory}, b.spacing, units::length,
             bounds::positive);
  f.quantity({"spacing far", "element edge at the outer radius of a disc or ring, or at the far end; 0: as spacing",
              Need::optional,
              {"method", {"fem", "auto"}}},
             b.spacing_far, units::length, bounds::not_negative);
  std::string element = b.element.empty() ? "default" : b.element;
  f.choice({"element", "formulation of its elements; default: that of the section FEM", Need::optional,
            {"method", {"fem", "auto"}}},
           element, {"default", "one-point", "b-bar", "full", "area-weighted", "spectral"});
  b.element = element == "default" ? "" : element;
  f.number({"coarsen", "how often the element edge of a generated mesh doubles with distance, by hanging nodes",
            Need::optional,
            {"method", {"fem", "auto"}}},
           b.coarsen, Bound{0, 6});
  const Use coarsened{"coarsen", {}};
  f.quantity({"coarsen distance", "the edge doubles where the distance reaches this, and at each multiple of it",
              Need::optional, coarsened},
             b.coarsen_distance, units::length, bounds::not_negative);
  f.vector({"coarsen from", "the point that distance is measured from, that of impact", Need::optional, coarsened},
           b.coarsen_from, units::length);
  f.vector({"coarsen along", "distance is measured from the line through the point in this direction; zero: from the "
                             "point itself",
            Need::optional, coarsened},
           b.coarsen_along, units::none);
  f.number({"jitter", "particles stand off their lattice by up to this share of the spacing along each axis, the same "
                      "ones in every run",
            Need::optional,
            {"method", {"sph"}}},
           b.jitter, Bound{0, .4});
  erosion_fields(f, b.erosion);
  conversion_fields(f, b.conversion);
  f.vector({"velocity", "initial velocity"}, b.velocity, units::velocity);
  if (dimension == Dimension::plane_strain)
    f.quantity({"spin", "initial spin about the centre of mass, about z"}, b.spin.z(), units::rate);
  else
    f.vector({"spin", "initial spin about the centre of mass; in plane strain one number, about z"}, b.spin,
             units::rate);

  std::string field = b.velocity_field.empty() ? "none" : b.velocity_field;
  f.choice({"velocity field", "initial velocity beyond translation and spin"}, field,
           {"none", "radial-inverse", "radial-inverse-square", "twist", "bend", "bending-mode", "closing",
            "converging", "standing-wave", "shear", "saw-tooth", "stretch", "draw"});
  b.velocity_field = field == "none" ? "" : field;
  f.quantity({"field speed",
              "speed of the velocity field",
              Need::mandatory,
              {"velocity field",
               {"radial-inverse", "radial-inverse-square", "twist", "bend", "bending-mode", "closing", "converging",
                "standing-wave", "shear", "saw-tooth", "stretch", "draw"}}},
             b.velocity_field_speed, units::velocity);
  f.number({"half waves", "half wavelengths of the standing wave along x, a whole number", Need::optional,
            {"velocity field", {"standing-wave"}}},
           b.half_waves, bounds::positive);
  state_fields(f, b);
}
} // namespace ogive::input
