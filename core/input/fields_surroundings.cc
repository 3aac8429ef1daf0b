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
  f.text({"body", "the body whose face is held or loaded", Need::mandatory}, b.body, "the name of a body");
  f.text({"face",
          "x-, x+, y-, y+, z-, z+ of a box; bottom, top, side, inner, outer of a round body; a group of a mesh file "
          "by name or number, or rest: what is in no group; all",
          Need::mandatory},
         b.face, "the name of a face");
  f.choice({"kind", "what is prescribed", Need::mandatory}, b.kind,
           {{"fixed", BoundaryKind::fixed}, {"velocity", BoundaryKind::velocity}, {"pressure", BoundaryKind::pressure}});
  f.vector({"velocity", "prescribed velocity", Need::mandatory, {"kind", {"velocity"}}}, b.velocity, units::velocity);

  const std::vector<std::string> axes{"x", "y", "z"};
  std::vector<std::string>       held;
  for (int i = 0; i < 3; ++i)
    if (b.fix[i])
      held.push_back(axes[i]);
  f.names({"components", "directions in which the motion is prescribed", Need::optional, {"kind", {"fixed", "velocity"}}},
          held, NamesPattern(axes));
  for (int i = 0; i < 3; ++i)
    b.fix[i] = std::find(held.begin(), held.end(), axes[i]) != held.end();

  f.quantity({"pressure", "constant pressure on the face", Need::mandatory, {"kind", {"pressure"}}}, b.pressure,
             units::pressure);
}

void interface_fields(Fields &f, Interface &i)
{
  f.choice({"method", "how motion and forces pass the seam"}, i.method, {"tied"});
  f.text({"particles", "the body of particles", Need::mandatory}, i.particles, "the name of a body with method sph");
  f.text({"mesh", "the body of elements", Need::mandatory}, i.mesh, "the name of a body with method fem");
}

void contact_fields(Fields &f, Contact &c)
{
  std::vector<std::string> between;
  if (!c.first.empty())
    between = {c.first, c.second};
  f.names({"between", "the two bodies that may touch", Need::mandatory}, between, NamesPattern({}, 2));
  if (between.size() == 2)
  {
    c.first  = between[0];
    c.second = between[1];
  }
  f.number({"friction", "Coulomb coefficient"}, c.friction, bounds::not_negative);
  f.number({"stiffness", "penalty stiffness, in effective mass over step squared"}, c.stiffness, Bound{0, .1, true});
}
} // namespace ogive::input
