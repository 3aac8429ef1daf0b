// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/library.h"

#include "core/input/reader.h"
#include "core/input/scene_fields.h"
#include "core/input/suggest.h"
#include "core/materials/elastic_constants.h"
#include "core/materials/material.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace ogive::input
{
namespace fs = std::filesystem;

namespace
{
/// Where the library lies: named by the environment, installed beside the
/// command, or in the source tree.
fs::path library_directory()
{
  if (const char *named = std::getenv("OGIVE_MATERIAL_LIBRARY"))
    return named;
  std::error_code error;
  const fs::path  command = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    if (const fs::path beside = command.parent_path().parent_path() / "share/ogive/materials"; fs::is_directory(beside))
      return beside;
  return OGIVE_MATERIAL_LIBRARY;
}
} // namespace

void rethrow_at(const Listing &listing, const std::string &section, const InputError &e)
{
  const std::string &entry = e.where().entry;
  const std::size_t  slash = entry.rfind('/');
  const bool         top   = slash == std::string::npos;
  throw InputError(listing.where(join_path(section, top ? "" : entry.substr(0, slash)), top ? entry : entry.substr(slash + 1)),
                   e.complaint());
}

void complete_material(materials::Parameters &p, const Listing &listing, const std::string &section)
{
  try
  {
    const materials::ElasticConstants constants = materials::ElasticConstants::of(p);
    p.shear_modulus                             = constants.shear;
    if (p.eos.law == "linear")
      p.eos.bulk_modulus = constants.bulk;
    materials::make_material(p);
  }
  catch (const InputError &e)
  {
    rethrow_at(listing, section, e);
  }
}

materials::Parameters read_material_file(const std::string &file)
{
  const Listing         listing = list_file(file);
  materials::Parameters p;
  p.name = fs::path(file).stem().string();
  Declarations declarations;
  material_fields(declarations, p);
  declarations.admit(listing);
  Loader loader(declarations.handler(), listing);
  material_fields(loader, p);
  complete_material(p, listing, "");
  return p;
}

std::string material_file(const std::string &name)
{
  const std::vector<std::string> known = list_materials();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw InputError({}, "there is no material \"" + name + "\"", "one of " + join(known), did_you_mean(name, known));
  return (library_directory() / (name + ".prm")).string();
}

materials::Parameters read_material(const std::string &name)
{
  return read_material_file(material_file(name));
}

std::vector<std::string> list_materials()
{
  std::vector<std::string> names;
  std::error_code          error;
  for (const fs::directory_entry &e : fs::directory_iterator(library_directory(), error))
    if (e.path().extension() == ".prm")
      names.push_back(e.path().stem().string());
  if (error)
    throw InputError("cannot read the material library in \"" + library_directory().string() + "\"");
  std::sort(names.begin(), names.end());
  return names;
}
} // namespace ogive::input
