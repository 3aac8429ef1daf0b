// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/input/scene.h"
#include "core/materials/parameters.h"

#include <string>
#include <vector>

namespace ogive::input
{
/// Reads a scene file, .prm or .json, and checks all that can be checked
/// without building meshes.
///
/// @param overrides "Section/entry=value", each put over what the file says,
///   such as "Bodies/plate/method=fem".
/// Throws InputError with file, line, entry, what was expected and the nearest
/// valid name.
///
/// Two passes: the first, lenient, finds the names of bodies, materials, walls
/// and so on; the second, strict, knows the entries of just those. How an entry
/// is added stands in fields.h.
Scene read_scene(const std::string &file, const std::vector<std::string> &overrides = {});

/// Throws an error found after reading (no such face, a mesh beyond its plane)
/// again, with the scene file and the line of the entry, section or name that
/// the error speaks of, as near as it can be told.
[[noreturn]] void rethrow_in_scene(const std::string &file, const InputError &);

/// The file of a material of the library. Throws InputError for an unknown
/// name, with the nearest known one.
std::string material_file(const std::string &name);

/// A material of the library; InputError as material_file().
materials::Parameters read_material(const std::string &name);

/// A material from a file of the library's form; its name is that of the file.
materials::Parameters read_material_file(const std::string &file);

/// Names in the library, sorted.
std::vector<std::string> list_materials();

/// The scene as a .prm with every default filled in and every material spelled
/// out. Reading it gives an equal scene (but for `file`), number by number.
std::string write_resolved(const Scene &);

/// Every entry of a scene: unit, bounds, default, meaning. Markdown.
std::string reference();
} // namespace ogive::input
