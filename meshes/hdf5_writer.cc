// SPDX-License-Identifier: MIT
#include "meshes/hdf5_writer.h"

#include "meshes/errors.h"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdio>
#include <filesystem>

namespace homespun::meshes
{
void silence_hdf5()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

namespace
{
void require(const bool condition, const std::string &message)
{
  if (!condition)
    throw BadInput(message);
}
} // namespace

Hdf5Writer::Hdf5Writer(const std::string &path)
    : path(path)
    , temporary(path + ".part")
{
  silence_hdf5();
  file = H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  require(file >= 0, path + ": cannot be written; expected a folder that exists and is writable");
}

Hdf5Writer::~Hdf5Writer()
{
  if (file < 0)
    return;
  H5Fclose(file);
  std::remove(temporary.c_str());
}

void Hdf5Writer::write(const std::string &name, const Shape &shape, const double *values,
                       const std::string &unit)
{
  require(H5LTmake_dataset_double(file, name.c_str(), static_cast<int>(shape.size()), shape.data(),
                                  values) >= 0,
          path + ": cannot write dataset " + name + ": is the disk full?");
  attribute(name, "unit", unit);
}

void Hdf5Writer::write(const std::string &name, const Shape &shape, const int *values)
{
  require(H5LTmake_dataset_int(file, name.c_str(), static_cast<int>(shape.size()), shape.data(),
                               values) >= 0,
          path + ": cannot write dataset " + name + ": is the disk full?");
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name,
                           const std::string &value)
{
  require(H5LTset_attribute_string(file, object.c_str(), name.c_str(), value.c_str()) >= 0,
          path + ": cannot write attribute " + name + " of " + object);
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name, const int value)
{
  require(H5LTset_attribute_int(file, object.c_str(), name.c_str(), &value, 1) >= 0,
          path + ": cannot write attribute " + name + " of " + object);
}

void Hdf5Writer::attribute(const std::string &object, const std::string &name, const double value)
{
  require(H5LTset_attribute_double(file, object.c_str(), name.c_str(), &value, 1) >= 0,
          path + ": cannot write attribute " + name + " of " + object);
}

void Hdf5Writer::finish()
{
  const bool flushed = H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0 && H5Fclose(file) >= 0;
  file               = -1;
  if (!flushed)
    std::remove(temporary.c_str());
  require(flushed, path + ": cannot be written: is the disk full?");
  std::filesystem::rename(temporary, path);
}
} // namespace homespun::meshes
