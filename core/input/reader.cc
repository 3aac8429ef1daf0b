// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/reader.h"

#include "core/input/checks.h"
#include "core/input/declarations.h"
#include "core/input/library.h"
#include "core/input/quantities.h"
#include "core/input/scene_fields.h"
#include "core/input/suggest.h"

#include <algorithm>
#include <filesystem>

namespace ogive::input
{
namespace fs = std::filesystem;

namespace
{
template <class Item>
void outline_list(std::vector<Item> &items, const Listing &listing, const std::string &entry)
{
  for (const std::string &name : listing.names("", entry))
  {
    items.emplace_back();
    items.back().name = name;
  }
}

/// The lenient pass: names and what decides which entries there are. It
/// complains of nothing; the strict pass does.
Scene outline(const Listing &listing)
{
  Scene             s;
  const std::string dimension = listing.value("", "dimension");
  for (const Dimension d : {Dimension::uniaxial, Dimension::plane_strain, Dimension::axisymmetric, Dimension::three_d})
    if (dimension == describe(d))
      s.dimension = d;

  outline_list(s.materials, listing, "materials");
  outline_list(s.bodies, listing, "bodies");
  outline_list(s.walls, listing, "walls");
  outline_list(s.boundaries, listing, "boundaries");
  outline_list(s.interfaces, listing, "interfaces");
  outline_list(s.contacts, listing, "contacts");
  outline_list(s.observers, listing, "observers");

  for (Observer &o : s.observers)
    o.quantity = listing.value("Observers/" + o.name, "quantity", find_quantity(o.name) ? o.name : "");
  if (s.dimension == Dimension::axisymmetric)
    for (Body &b : s.bodies)
      b.shape.axis = Vec3::UnitY();
  return s;
}

/// scene.prm is named as its folder, a variant beside it "FOLDER-VARIANT", any
/// other file as itself.
std::string case_name(const fs::path &file)
{
  const fs::path    whole  = fs::absolute(file).lexically_normal();
  const std::string folder = whole.parent_path().filename().string(), stem = whole.stem().string();
  if (stem == "scene")
    return folder;
  return fs::exists(whole.parent_path() / "scene.prm") ? folder + "-" + stem : stem;
}

const materials::Parameters *find_material(const Scene &s, const std::string &name)
{
  const auto it = std::find_if(s.materials.begin(), s.materials.end(),
                               [&](const materials::Parameters &m) { return m.name == name; });
  return it == s.materials.end() ? nullptr : &*it;
}

/// Completes the scene's own materials and fetches the others.
void gather_materials(Scene &s, const Listing &listing)
{
  std::vector<std::string> known = list_materials();
  for (materials::Parameters &m : s.materials)
  {
    complete_material(m, listing, "Materials/" + m.name);
    known.push_back(m.name);
  }
  for (Body &b : s.bodies)
  {
    if (b.material == "from mesh")
    {
      if (b.shape.mesh_part.empty())
        throw InputError(listing.where("Bodies/" + b.name, "material"), "the body is no part of a mesh file",
                         "an entry \"mesh part\": its group is called as the material");
      b.material = b.shape.mesh_part;
    }
    if (find_material(s, b.material))
      continue;
    if (std::find(known.begin(), known.end(), b.material) == known.end())
      throw InputError(listing.where("Bodies/" + b.name, "material"), "there is no material \"" + b.material + "\"",
                       "one of " + join(known), did_you_mean(b.material, known));
    s.materials.push_back(read_material(b.material));
  }
}

/// Mesh files are named as seen from the scene file; from here on they are
/// absolute, so that a resolved scene reads the same from anywhere.
void find_meshes(Scene &s, const Listing &listing)
{
  for (Body &b : s.bodies)
    if (b.shape.kind == ShapeKind::mesh)
    {
      const fs::path mesh = fs::absolute(fs::path(s.file)).parent_path() / b.shape.mesh_file;
      if (!fs::is_regular_file(mesh))
        throw InputError(listing.where("Bodies/" + b.name, "mesh file"),
                         "there is no file \"" + mesh.lexically_normal().string() + "\"", "a mesh file");
      b.shape.mesh_file = mesh.lexically_normal().string();
    }
}
} // namespace

Scene read_scene(const std::string &file, const std::vector<std::string> &overrides)
{
  if (!fs::is_regular_file(file))
    throw InputError({file, 0, {}}, "there is no such file", "a scene file");
  Listing listing = list_file(file);
  for (const std::string &o : overrides)
    apply_override(listing, o);

  Scene             s            = outline(listing);
  const std::size_t own_materials = s.materials.size();
  Declarations      declarations;
  scene_fields(declarations, s, own_materials);
  declarations.admit(listing);
  check_vectors(declarations, listing, s.dimension);
  check_lists(s, listing);

  Loader loader(declarations.handler(), listing);
  scene_fields(loader, s, own_materials);
  s.file = file;
  if (s.name.empty())
    s.name = case_name(file);
  if (s.output.history_interval == 0)
    s.output.history_interval = s.end_time / 200;

  gather_materials(s, listing);
  find_meshes(s, listing);
  check_names(s, listing);
  check_geometry(s, listing);
  check_motion(s, listing);
  check_start(s, listing);
  return s;
}

void rethrow_in_scene(const std::string &file, const InputError &e)
{
  if (e.where().line > 0 || !fs::is_regular_file(file))
    throw e;
  const Listing      listing = list_file(file);
  const std::string &entry   = e.where().entry;
  // a subsection by its path or its name, else an entry of one
  for (const ListedSection &section : listing.sections)
    if (!entry.empty() && (section.path == entry || section.path.ends_with("/" + entry)))
      throw InputError({section.file, section.line, section.path}, e.complaint());
  const std::size_t slash = entry.rfind('/');
  throw InputError(slash == std::string::npos ? listing.where("", entry) :
                                                listing.where(entry.substr(0, slash), entry.substr(slash + 1)),
                   e.complaint());
}

std::string write_resolved(const Scene &scene)
{
  Scene  s = scene;
  Writer writer;
  scene_fields(writer, s, s.materials.size());
  return writer.text();
}
} // namespace ogive::input
