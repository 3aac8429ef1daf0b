// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/scene_fields.h"

#include <algorithm>

namespace ogive::input
{
void wall_fields(Fields &f, RigidWall &w)
{
  f.vector({"point", "any point of the wall", Need::mandatory}, w.point, units::length);
  f.direction({"normal", "normal of the wall, towards the material", Need::mandatory}, w.normal);
  f.vector({"velocity", "constant velocity of the wall"}, w.velocity, units::velocity);
  f.number({"friction", "Coulomb coefficient"}, w.friction, bounds::not_negative);
}

void boundary_fields(Fields &f, Boundary &b)
{
  f.text({"body", "the body that is held or loaded", Need::mandatory}, b.body, "the name of a body");
  f.choice({"kind", "what is prescribed", Need::mandatory}, b.kind,
           {{"fixed", BoundaryKind::fixed},
            {"velocity", BoundaryKind::velocity},
            {"displacement", BoundaryKind::displacement},
            {"pressure", BoundaryKind::pressure},
            {"body-force", BoundaryKind::body_force},
            {"absorbing", BoundaryKind::absorbing}});
  f.text({"face",
          "x-, x+, y-, y+, z-, z+ of a box; bottom, top, side, inner, outer of a round body; a group of a mesh file "
          "by name or number, or rest: what is in no group; all",
          Need::mandatory,
           {"kind", {"fixed", "velocity", "displacement", "pressure", "absorbing"}}},
         b.face, "the name of a face");
  f.vector({"velocity", "prescribed velocity", Need::mandatory, {"kind", {"velocity"}}}, b.velocity, units::velocity);
  f.vector({"displacement", "prescribed displacement from the place at the start, times the history", Need::mandatory,
            {"kind", {"displacement"}}},
           b.displacement, units::length);
  f.vector({"acceleration", "acceleration that acts on all of the body, such as gravity", Need::mandatory,
            {"kind", {"body-force"}}},
           b.acceleration, units::acceleration);

  const std::vector<std::string> axes{"x", "y", "z"};
  std::vector<std::string>       held;
  for (int i = 0; i < 3; ++i)
    if (b.fix[i])
      held.push_back(axes[i]);
  f.names({"components", "directions in which the motion is prescribed", Need::optional,
           {"kind", {"fixed", "velocity", "displacement"}}},
          held, NamesPattern(axes));
  for (int i = 0; i < 3; ++i)
    b.fix[i] = std::find(held.begin(), held.end(), axes[i]) != held.end();

  f.quantity({"pressure", "pressure on the face", Need::mandatory, {"kind", {"pressure"}}}, b.pressure,
             units::pressure);
  f.history({"history",
             "factor in time of what is prescribed: linear between the entries, held beyond the first and the last; "
             "1 throughout without it",
             Need::optional,
             {"kind", {"velocity", "displacement", "pressure", "body-force"}}},
            b.history);
}

void interface_fields(Fields &f, Interface &i)
{
  f.choice({"method", "how motion and forces pass the seam"}, i.method, {"tied", "pair-flux", "blended"});
  f.text({"particles", "the body of particles"}, i.particles, "the name of a body with method sph");
  f.text({"mesh", "the body of elements that carries the particles"}, i.mesh, "the name of a body with method fem");
  f.text({"slave", "of two bodies of elements, the one whose surface nodes follow: the finer mesh"}, i.slave,
         "the name of a body with method fem");
  f.text({"master", "of two bodies of elements, the one whose facets lead"}, i.master,
         "the name of a body with method fem");
  f.text({"body", "in place of two bodies one that turns from elements into particles"}, i.body,
         "the name of a body with method auto");
  const Use flux{"method", {"pair-flux"}};
  f.number({"damping", "of the elements at the seam: their stress by strain rate over that by strain, in the time a wave "
                       "takes through an element",
            Need::optional, flux},
           i.damping, bounds::not_negative);
  f.number({"pair viscosity", "coefficient of the viscosity on what pairs at the seam move otherwise than their fields say",
            Need::optional, flux},
           i.pair_viscosity, bounds::not_negative);
  f.choice({"certificate", "what a run makes of a seam that reflects more than the limit: it refuses, warns, or does "
                           "not look"},
           i.certificate, {"check", "warn", "skip"});
  f.number({"reflection limit", "amplitude of the echo of a wave of the certificate wavelength over that of the wave"},
           i.reflection_limit, bounds::positive_fraction);
  f.quantity({"certificate wavelength", "the shortest wave that the seam shall pass; 0: 32 particle spacings"},
             i.certificate_wavelength, units::length, bounds::not_negative);
  f.number({"tolerance", "gap that is closed between two bodies of elements, in edges of the master's facet",
            Need::optional, {"slave", {}}},
           i.tolerance, bounds::positive_fraction);
  if (i.joins_meshes())
    i.method = "tied";
}

void contact_fields(Fields &f, Contact &c)
{
  std::vector<std::string> between;
  if (!c.first.empty())
    between = {c.first, c.second};
  f.names({"between", "the two bodies that may touch; one body twice: its fragments and folds", Need::mandatory}, between, NamesPattern({}, 2));
  if (between.size() == 2)
  {
    c.first  = between[0];
    c.second = between[1];
  }
  f.number({"friction", "Coulomb coefficient"}, c.friction, bounds::not_negative);
  f.choice({"overlap", "of points that overlap at the start: it counts as zero until it opens, the points are moved "
                       "apart, or the run refuses"},
           c.overlap, {"rest", "heal", "refuse"});
  f.number({"stiffness", "penalty stiffness, in effective mass over step squared"}, c.stiffness, Bound{0, .1, true});
}
} // namespace ogive::input
