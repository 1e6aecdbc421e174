// SPDX-License-Identifier: MIT
#include "meshes/files/hdf5_reader.h"

#include "meshes/files/format_version.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/errors.h"

#include <hdf5.h>

#include <filesystem>
#include <memory>
#include <sstream>

namespace homespun::meshes
{
namespace
{
void require(const bool condition, const std::string &message)
{
  if (!condition)
    throw BadInput(message);
}

/// An identifier of HDF5 that is closed at the end; negative where there is nothing.
class Handle
{
public:
  Handle(const hid_t id, herr_t (*close)(hid_t))
      : id(id)
      , close(close)
  {
  }
  Handle(const Handle &)            = delete;
  Handle &operator=(const Handle &) = delete;
  ~Handle()
  {
    if (id >= 0)
      close(id);
  }

  const hid_t id;

private:
  herr_t (*const close)(hid_t);
};

std::string text_of(const Hdf5Reader::Shape &shape)
{
  std::ostringstream text;
  text << '(';
  for (std::size_t k = 0; k < shape.size(); ++k)
  {
    text << (k > 0 ? "," : "");
    if (shape[k] == Hdf5Reader::any)
      text << "any";
    else
      text << shape[k];
  }
  text << ')';
  return text.str();
}

/// How many numbers; the largest there is where the product does not fit.
unsigned long long size_of(const Hdf5Reader::Shape &shape)
{
  unsigned long long size = 1;
  for (const unsigned long long n : shape)
    if (__builtin_mul_overflow(size, n, &size))
      return Hdf5Reader::any;
  return size;
}

/// A compressed file may hold this many numbers per byte; a file that says more is damaged, or
/// meant to exhaust memory.
constexpr double numbers_per_byte = 200.;
} // namespace

Hdf5Reader::Hdf5Reader(const std::string &path, const std::string &expected)
    : path(path)
{
  silence_hdf5();
  require(std::filesystem::is_regular_file(path), path + ": no such file; expected " + expected);
  file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  require(file >= 0, path +
                       ": is not a readable HDF5 file (truncated, or of another kind); expected " +
                       expected);
  if (const std::string fault = fault_of_version(); !fault.empty())
  {
    H5Fclose(file);
    throw BadInput(fault);
  }
}

std::string Hdf5Reader::fault_of_version() const
{
  if (H5Aexists_by_name(file, "/", "format_version", H5P_DEFAULT) <= 0)
    return "";
  const std::optional<int> found = integer_attribute("/", "format_version");
  return found ? fault_of_format(path, *found) : fault_of_format(path, "that is no single number");
}

Hdf5Reader::~Hdf5Reader()
{
  H5Fclose(file);
}

bool Hdf5Reader::is_hard_link(const std::string &name) const
{
  if (name == "/")
    return true;
  // The groups in front of it too: one of another file would bring in what it holds.
  const std::size_t last = name.rfind('/');
  if (last != std::string::npos && last > 0 && !is_hard_link(name.substr(0, last)))
    return false;
  H5L_info_t link;
  return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0 &&
         H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
}

/// Whether the data of a dataset lies in this file.
bool Hdf5Reader::is_here(const std::int64_t dataset) const
{
  const Handle properties(H5Dget_create_plist(dataset), H5Pclose);
  return properties.id >= 0 && H5Pget_external_count(properties.id) == 0 &&
         H5Pget_layout(properties.id) != H5D_VIRTUAL;
}

bool Hdf5Reader::has(const std::string &name) const
{
  return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5Reader::Shape Hdf5Reader::shape_of(const std::string &name, const Shape &expected) const
{
  const Handle dataset(is_hard_link(name) ? H5Dopen2(file, name.c_str(), H5P_DEFAULT) : -1,
                       H5Dclose);
  require(dataset.id >= 0, path + ": dataset " + name +
                             " is missing; expected a file written by homespun: make it again");
  require(is_here(dataset.id), path + ": dataset " + name +
                                 " takes its data from another file; expected it in this one");
  const Handle type(H5Dget_type(dataset.id), H5Tclose);
  const H5T_class_t kind = type.id >= 0 ? H5Tget_class(type.id) : H5T_NO_CLASS;
  require(kind == H5T_FLOAT || kind == H5T_INTEGER,
          path + ": dataset " + name + " does not hold numbers; expected numbers");
  const Handle space(H5Dget_space(dataset.id), H5Sclose);
  const int rank = space.id >= 0 ? H5Sget_simple_extent_ndims(space.id) : -1;
  require(rank >= 0 && rank <= H5S_MAX_RANK, path + ": dataset " + name + " has no shape");
  std::vector<hsize_t> found(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id, found.data(), nullptr);
  const Shape shape(found.begin(), found.end());
  bool fits = shape.size() == expected.size();
  for (std::size_t k = 0; fits && k < shape.size(); ++k)
    fits = expected[k] == any || expected[k] == shape[k];
  require(fits, path + ": dataset " + name + " has shape " + text_of(shape) + "; expected " +
                  text_of(expected));
  const double bytes = static_cast<double>(std::filesystem::file_size(path));
  require(static_cast<double>(size_of(shape)) <= numbers_per_byte * bytes,
          path + ": dataset " + name + " says that it has shape " + text_of(shape) +
            ", in a file of " + std::to_string(std::filesystem::file_size(path)) +
            " bytes: the file is damaged, write it again");
  return shape;
}

template <typename Number>
std::vector<Number> Hdf5Reader::read(const std::string &name, const Shape &shape,
                                     const std::int64_t type) const
{
  std::vector<Number> values(static_cast<std::size_t>(size_of(shape_of(name, shape))));
  const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  require(values.empty() ||
            H5Dread(dataset.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
          path + ": dataset " + name + " cannot be read: the file is damaged, write it again");
  return values;
}

std::vector<double> Hdf5Reader::numbers(const std::string &name, const Shape &shape) const
{
  return read<double>(name, shape, H5T_NATIVE_DOUBLE);
}

std::vector<int> Hdf5Reader::integers(const std::string &name, const Shape &shape) const
{
  return read<int>(name, shape, H5T_NATIVE_INT);
}

template <typename Number>
std::optional<Number> Hdf5Reader::attribute(const std::string &object, const std::string &name,
                                            const std::int64_t type) const
{
  if (!is_hard_link(object))
    return std::nullopt;
  const Handle one(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  const Handle its_type(one.id >= 0 ? H5Aget_type(one.id) : -1, H5Tclose),
    space(one.id >= 0 ? H5Aget_space(one.id) : -1, H5Sclose);
  if (its_type.id < 0 || space.id < 0 || H5Sget_simple_extent_npoints(space.id) != 1)
    return std::nullopt;
  const H5T_class_t kind = H5Tget_class(its_type.id);
  Number value;
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Aread(one.id, type, &value) < 0)
    return std::nullopt;
  return value;
}

std::optional<int> Hdf5Reader::integer_attribute(const std::string &object,
                                                 const std::string &name) const
{
  return attribute<int>(object, name, H5T_NATIVE_INT);
}

std::optional<double> Hdf5Reader::number_attribute(const std::string &object,
                                                   const std::string &name) const
{
  return attribute<double>(object, name, H5T_NATIVE_DOUBLE);
}

std::optional<std::string> Hdf5Reader::text_attribute(const std::string &object,
                                                      const std::string &name) const
{
  if (!is_hard_link(object))
    return std::nullopt;
  const Handle one(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  const Handle type(one.id >= 0 ? H5Aget_type(one.id) : -1, H5Tclose),
    space(one.id >= 0 ? H5Aget_space(one.id) : -1, H5Sclose);
  if (type.id < 0 || space.id < 0 || H5Tget_class(type.id) != H5T_STRING ||
      H5Tis_variable_str(type.id) != 0 || H5Sget_simple_extent_npoints(space.id) != 1)
    return std::nullopt;
  std::string text(H5Tget_size(type.id), '\0');
  if (H5Aread(one.id, type.id, text.data()) < 0)
    return std::nullopt;
  return text.substr(0, text.find('\0'));
}
} // namespace homespun::meshes
