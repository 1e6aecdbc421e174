// SPDX-License-Identifier: MIT
// A table is a struct with its columns: one writing of names, order and types for the program that
// writes, the program that reads, and, through the schema, the report.
//
//   struct TimeRow
//   {
//     static constexpr const char *file   = "times.csv";
//     static constexpr std::size_t n_keys = 2;   // the first columns name a row
//     std::string cell;
//     double strain = 0., seconds = 0.;
//
//     template <typename Column>
//     static void columns(Column &&column)
//     {
//       column("cell", &TimeRow::cell, Domain::name);
//       column("strain", &TimeRow::strain, Domain::positive);
//       column("seconds", &TimeRow::seconds, Domain::not_negative);
//     }
//   };
#pragma once

#include "verification/record/table_file.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The columns of a kind of row, in their order.
template <typename Row>
std::vector<ColumnDescription> column_descriptions()
{
  std::vector<ColumnDescription> descriptions;
  Row::columns(
    [&](const char *name, auto, const Domain domain) {
      descriptions.push_back({name, domain});
    });
  return descriptions;
}

/// A row as it stands in the file.
template <typename Row>
std::vector<std::string> fields_of_row(const Row &row)
{
  std::vector<std::string> fields;
  Row::columns([&](const char *, const auto member, const Domain)
               { fields.push_back(to_field(row.*member)); });
  return fields;
}

/// The first columns, which name a row.
template <typename Row>
std::vector<std::string> keys_of_row(const Row &row)
{
  std::vector<std::string> fields = fields_of_row(row);
  fields.resize(Row::n_keys);
  return fields;
}

/// The rows of a file.
/// @throws BadInput where a field is no value of its column
template <typename Row>
std::vector<Row> rows_of(const TableFile &file)
{
  std::vector<Row> rows;
  for (std::size_t k = 0; k < file.rows_found().size(); ++k)
  {
    const std::vector<std::string> &fields = file.rows_found()[k];
    Row &row                               = rows.emplace_back();
    std::size_t column                     = 0;
    Row::columns(
      [&](const char *, const auto member, const Domain)
      {
        if (!read_field(fields[column], row.*member))
          file.refuse(k + 2, column, fields[column], "a value of this column");
        ++column;
      });
  }
  return rows;
}

/// The rows of a table of another run, which stays as it is.
/// @throws BadInput where there is no such file, or as Table
template <typename Row>
std::vector<Row> read_table(const std::string &path)
{
  return rows_of<Row>(
    TableFile(path, column_descriptions<Row>(), Row::n_keys, TableFile::Use::read));
}

/// A CSV file that grows by rows. Every row is on the disk when append() returns.
template <typename Row>
class Table
{
public:
  /// Takes up Row::file of a folder, or begins it where there is none.
  /// @throws BadInput where the file has another header or a damaged line
  explicit Table(const std::string &folder)
      : file(folder + "/" + Row::file, column_descriptions<Row>(), Row::n_keys)
  {
    for (const Row &row : rows_of<Row>(file))
      remember(row);
  }

  /// Whether a row with the keys of this one is there; its other columns do not matter.
  bool contains(const Row &row) const
  {
    return row_of_keys.count(keys_of_row(row)) != 0;
  }

  void append(const Row &row)
  {
    file.append(fields_of_row(row));
    remember(row);
  }

  /// append() unless a row with the same keys is there.
  void append_if_missing(const Row &row)
  {
    if (!contains(row))
      append(row);
  }

  /// The row with the keys of this one, or this one where there is none.
  Row known(const Row &row) const
  {
    const auto place = row_of_keys.find(keys_of_row(row));
    return place == row_of_keys.end() ? row : all_rows[place->second];
  }

  /// append(), or in the place of the row with the same keys.
  void put(const Row &row)
  {
    if (!contains(row))
      return append(row);
    remember(row);
    write_all();
  }

  /// Drops the other rows, from the file too.
  template <typename IsKept>
  void keep(const IsKept &is_kept)
  {
    const std::vector<Row> before = std::move(all_rows);
    all_rows.clear();
    row_of_keys.clear();
    for (const Row &row : before)
      if (is_kept(row))
        remember(row);
    if (all_rows.size() < before.size())
      write_all();
  }

  /// Puts other rows in place of all.
  void replace(const std::vector<Row> &rows)
  {
    all_rows.clear();
    row_of_keys.clear();
    for (const Row &row : rows)
      remember(row);
    write_all();
  }

  /// All rows, those that were there before and those appended; of rows with the same keys, which a
  /// run that was killed may leave, the last one.
  const std::vector<Row> &rows() const
  {
    return all_rows;
  }

private:
  void remember(const Row &row)
  {
    const auto [place, is_new] = row_of_keys.emplace(keys_of_row(row), all_rows.size());
    if (is_new)
      all_rows.push_back(row);
    else
      all_rows[place->second] = row;
  }

  void write_all() const
  {
    std::vector<std::vector<std::string>> fields;
    for (const Row &row : all_rows)
      fields.push_back(fields_of_row(row));
    file.replace(fields);
  }

  const TableFile file;
  std::vector<Row> all_rows;
  std::map<std::vector<std::string>, std::size_t> row_of_keys;
};
} // namespace homespun::verification
