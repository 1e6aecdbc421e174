// SPDX-License-Identifier: MIT
// An HDF5 file that appears whole or not at all. It is made in memory and written as bytes: the
// library itself never writes to a disk, because where that is full it leaves a file that it cannot
// close, and MPI_Finalize, which closes the library, ends in a segmentation fault.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// Collects datasets and attributes; finish() writes them, otherwise nothing is left.
class Hdf5Writer
{
public:
  /// @throws BadInput where there is no memory
  explicit Hdf5Writer(const std::string &path);
  Hdf5Writer(const Hdf5Writer &)            = delete;
  Hdf5Writer &operator=(const Hdf5Writer &) = delete;
  ~Hdf5Writer();

  using Shape = std::vector<unsigned long long>;

  /// @param name of the dataset; groups in it are made where they are not there
  /// @param values row-major, as many as the shape says
  /// @param unit stored as the attribute `unit` of the dataset
  void write(const std::string &name, const Shape &shape, const double *values,
             const std::string &unit);
  void write(const std::string &name, const Shape &shape, const int *values);

  /// @param object "/" for the file itself, or a dataset
  void attribute(const std::string &object, const std::string &name, const std::string &value);
  void attribute(const std::string &object, const std::string &name, int value);
  void attribute(const std::string &object, const std::string &name, double value);

  /// Writes the file, with the attribute `format_version` (format_version.h).
  /// @throws BadInput where the folder is absent or not writable, or the disk is full
  void finish();

private:
  const std::string path;
  std::int64_t file; ///< HDF5's hid_t
};

/// Stops the HDF5 library from printing its own errors; ours are thrown.
void silence_hdf5();
} // namespace homespun::meshes
