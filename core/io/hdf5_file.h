// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

/// The little of HDF5's C interface that this project needs. Files carry no
/// modification times, so equal contents give equal bytes.
namespace ogive::io::hdf5
{
/// Owns an HDF5 identifier.
class Handle
{
public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer close)
    : id_(id)
    , close_(close)
  {}
  Handle(Handle &&other) noexcept
    : id_(std::exchange(other.id_, -1))
    , close_(other.close_)
  {}
  Handle &operator=(Handle &&other) noexcept
  {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { reset(); }

  /// Closes now; whether that went well.
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }
  /// Lets go of it, open as it is.
  void forget() { id_ = -1; }
  bool valid() const { return id_ >= 0; }
  hid_t get() const { return id_; }

private:
  hid_t  id_    = -1;
  Closer close_ = nullptr;
};

/// An open file. Failures of writing throw RunError (disk full, for example);
/// read functions return false or empty and leave the message to the caller.
///
/// A file made on several ranks is one file of all: writing is done by all of them
/// alike, write() puts down once what all have, write_parts() each rank's part.
/// What fails on one of them is thrown on all, by close().
class File
{
public:
  enum class Mode
  {
    create, ///< replaces what is there
    append, ///< reads and writes what is there
    read
  };
  /// Not open() if the file is missing, cut short or not HDF5.
  File(const std::string &path, Mode mode);
  /// Creates a file of all ranks; open() is the same on all.
  File(const std::string &path, const Ranks &ranks);
  ~File();
  File(const File &)            = delete;
  File &operator=(const File &) = delete;

  bool               open() const { return file_.valid(); }
  const std::string &path() const { return path_; }

  /// Scalars go in as one value; rows x columns, row-major, if columns > 1.
  void write(const std::string &name, std::span<const double> values, std::size_t columns = 1,
             bool single_precision = false);
  void write(const std::string &name, std::span<const std::int64_t> values);
  void write(const std::string &name, std::span<const std::uint32_t> values, std::size_t columns);
  void write_text(const std::string &name, const std::string &text);
  /// Parts of the ranks, one after the other. Whole rows, as many as each has.
  void write_parts(const std::string &name, std::span<const double> own, std::size_t columns = 1,
                   bool single_precision = false);
  void write_parts(const std::string &name, std::span<const std::int64_t> own);
  void write_parts(const std::string &name, std::span<const std::uint32_t> own, std::size_t columns);

  bool contains(const std::string &name) const;
  /// Whether `name` is there and holds such numbers or text.
  bool read(const std::string &name, std::vector<double> &) const;
  bool read(const std::string &name, std::vector<std::int64_t> &) const;
  bool read_text(const std::string &name, std::string &) const;
  void remove(const std::string &name);

  /// Writes everything out and closes; throws RunError if that fails.
  void close();

private:
  struct Kind
  {
    hid_t file, memory;
  };
  Handle             create_set(const std::string &name, hid_t file_type, std::span<const hsize_t> shape);
  void               write_raw(const std::string &name, Kind, std::span<const hsize_t> shape, const void *data);
  void               write_part(const std::string &name, Kind, std::size_t rows, std::size_t columns, const void *own);
  template <class T>
  bool               read_numbers(const std::string &name, H5T_class_t kind, hid_t memory_type,
                                  std::vector<T> &) const;
  void               fail(const std::string &what);

  std::string path_;
  Ranks       ranks_;
  Handle      file_;
  std::string failure_; ///< the first one, of a file of several ranks
};
} // namespace ogive::io::hdf5
