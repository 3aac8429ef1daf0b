// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/hdf5_file.h"

#include "core/base/error.h"

#include <array>

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

void File::fail(const std::string &what) const
{
  throw RunError(path_ + ": cannot write " + what + "; is the disk full?");
}

void File::write_raw(const std::string &name, hid_t file_type, hid_t memory_type,
                     std::span<const hsize_t> shape, const void *data)
{
  const Quiet  quiet;
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), 0);
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle set(H5Dcreate2(file_.get(), name.c_str(), file_type, space.get(), links.get(), creation.get(),
                              H5P_DEFAULT),
                   H5Dclose);
  if (!set.valid() || H5Dwrite(set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fail('"' + name + '"');
}

void File::write(const std::string &name, std::span<const double> values, std::size_t columns,
                 bool single_precision)
{
  require(columns > 0 && values.size() % columns == 0, "values do not fill whole rows");
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  write_raw(name, single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
            std::span(shape).first(columns == 1 ? 1 : 2), values.data());
}

void File::write(const std::string &name, std::span<const std::int64_t> values)
{
  const std::array<hsize_t, 1> shape{values.size()};
  write_raw(name, H5T_STD_I64LE, H5T_NATIVE_INT64, shape, values.data());
}

void File::write(const std::string &name, std::span<const std::uint32_t> values, std::size_t columns)
{
  require(columns > 0 && values.size() % columns == 0, "values do not fill whole rows");
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  write_raw(name, H5T_STD_U32LE, H5T_NATIVE_UINT32, std::span(shape).first(columns == 1 ? 1 : 2),
            values.data());
}

void File::write_text(const std::string &name, const std::string &text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // One byte more than the text: a string type cannot be empty.
  H5Tset_size(type.get(), text.size() + 1);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  write_raw(name, type.get(), type.get(), {}, text.c_str());
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
  const Quiet quiet;
  if (file_.valid() && H5Fflush(file_.get(), H5F_SCOPE_LOCAL) < 0)
    fail("its contents");
  if (!file_.reset())
    fail("its contents");
}
} // namespace ogive::io::hdf5
