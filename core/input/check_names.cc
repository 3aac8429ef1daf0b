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

void check_boundaries(const Scene &s, const Listing &listing)
{
  for (const Boundary &b : s.boundaries)
  {
    const std::string section = "Boundaries/" + b.name;
    const Body       &body    = find_body(s, listing, section, "body", b.body);
    if (b.kind == BoundaryKind::pressure && body.method != Method::fem)
      throw InputError(listing.where(section, "kind"), "a pressure cannot act on the particles of \"" + b.body + "\"",
                       "a body with method fem");
    const std::vector<std::string> faces = faces_of(body.shape, s.dimension);
    if (!faces.empty() && std::find(faces.begin(), faces.end(), b.face) == faces.end())
      throw InputError(listing.where(section, "face"), "the body \"" + b.body + "\" has no face \"" + b.face + "\"",
                       "one of " + join(faces), did_you_mean(b.face, faces));
  }
}

void check_interfaces(const Scene &s, const Listing &listing)
{
  for (const Interface &i : s.interfaces)
  {
    const std::string section   = "Interfaces/" + i.name;
    const Body       &particles = find_body(s, listing, section, "particles", i.particles);
    const Body       &mesh      = find_body(s, listing, section, "mesh", i.mesh);
    if (particles.method != Method::sph)
      throw InputError(listing.where(section, "particles"), "the body \"" + i.particles + "\" is made of elements",
                       "a body with method sph");
    if (mesh.method != Method::fem)
      throw InputError(listing.where(section, "mesh"), "the body \"" + i.mesh + "\" is made of particles",
                       "a body with method fem");
    // with a spin or a field the halves of one motion have different centres
    const bool translate = particles.spin.isZero(0) && mesh.spin.isZero(0) && particles.velocity_field.empty() &&
                           mesh.velocity_field.empty();
    if (translate && (particles.velocity - mesh.velocity).norm() > 1e-12 * particles.velocity.norm())
      throw InputError(listing.where("Bodies/" + i.mesh, "velocity"),
                       "the body is tied to \"" + i.particles + "\" by the interface \"" + i.name +
                         "\" and moves otherwise",
                       "the velocity of \"" + i.particles + "\"");
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
    const auto same = [&](const std::string &a, const std::string &b) {
      return (a == c.first && b == c.second) || (a == c.second && b == c.first);
    };
    for (const Interface &i : s.interfaces)
      if (same(i.particles, i.mesh))
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
