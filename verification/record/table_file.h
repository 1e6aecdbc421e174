// SPDX-License-Identifier: MIT
// How tables reach the disk: row by row. A table survives a kill with all rows but the one in
// progress, and is taken up again.
#pragma once

#include "verification/record/fields.h"

#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A column as the schema has it.
struct ColumnDescription
{
  std::string name;
  Domain domain = Domain::text;
};

/// A CSV file as text: what is common to tables of all kinds of rows.
class TableFile
{
public:
  enum class Use
  {
    take_up, ///< rows are added
    read     ///< nothing is written
  };

  /// Takes up a file, or begins one where there is none. A last line that was cut is dropped.
  /// @param columns of which the first `n_keys` name a row
  /// @throws BadInput where the file has another header, or a line that no run wrote: the file, the
  ///   line, the column, what was found and what was expected; or is to be read and is not there
  TableFile(std::string path, std::vector<ColumnDescription> columns, std::size_t n_keys,
            Use use = Use::take_up);

  /// The rows that were there, as fields without quotes.
  const std::vector<std::vector<std::string>> &rows_found() const
  {
    return found;
  }

  /// Adds a row; it is on the disk when this returns.
  /// @param fields as they stand in the file
  /// @throws BadInput where it cannot be written
  void append(const std::vector<std::string> &fields) const;

  /// Writes the file anew, whole.
  void replace(const std::vector<std::vector<std::string>> &rows) const;

  /// A fault of a field of line `line` (the header is 1).
  [[noreturn]] void refuse(std::size_t line, std::size_t column, const std::string &found_text,
                           const std::string &expected) const;

  const std::string path;
  const std::vector<ColumnDescription> columns;
  const std::size_t n_keys;

private:
  std::string header() const;

  std::vector<std::vector<std::string>> found;
};
} // namespace homespun::verification
