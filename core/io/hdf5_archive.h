// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/archive.h"
#include "core/parallel/ranks.h"

#include <memory>

namespace ogive::io
{
namespace hdf5
{
class File;
}

/// Raised when the contents of a checkpoint change their meaning.
inline constexpr std::int64_t checkpoint_version = 1;

/// Writes a checkpoint file. It gets its name at commit(): a run that is
/// killed leaves no half-written checkpoint under that name, and a writer that
/// goes away without commit() leaves nothing. Equal contents written in the
/// same order give equal bytes. Throws RunError when the file cannot be written.
///
/// On ranks all of them write one file together, without passing their parts to
/// one of them; every function is called by all, and what fails is thrown on all,
/// by commit() at the latest.
class Hdf5ArchiveWriter final : public ArchiveWriter
{
public:
  explicit Hdf5ArchiveWriter(const std::string &path, const Ranks & = {});
  ~Hdf5ArchiveWriter() override;
  Hdf5ArchiveWriter(const Hdf5ArchiveWriter &)            = delete;
  Hdf5ArchiveWriter &operator=(const Hdf5ArchiveWriter &) = delete;

  using ArchiveWriter::write;
  void write(const std::string &name, std::span<const double> values) override;
  void write(const std::string &name, std::span<const std::int64_t> values) override;
  /// `ranks`: those that write the file.
  void write_parts(const Ranks &ranks, const std::string &name, std::span<const double> own) override;
  void write_parts(const Ranks &ranks, const std::string &name, std::span<const std::int64_t> own) override;
  void write_text(const std::string &name, const std::string &text);

  void commit();

private:
  Ranks                       ranks_;
  std::string                 path_, temporary_;
  std::unique_ptr<hdf5::File> file_; ///< empty once committed
};

/// Reads a checkpoint file, on each rank by itself. Throws InputError with the file's name when it is
/// missing, cut short, not a checkpoint, or of another version.
class Hdf5ArchiveReader final : public ArchiveReader
{
public:
  explicit Hdf5ArchiveReader(const std::string &path);
  ~Hdf5ArchiveReader() override;

  bool                      contains(const std::string &name) const;
  std::vector<double>       doubles(const std::string &name) const override;
  std::vector<std::int64_t> integers(const std::string &name) const override;
  std::string               text(const std::string &name) const;

private:
  [[noreturn]] void missing(const std::string &name, const std::string &expected) const;

  std::unique_ptr<hdf5::File> file_;
};
} // namespace ogive::io
