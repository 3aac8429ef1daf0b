// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/scene_fields.h"

#include <algorithm>

namespace ogive::input
{
namespace
{
template <class Item>
std::vector<std::string> names_of(const std::vector<Item> &items, std::size_t count)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(items[i].name);
  return names;
}

template <class Item>
std::vector<std::string> names_of(const std::vector<Item> &items)
{
  return names_of(items, items.size());
}

/// A list whose items exist already: reading it again changes nothing.
void list(Fields &f, const About &about, std::vector<std::string> names)
{
  f.names(about, names);
}

template <class Item, class Each>
void subsections(Fields &f, const std::string &section, std::vector<Item> &items, std::size_t count, const Each &each)
{
  if (count == 0)
    return;
  f.enter(section);
  for (std::size_t i = 0; i < count; ++i)
  {
    f.enter(items[i].name);
    each(items[i]);
    f.leave();
  }
  f.leave();
}

void symmetry_field(Fields &f, Scene &s)
{
  const std::vector<std::string> axes{"x", "y", "z"};
  std::vector<std::string>       planes;
  for (const SymmetryPlane &p : s.symmetry)
    planes.push_back(axes[p.axis]);
  f.names({"symmetry planes", "keeps the half x >= 0 (y, z) of everything"}, planes, NamesPattern(axes));
  s.symmetry.clear();
  for (const std::string &p : planes)
    s.symmetry.push_back({static_cast<int>(std::find(axes.begin(), axes.end(), p) - axes.begin())});
}
} // namespace

int space_dimension(Dimension d)
{
  return d == Dimension::uniaxial ? 1 : d == Dimension::three_d ? 3 : 2;
}

std::string describe(Dimension d)
{
  switch (d)
  {
    case Dimension::uniaxial:
      return "uniaxial";
    case Dimension::plane_strain:
      return "plane-strain";
    case Dimension::axisymmetric:
      return "axisymmetric";
    case Dimension::three_d:
      return "3d";
  }
  return "";
}

void scene_fields(Fields &f, Scene &s, std::size_t inline_materials)
{
  f.text({"name", "name of the case; by default that of the folder (scene.prm), or of the file"}, s.name);
  f.text({"title", "one line for people"}, s.title);
  f.choice({"dimension", "uniaxial: x alone; plane-strain: x, y; axisymmetric: x is the radius, y the axis",
            Need::mandatory},
           s.dimension,
           {{"uniaxial", Dimension::uniaxial},
            {"plane-strain", Dimension::plane_strain},
            {"axisymmetric", Dimension::axisymmetric},
            {"3d", Dimension::three_d}});
  f.quantity({"end time", "when the run ends", Need::mandatory}, s.end_time, units::time, bounds::positive);
  list(f, {"bodies", "names of the bodies, each with a subsection of Bodies", Need::mandatory}, names_of(s.bodies));
  list(f, {"materials", "names of the materials described in the scene itself"},
       names_of(s.materials, inline_materials));
  symmetry_field(f, s);
  list(f, {"walls", "names of the rigid walls"}, names_of(s.walls));
  list(f, {"boundaries", "names of the boundary conditions"}, names_of(s.boundaries));
  list(f, {"interfaces", "names of the interfaces between bodies"}, names_of(s.interfaces));
  list(f, {"contacts", "names of the pairs of bodies that may touch"}, names_of(s.contacts));
  list(f, {"observers", "names of what the summary shows"}, names_of(s.observers));

  subsections(f, "Materials", s.materials, inline_materials,
              [&](materials::Parameters &m) { material_fields(f, m); });
  subsections(f, "Bodies", s.bodies, s.bodies.size(), [&](Body &b) { body_fields(f, b, s.dimension); });
  subsections(f, "Walls", s.walls, s.walls.size(), [&](RigidWall &w) { wall_fields(f, w); });
  subsections(f, "Boundaries", s.boundaries, s.boundaries.size(), [&](Boundary &b) { boundary_fields(f, b); });
  subsections(f, "Interfaces", s.interfaces, s.interfaces.size(), [&](Interface &i) { interface_fields(f, i); });
  subsections(f, "Contacts", s.contacts, s.contacts.size(), [&](Contact &c) { contact_fields(f, c); });
  subsections(f, "Observers", s.observers, s.observers.size(), [&](Observer &o) { observer_fields(f, o); });
  option_fields(f, s);
}
} // namespace ogive::input
