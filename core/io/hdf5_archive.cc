// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/hdf5_archive.h"

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/hdf5_file.h"
#include "core/parallel/together.h"

#include <filesystem>

namespace ogive::io
{
namespace
{
const std::string format_name  = "format";
const std::string version_name = "format_version";
const std::string format       = "ogive checkpoint";
} // namespace

Hdf5ArchiveWriter::Hdf5ArchiveWriter(const std::string &path, const Ranks &ranks)
  : ranks_(ranks)
  , path_(path)
  , temporary_(temporary_name(path))
  , file_(std::make_unique<hdf5::File>(temporary_, ranks))
{
  if (!file_->open())
    throw RunError(path + ": cannot write the checkpoint; is the directory writable?");
  file_->write_text(format_name, format);
  write(version_name, checkpoint_version);
}

Hdf5ArchiveWriter::~Hdf5ArchiveWriter()
{
  if (!file_)
    return;
  file_.reset();
  std::error_code ignored;
  if (ranks_.first())
    std::filesystem::remove(temporary_, ignored);
}

void Hdf5ArchiveWriter::write(const std::string &name, std::span<const double> values)
{
  file_->write(name, values);
}

void Hdf5ArchiveWriter::write(const std::string &name, std::span<const std::int64_t> values)
{
  file_->write(name, values);
}

void Hdf5ArchiveWriter::write_parts(const Ranks &ranks, const std::string &name, std::span<const double> own)
{
  require(ranks.size() == ranks_.size(), "an archive takes parts of the ranks that write it");
  file_->write_parts(name, own);
}

void Hdf5ArchiveWriter::write_parts(const Ranks &ranks, const std::string &name, std::span<const std::int64_t> own)
{
  require(ranks.size() == ranks_.size(), "an archive takes parts of the ranks that write it");
  file_->write_parts(name, own);
}

void Hdf5ArchiveWriter::write_text(const std::string &name, const std::string &text)
{
  file_->write_text(name, text);
}

void Hdf5ArchiveWriter::commit()
{
  require(file_ != nullptr, "a checkpoint is committed once");
  file_->close();
  on_first(ranks_, [this] { put_in_place(temporary_, path_); });
  file_.reset();
}

Hdf5ArchiveReader::Hdf5ArchiveReader(const std::string &path)
{
  if (!std::filesystem::is_regular_file(path))
    throw InputError({.file = path, .line = 0, .entry = {}}, "no such checkpoint", "a file checkpoint-*.h5",
                     "give the directory of a run that wrote checkpoints");
  file_ = std::make_unique<hdf5::File>(path, hdf5::File::Mode::read);
  if (!file_->open())
    throw InputError({.file = path, .line = 0, .entry = {}}, "the checkpoint is cut short or damaged",
                     "a complete HDF5 file", "restart from an earlier checkpoint");
  std::string written;
  if (!file_->read_text(format_name, written) || written != format)
    throw InputError({.file = path, .line = 0, .entry = {}}, "not a checkpoint of this program",
                     "a file checkpoint-*.h5");
  const std::int64_t version = integer(version_name);
  if (version != checkpoint_version)
    throw InputError({.file = path, .line = 0, .entry = {}},
                     "checkpoint of format version " + std::to_string(version),
                     "format version " + std::to_string(checkpoint_version),
                     "restart it with the program that wrote it");
}

Hdf5ArchiveReader::~Hdf5ArchiveReader() = default;

void Hdf5ArchiveReader::missing(const std::string &name, const std::string &expected) const
{
  const bool there = file_->contains(name);
  throw InputError({.file = file_->path(), .line = 0, .entry = name},
                   there ? "of another kind, or damaged" : "missing from the checkpoint", expected);
}

bool Hdf5ArchiveReader::contains(const std::string &name) const
{
  return file_->contains(name);
}

std::vector<double> Hdf5ArchiveReader::doubles(const std::string &name) const
{
  std::vector<double> values;
  if (!file_->read(name, values))
    missing(name, "real numbers");
  return values;
}

std::vector<std::int64_t> Hdf5ArchiveReader::integers(const std::string &name) const
{
  std::vector<std::int64_t> values;
  if (!file_->read(name, values))
    missing(name, "whole numbers");
  return values;
}

std::string Hdf5ArchiveReader::text(const std::string &name) const
{
  std::string value;
  if (!file_->read_text(name, value))
    missing(name, "text");
  return value;
}
} // namespace ogive::io
