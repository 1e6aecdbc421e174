// SPDX-License-Identifier: MIT
#include "meshes/files/hdf5_writer.h"

#include "meshes/files/format_version.h"
#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <hdf5.h>
#include <hdf5_hl.h>

namespace homespun::meshes
{
void silence_hdf5()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

namespace
{
void require_made(const bool condition, const std::string &message)
{
  if (!condition)
    throw BadInput(message);
}

/// In HDF5's own integer, which is not the same in all of its versions.
std::vector<hsize_t> sizes_of(const Hdf5Writer::Shape &shape)
{
  return {shape.begin(), shape.end()};
}

/// Makes the groups that stand in front of a dataset in its name, where they are not there.
void make_groups(const hid_t file, const std::string &name)
{
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
  {
    const std::string group = name.substr(0, end);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0)
      continue;
    const hid_t made = H5Gcreate2(file, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    require_made(made >= 0, "group " + group + " finds no memory");
    H5Gclose(made);
  }
}
} // namespace

Hdf5Writer::Hdf5Writer(const std::string &path)
    : path(path)
{
  silence_hdf5();
  constexpr std::size_t growth = 1 << 20; // bytes that the image in memory grows by
  const hid_t in_memory        = H5Pcreate(H5P_FILE_ACCESS);
  const bool is_set            = H5Pset_fapl_core(in_memory, growth, false) >= 0;
  file = is_set ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory) : H5I_INVALID_HID;
  H5Pclose(in_memory);
  require_made(file >= 0, path + ": cannot be made in memory");
}

Hdf5Writer::~Hdf5Writer()
{
  H5Fclose(file);
}

void Hdf5Writer::write(const std::string &name, const Shape &shape, const double *values,
                       const std::string &unit)
{
  make_groups(file, name);
  require_made(H5LTmake_dataset_double(file, name.c_str(), static_cast<int>(shape.size()),
                                       sizes_of(shape).data(), values) >= 0,
               path + ": dataset " + name + " finds no memory");
  attribute(name, "unit", unit);
}

void Hdf5Writer::write(const std::string &name, const Shape &shape, const int *values)
{
  make_groups(file, name);
  require_made(H5LTmake_dataset_int(file, name.c_str(), static_cast<int>(shape.size()),
                                    sizes_of(shape).data(), values) >= 0,
               path + ": dataset " + name + " finds no memory");
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name,
                           const std::string &value)
{
  require_made(H5LTset_attribute_string(file, object.c_str(), name.c_str(), value.c_str()) >= 0,
               path + ": attribute " + name + " of " + object + " finds no memory");
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name, const int value)
{
  require_made(H5LTset_attribute_int(file, object.c_str(), name.c_str(), &value, 1) >= 0,
               path + ": attribute " + name + " of " + object + " finds no memory");
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name, const double value)
{
  require_made(H5LTset_attribute_double(file, object.c_str(), name.c_str(), &value, 1) >= 0,
               path + ": attribute " + name + " of " + object + " finds no memory");
}

void Hdf5Writer::finish()
{
  attribute("/", "format_version", format_version);
  const ssize_t size =
    H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0 ? H5Fget_file_image(file, nullptr, 0) : -1;
  std::string bytes(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  require_made(size > 0 && H5Fget_file_image(file, bytes.data(), bytes.size()) == size,
               path + ": its image finds no memory");
  write_whole(path, bytes);
}
} // namespace homespun::meshes
