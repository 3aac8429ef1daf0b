// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/files.h"

#include "core/base/error.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace ogive::io
{
std::string temporary_name(const std::string &path)
{
  return path + ".part";
}

void put_in_place(const std::string &temporary, const std::string &path)
{
  // A rename may reach the disk before the bytes do; a power cut between the
  // two would leave an empty file under the final name.
  const int  file    = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && ::fsync(file) == 0;
  if (file >= 0)
    ::close(file);
  std::error_code error;
  if (on_disk)
    std::filesystem::rename(temporary, path, error);
  if (!on_disk || error)
    throw RunError(path + ": cannot be written; is the disk full or the directory gone?");
}

void write_whole(const std::string &path, const std::string &text)
{
  const std::string temporary = temporary_name(path);
  {
    std::ofstream out(temporary, std::ios::binary);
    out << text << std::flush;
    if (!out)
      throw RunError(path + ": cannot be written; is the disk full or the directory gone?");
  }
  put_in_place(temporary, path);
}

std::string read_whole(const std::string &path)
{
  std::ifstream      in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.bad())
    throw InputError({.file = path, .line = 0, .entry = {}}, "cannot be read", "a readable file");
  return text.str();
}
} // namespace ogive::io
