// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/hdf5_file.h"

#include "core/base/error.h"
#include "core/parallel/together.h"

#include <mpi.h>

#include <array>
#include <exception>
#include <numeric>

namespace ogive::io::hdf5
{
namespace
{
/// Keeps HDF5 from printing its own stack: callers say what went wrong.
class Quiet
{
public:
  Quiet()
  {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet &)            = delete;
  Quiet &operator=(const Quiet &) = delete;

private:
  H5E_auto2_t print_ = nullptr;
  void       *data_  = nullptr;
};

hid_t open_file(const std::string &path, File::Mode mode)
{
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Closing the file closes for certain, whatever is still open in it.
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // A viewer that has the file open must not stop a run.
  H5Pset_file_locking(access.get(), 0, 1);
  switch (mode)
    {
      case File::Mode::create:
        return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get());
      case File::Mode::append:
        return H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get());
      case File::Mode::read:
        break;
    }
  return H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
}
} // namespace

File::File(const std::string &path, Mode mode)
  : path_(path)
{
  const Quiet quiet;
  file_ = Handle(open_file(path, mode), H5Fclose);
}

File::File(const std::string &path, const Ranks &ranks)
  : path_(path)
  , ranks_(ranks)
{
  const Quiet quiet;
  if (ranks.alone())
  {
    file_ = Handle(open_file(path, Mode::create), H5Fclose);
    return;
  }
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access.get(), *static_cast<const MPI_Comm *>(ranks.communicator()), MPI_INFO_NULL);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  file_ = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  if (!ranks.all(file_.valid()))
    file_.forget();
}

File::~File()
{
  // Ranks close a file together; one that is thrown out of its work would wait for ever.
  if (!ranks_.alone() && std::uncaught_exceptions() > 0)
    file_.forget();
}

void File::fail(const std::string &what)
{
  const std::string failure = path_ + ": cannot write " + what + "; is the disk full?";
  if (ranks_.alone())
    throw RunError(failure);
  if (failure_.empty())
    failure_ = failure;
}

Handle File::create_set(const std::string &name, hid_t file_type, std::span<const hsize_t> shape)
{
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), 0);
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  return {H5Dcreate2(file_.get(), name.c_str(), file_type, space.get(), links.get(), creation.get(), H5P_DEFAULT),
          H5Dclose};
}

void File::write_raw(const std::string &name, Kind kind, std::span<const hsize_t> shape, const void *data)
{
  const Quiet  quiet;
  const Handle set = create_set(name, kind.file, shape);
  if (!set.valid() ||
      (ranks_.first() && H5Dwrite(set.get(), kind.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
    fail('"' + name + '"');
}

void File::write_part(const std::string &name, Kind kind, std::size_t rows, std::size_t columns, const void *own)
{
  const std::vector<std::uint64_t> all = ranks_.gather_one(static_cast<std::uint64_t>(rows));

  const hsize_t                first = std::accumulate(all.begin(), all.begin() + ranks_.rank(), hsize_t(0));
  const std::array<hsize_t, 2> shape{std::accumulate(all.begin(), all.end(), hsize_t(0)), columns};
  const auto                   used = std::span(shape).first(columns == 1 ? 1 : 2);

  const Quiet  quiet;
  const Handle set = create_set(name, kind.file, used);
  if (!set.valid())
    return fail('"' + name + '"');
  if (shape[0] == 0)
    return;
  const std::array<hsize_t, 2> at{first, 0}, size{rows, columns};
  const Handle                 place(H5Dget_space(set.get()), H5Sclose);
  const Handle                 memory(H5Screate_simple(static_cast<int>(used.size()), size.data(), nullptr), H5Sclose);
  const Handle                 transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  if (rows > 0)
    H5Sselect_hyperslab(place.get(), H5S_SELECT_SET, at.data(), nullptr, size.data(), nullptr);
  else
    H5Sselect_none(place.get());
  H5Pset_dxpl_mpio(transfer.get(), H5FD_MPIO_COLLECTIVE);
  if (H5Dwrite(set.get(), kind.memory, memory.get(), place.get(), transfer.get(), own) < 0)
    fail('"' + name + '"');
}

void File::write(const std::string &name, std::span<const double> values, std::size_t columns,
                 bool single_precision)
{
  require(columns > 0 && values.size() % columns == 0, "values do not fill whole rows");
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  write_raw(name, {single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE},
            std::span(shape).first(columns == 1 ? 1 : 2), values.data());
}

void File::write(const std::string &name, std::span<const std::int64_t> values)
{
  const std::array<hsize_t, 1> shape{values.size()};
  write_raw(name, {H5T_STD_I64LE, H5T_NATIVE_INT64}, shape, values.data());
}

void File::write(const std::string &name, std::span<const std::uint32_t> values, std::size_t columns)
{
  require(columns > 0 && values.size() % columns == 0, "values do not fill whole rows");
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  write_raw(name, {H5T_STD_U32LE, H5T_NATIVE_UINT32}, std::span(shape).first(columns == 1 ? 1 : 2),
            values.data());
}

void File::write_text(const std::string &name, const std::string &text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // One byte more than the text: a string type cannot be empty.
  H5Tset_size(type.get(), text.size() + 1);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  write_raw(name, {type.get(), type.get()}, {}, text.c_str());
}

void File::write_parts(const std::string &name, std::span<const double> own, std::size_t columns, bool single_precision)
{
  if (ranks_.alone())
    return write(name, own, columns, single_precision);
  require(columns > 0 && own.size() % columns == 0, "values do not fill whole rows");
  write_part(name, {single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}, own.size() / columns,
             columns, own.data());
}

void File::write_parts(const std::string &name, std::span<const std::int64_t> own)
{
  if (ranks_.alone())
    return write(name, own);
  write_part(name, {H5T_STD_I64LE, H5T_NATIVE_INT64}, own.size(), 1, own.data());
}

void File::write_parts(const std::string &name, std::span<const std::uint32_t> own, std::size_t columns)
{
  if (ranks_.alone())
    return write(name, own, columns);
  require(columns > 0 && own.size() % columns == 0, "values do not fill whole rows");
  write_part(name, {H5T_STD_U32LE, H5T_NATIVE_UINT32}, own.size() / columns, columns, own.data());
}

bool File::contains(const std::string &name) const
{
  const Quiet quiet;
  // Each group on the way must be asked for by itself.
  for (std::size_t i = name.find('/', 1); i != std::string::npos; i = name.find('/', i + 1))
    if (H5Lexists(file_.get(), name.substr(0, i).c_str(), H5P_DEFAULT) <= 0)
      return false;
  return H5Lexists(file_.get(), name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
bool File::read_numbers(const std::string &name, H5T_class_t kind, hid_t memory_type,
                        std::vector<T> &values) const
{
  if (!contains(name))
    return false;
  const Quiet  quiet;
  const Handle set(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid())
    return false;
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  if (H5Tget_class(type.get()) != kind)
    return false;
  values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  return H5Dread(set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
}

bool File::read(const std::string &name, std::vector<double> &values) const
{
  return read_numbers(name, H5T_FLOAT, H5T_NATIVE_DOUBLE, values);
}

bool File::read(const std::string &name, std::vector<std::int64_t> &values) const
{
  return read_numbers(name, H5T_INTEGER, H5T_NATIVE_INT64, values);
}

bool File::read_text(const std::string &name, std::string &text) const
{
  if (!contains(name))
    return false;
  const Quiet  quiet;
  const Handle set(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid())
    return false;
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0)
    return false;
  text.resize(H5Tget_size(type.get()));
  if (H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    return false;
  text.pop_back();
  return true;
}

void File::remove(const std::string &name)
{
  const Quiet quiet;
  if (H5Ldelete(file_.get(), name.c_str(), H5P_DEFAULT) < 0)
    fail('"' + name + '"');
}

void File::close()
{
  agreed(ranks_, [this] {
    const Quiet quiet;
    if (file_.valid() && H5Fflush(file_.get(), H5F_SCOPE_LOCAL) < 0)
      fail("its contents");
    if (!file_.reset())
      fail("its contents");
    if (!failure_.empty())
      throw RunError(failure_);
  });
}
} // namespace ogive::io::hdf5
