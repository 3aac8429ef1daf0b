// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"
#include "core/io/archive.h"

#include <map>

namespace ogive::io
{
/// A checkpoint that stays in memory.
class MemoryArchive final : public ArchiveWriter, public ArchiveReader
{
public:
  using ArchiveWriter::write;
  void write(const std::string &name, std::span<const double> values) override
  {
    doubles_[name].assign(values.begin(), values.end());
  }
  void write(const std::string &name, std::span<const std::int64_t> values) override
  {
    integers_[name].assign(values.begin(), values.end());
  }
  std::vector<double>       doubles(const std::string &name) const override { return find(doubles_, name); }
  std::vector<std::int64_t> integers(const std::string &name) const override { return find(integers_, name); }

private:
  template <class Map>
  static typename Map::mapped_type find(const Map &map, const std::string &name)
  {
    const auto at = map.find(name);
    if (at == map.end())
      throw InputError({.file = "memory", .line = 0, .entry = name}, "missing from the checkpoint");
    return at->second;
  }

  std::map<std::string, std::vector<double>>       doubles_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};
} // namespace ogive::io
