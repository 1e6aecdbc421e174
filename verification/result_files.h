// SPDX-License-Identifier: MIT
// How tables reach the disk: row by row. A table survives a kill with all rows but the one in
// progress, and is taken up again.
#pragma once

#include "meshes/write_whole.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
using meshes::write_whole;

/// A number as results print it: six digits, "nan" never; an empty field where it is not finite.
std::string csv_number(double value);

/// What csv_number() wrote; not a number, so that no claim on it holds, where the field is empty or damaged.
double csv_value(const std::string &field);

/// A CSV file that grows by rows. Every row is on the disk when append() returns.
class ResultTable
{
public:
  /// Takes up a file, or begins a new one.
  /// @param n_keys the first columns name a row
  /// @param resume false: an existing file is begun anew; true: its whole rows are kept, a last line
  ///   that was cut is dropped
  /// @throws BadInput where the file has another header
  ResultTable(const std::string &path, const std::vector<std::string> &columns, std::size_t n_keys,
              bool resume);

  /// Whether a row with these keys is there.
  bool contains(const std::vector<std::string> &keys) const;

  void append(const std::vector<std::string> &fields);

  /// Drops the other rows, from the file too.
  void keep(const std::function<bool(const std::vector<std::string> &row)> &is_kept);

  /// All rows, those that were there before and those appended.
  const std::vector<std::vector<std::string>> &rows() const
  {
    return all_rows;
  }

private:
  const std::string path, header;
  const std::size_t n_keys;
  std::vector<std::vector<std::string>> all_rows;
  std::map<std::vector<std::string>, std::size_t> row_of_keys;
};
} // namespace homespun::verification
