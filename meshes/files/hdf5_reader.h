// SPDX-License-Identifier: MIT
// An HDF5 file that somebody else may have made. Sizes are compared before anything is read into
// memory, and no data comes from another file: links to others, virtual datasets and data kept
// outside are refused.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace homespun::meshes
{
class Hdf5Reader
{
public:
  /// @throws BadInput where it is no readable HDF5 file, or its `format_version` is not known here
  /// @param expected what the reader hoped for, to end the message with
  Hdf5Reader(const std::string &path, const std::string &expected);
  Hdf5Reader(const Hdf5Reader &)            = delete;
  Hdf5Reader &operator=(const Hdf5Reader &) = delete;
  ~Hdf5Reader();

  using Shape = std::vector<unsigned long long>;

  /// A size that read() takes as it finds it.
  static constexpr unsigned long long any = ~0ull;

  /// Whether there is a link of this name, of whatever kind.
  bool has(const std::string &name) const;

  /// The shape of a dataset of numbers.
  /// @param expected one entry per axis
  /// @throws BadInput where it is missing, lies in another file, does not hold numbers, has another
  ///   shape, or more numbers than a file of this size can hold
  Shape shape_of(const std::string &name, const Shape &expected) const;

  /// Reads a dataset of exactly this shape, row-major.
  /// @throws BadInput as shape_of() does, and where the data is damaged
  std::vector<double> numbers(const std::string &name, const Shape &shape) const;
  std::vector<int> integers(const std::string &name, const Shape &shape) const;

  /// A single number or text; nothing where there is none of this kind.
  /// @param object "/" for the file itself, or a dataset
  std::optional<int> integer_attribute(const std::string &object, const std::string &name) const;
  std::optional<double> number_attribute(const std::string &object, const std::string &name) const;
  std::optional<std::string> text_attribute(const std::string &object,
                                            const std::string &name) const;

private:
  std::string fault_of_version() const;
  bool is_hard_link(const std::string &name) const;
  bool is_here(std::int64_t dataset) const;
  template <typename Number>
  std::vector<Number> read(const std::string &name, const Shape &shape, std::int64_t type) const;
  template <typename Number>
  std::optional<Number> attribute(const std::string &object, const std::string &name,
                                  std::int64_t type) const;

  const std::string path;
  std::int64_t file; ///< HDF5's hid_t
};
} // namespace homespun::meshes
