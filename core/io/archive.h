// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ogive
{
/// Where a solver writes its state for a checkpoint. Names are paths such as
/// "sph/x0". Values come back equal to the bit.
class ArchiveWriter
{
public:
  virtual ~ArchiveWriter()                                                                  = default;
  virtual void write(const std::string &name, std::span<const double> values)              = 0;
  virtual void write(const std::string &name, std::span<const std::int64_t> values)        = 0;
  void         write(const std::string &name, double v) { write(name, std::span<const double>(&v, 1)); }
  void write(const std::string &name, std::int64_t v) { write(name, std::span<const std::int64_t>(&v, 1)); }

  /// Values of which each of these ranks has its own part, put one after the other in
  /// the order of ranks. Called by all alike, as write() is, which takes what is the
  /// same on all of them.
  virtual void write_parts(const Ranks &ranks, const std::string &name, std::span<const double> own)
  {
    write(name, ranks.gather(own));
  }
  virtual void write_parts(const Ranks &ranks, const std::string &name, std::span<const std::int64_t> own)
  {
    write(name, ranks.gather(own));
  }
};

/// The other direction; on ranks each gets all values. A missing name is an InputError that says which file
/// lacks what.
class ArchiveReader
{
public:
  virtual ~ArchiveReader()                                                  = default;
  virtual std::vector<double>       doubles(const std::string &name) const  = 0;
  virtual std::vector<std::int64_t> integers(const std::string &name) const = 0;
  double       number(const std::string &name) const { return doubles(name).at(0); }
  std::int64_t integer(const std::string &name) const { return integers(name).at(0); }
};
} // namespace ogive
