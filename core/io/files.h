// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace ogive::io
{
/// A name beside `path` for a file in the making.
std::string temporary_name(const std::string &path);

/// Gives a finished file its name, replacing what is there, once its bytes are
/// on the disk. Throws RunError.
void put_in_place(const std::string &temporary, const std::string &path);

/// Writes a whole file so that no reader ever sees half of it. Throws RunError.
void write_whole(const std::string &path, const std::string &text);

/// The whole file; throws InputError if it cannot be read.
std::string read_whole(const std::string &path);
} // namespace ogive::io
