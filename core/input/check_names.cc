// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/checks.h"
#include "core/input/suggest.h"

#include <algorithm>

namespace ogive::input
{
namespace
{
std::vector<std::string> body_names(const Scene &s)
{
  std::vector<std::string> names;
  for (const Body &b : s.bodies)
    names.push_back(b.name);
  return names;
}

const Body &find_body(const Scene &s, const Listing &listing, const std::string &section, const std::string &entry,
                      const std::string &name)
{
  for (const Body &b : s.bodies)
    if (b.name == name)
      return b;
  const std::vector<std::string> known = body_names(s);
  throw InputError(listing.where(section, entry), "there is no body \"" + name + "\"", "one of " + join(known),
                   did_you_mean(name, known));
}

std::vector<std::string> faces_of(const Shape &shape, Dimension d)
{
  const bool flat = d == Dimension::plane_strain;
  switch (shape.kind)
  {
    case ShapeKind::box:
    {
      std::vector<std::string> faces{"x-", "x+", "y-", "y+", "z-", "z+"};
      faces.resize(2 * space_dimension(d));
      faces.emplace_back("all");
      return faces;
    }
    case ShapeKind::cylinder:
    case ShapeKind::disc:
      return flat ? std::vector<std::string>{"side", "outer", "all"} :
                    std::vector<std::string>{"bottom", "top", "side", "outer", "all"};
    case ShapeKind::ring:
      return flat ? std::vector<std::string>{"inner", "outer", "all"} :
                    std::vector<std::string>{"bottom", "top", "inner", "outer", "all"};
    case ShapeKind::sphere:
      return {"outer", "all"};
    case ShapeKind::shell:
      return {"inner", "outer", "all"};
    case ShapeKind::mesh:
      return {};
  }
  return {};
}

/// Particles know constant motion only.
void check_particle_boundary(const Boundary &b, const Listing &listing)
{
  const std::string section = "Boundaries/" + b.name;
  if (b.kind == BoundaryKind::pressure)
    throw InputError(listing.where(section, "kind"), "a pressure cannot act on the particles of \"" + b.body + "\"",
                     "a body with method fem");
  if (b.kind != BoundaryKind::fixed && b.kind != BoundaryKind::velocity)
    throw InputError(listing.where(section, "kind"),
                     "\"" + b.body + "\" is made of particles, which are held or driven at constant velocity only",
                     "fixed or velocity, or a body with method fem");
  if (!b.history.empty())
    throw InputError(listing.where(section, "history"),
                     "\"" + b.body + "\" is made of particles, which are driven at constant velocity only",
                     "no history, or a body with method fem");
}

void check_load(const Scene &s, const Boundary &b, const Listing &listing)
{
  const std::string section = "Boundaries/" + b.name;
  if (b.kind == BoundaryKind::body_force && s.dimension == Dimension::axisymmetric && b.acceleration.x() != 0)
    throw InputError(listing.where(section, "acceleration"), "x is the radius: a body force acts along the axis only",
                     "0 along x");
  if (b.kind == BoundaryKind::displacement && b.history.empty())
    throw InputError(listing.where(section, "history"), "without a history the face would jump at the start",
                     "a table that begins with 0, such as \"0 us: 0, 10 us: 1\"");
  if (b.kind == BoundaryKind::displacement && b.history.at(0) != 0)
    throw InputError(listing.where(section, "history"),
                     "the face would jump at the start: the factor at time 0 is " +
                       units::format_number(b.history.at(0)),
                     "a table that begins with 0, such as \"0 us: 0, 10 us: 1\"");
}

void check_boundaries(const Scene &s, const Listing &listing)
{
  for (const Boundary &b : s.boundaries)
  {
    const std::string section = "Boundaries/" + b.name;
    const Body       &body    = find_body(s, listing, section, "body", b.body);
    if (body.method == Method::sph)
      check_particle_boundary(b, listing);
    check_load(s, b, listing);
    if (b.kind == BoundaryKind::body_force)
      continue;
    const std::vector<std::string> faces = faces_of(body.shape, s.dimension);
    if (!faces.empty() && std::find(faces.begin(), faces.end(), b.face) == faces.end())
      throw InputError(listing.where(section, "face"), "the body \"" + b.body + "\" has no face \"" + b.face + "\"",
                       "one of " + join(faces), did_you_mean(b.face, faces));
  }
}

/// The two bodies that an interface joins.
struct Pair
{
  const char *first, *second; ///< their entries
  const Body &a, &b;
};

Pair pair_of(const Scene &s, const Interface &i, const Listing &listing)
{
  const std::string section = "Interfaces/" + i.name;
  const bool        meshes  = i.joins_meshes();
  for (const char *entry : {"particles", "mesh"})
    if (meshes && listing.find(section, entry))
      throw InputError(listing.where(section, entry), "the interface joins two bodies of elements by their meshes",
                       "\"slave\" and \"master\", or \"particles\" and \"mesh\"");
  const char        *entries[2] = {meshes ? "slave" : "particles", meshes ? "master" : "mesh"};
  const std::string &first = meshes ? i.slave : i.particles, &second = meshes ? i.master : i.mesh;
  for (int k = 0; k < 2; ++k)
    if ((k ? second : first).empty())
      throw InputError(listing.where(section, entries[k]), "the entry is missing",
                       k || meshes ? "the name of a body with method fem" : "the name of a body with method sph");
  return {entries[0], entries[1], find_body(s, listing, section, entries[0], first),
          find_body(s, listing, section, entries[1], second)};
}

void check_interfaces(const Scene &s, const Listing &listing)
{
  for (const Interface &i : s.interfaces)
  {
    const std::string section = "Interfaces/" + i.name;
    if (!i.body.empty())
    {
      for (const char *entry : {"particles", "mesh", "slave", "master"})
        if (listing.find(section, entry))
          throw InputError(listing.where(section, entry), "the interface is one within the body \"" + i.body + "\"",
                           "\"body\" alone, or two bodies");
      if (find_body(s, listing, section, "body", i.body).method != Method::automatic)
        throw InputError(listing.where(section, "body"), "no element of the body \"" + i.body + "\" turns into particles",
                         "a body with method auto");
      continue;
    }
    const Pair pair = pair_of(s, i, listing);
    if (!i.joins_meshes() && pair.a.method != Method::sph)
      throw InputError(listing.where(section, pair.first), "the body \"" + pair.a.name + "\" is made of elements",
                       "a body with method sph");
    if (i.joins_meshes() && pair.a.method != Method::fem)
      throw InputError(listing.where(section, pair.first), "the body \"" + pair.a.name + "\" is made of particles",
                       "a body with method fem");
    if (pair.b.method != Method::fem)
      throw InputError(listing.where(section, pair.second), "the body \"" + pair.b.name + "\" is made of particles",
                       "a body with method fem");
    if (&pair.a == &pair.b)
      throw InputError(listing.where(section, pair.second), "the body \"" + pair.a.name + "\" is tied to itself",
                       "two different bodies");
    // with a spin or a field the halves of one motion have different centres
    const bool translate = pair.a.spin.isZero(0) && pair.b.spin.isZero(0) && pair.a.velocity_field.empty() &&
                           pair.b.velocity_field.empty();
    if (translate && (pair.a.velocity - pair.b.velocity).norm() > 1e-12 * pair.a.velocity.norm())
      throw InputError(listing.where("Bodies/" + pair.b.name, "velocity"),
                       "the body is tied to \"" + pair.a.name + "\" by the interface \"" + i.name +
                         "\" and moves otherwise",
                       "the velocity of \"" + pair.a.name + "\"");
  }
}

void check_contacts(const Scene &s, const Listing &listing)
{
  for (std::size_t k = 0; k < s.contacts.size(); ++k)
  {
    const Contact    &c       = s.contacts[k];
    const std::string section = "Contacts/" + c.name;
    find_body(s, listing, section, "between", c.first);
    find_body(s, listing, section, "between", c.second);
    if (c.first == c.second && s.dimension == Dimension::uniaxial)
      throw InputError(listing.where(section, "between"), "in one dimension a body cannot meet itself",
                       "two different bodies");
    const auto same = [&](const std::string &a, const std::string &b) {
      return (a == c.first && b == c.second) || (a == c.second && b == c.first);
    };
    for (const Interface &i : s.interfaces)
      if (same(i.particles, i.mesh) || same(i.slave, i.master))
        throw InputError(listing.where(section, "between"),
                         "these bodies are tied by the interface \"" + i.name + "\"", "two bodies that are apart");
    for (std::size_t l = 0; l < k; ++l)
      if (same(s.contacts[l].first, s.contacts[l].second))
        throw InputError(listing.where(section, "between"),
                         "these bodies are already paired by \"" + s.contacts[l].name + "\"", "each pair once");
  }
}
} // namespace

void check_vectors(const Declarations &declarations, const Listing &listing, Dimension dimension)
{
  const auto dim = static_cast<std::size_t>(space_dimension(dimension));
  for (const DeclaredEntry &e : declarations.entries())
  {
    const ListedEntry *given = listing.find(e.section, e.name);
    if (!given || !dynamic_cast<const VectorPattern *>(e.pattern.get()))
      continue;
    const std::size_t n = count_components(given->value);
    if (n != dim && n != 3)
      throw InputError(listing.where(e.section, e.name),
                       "\"" + given->value + "\" has " + std::to_string(n) + " components",
                       std::to_string(dim) + (dim == 3 ? "" : " or 3") + " in a scene of dimension " +
                         describe(dimension));
    for (std::size_t i = dim; i < n; ++i)
      if (units::parse_quantity(split_list(given->value)[i]).value != 0)
        throw InputError(listing.where(e.section, e.name),
                         "\"" + given->value + "\" points out of the space of the scene",
                         "zero along " + std::string(1, "xyz"[i]) + " in a scene of dimension " +
                           describe(dimension));
  }
}

void check_lists(const Scene &s, const Listing &listing)
{
  if (s.bodies.empty())
    throw InputError(listing.where("", "bodies"), listing.find("", "bodies") ? "there is no body" : "the entry is missing",
                     "a list of names, such as \"projectile, plate\"");
  const auto check = [&](const std::string &entry, const std::string &section, const auto &items) {
    for (const auto &item : items)
    {
      const std::string path = section + "/" + item.name;
      const auto        within = [&](const std::string &p) { return p == path || p.starts_with(path + "/"); };
      if (std::none_of(listing.sections.begin(), listing.sections.end(),
                       [&](const ListedSection &x) { return within(x.path); }) &&
          std::none_of(listing.entries.begin(), listing.entries.end(),
                       [&](const ListedEntry &x) { return within(x.section); }))
        throw InputError(listing.where("", entry), "\"" + item.name + "\" is not described",
                         "a subsection \"" + path + "\"");
    }
  };
  check("bodies", "Bodies", s.bodies);
  check("materials", "Materials", s.materials);
  check("walls", "Walls", s.walls);
  check("boundaries", "Boundaries", s.boundaries);
  check("interfaces", "Interfaces", s.interfaces);
  check("contacts", "Contacts", s.contacts);
}

void check_names(const Scene &s, const Listing &listing)
{
  check_boundaries(s, listing);
  check_interfaces(s, listing);
  check_contacts(s, listing);
  for (const Observer &o : s.observers)
    if (!o.body.empty())
      find_body(s, listing, "Observers/" + o.name, "body", o.body);
  if (s.stop.active)
    find_body(s, listing, "Stop", "body", s.stop.body);
}
} // namespace ogive::input
