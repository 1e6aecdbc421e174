// SPDX-License-Identifier: MIT
#include "verification/record/table_file.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include <unistd.h>

namespace homespun::verification
{
namespace
{
std::string joined(const std::vector<std::string> &fields)
{
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k)
    line += (k == 0 ? "" : ",") + fields[k];
  return line + "\n";
}

/// Appends a text and waits until it is on the disk.
void append_text(const std::string &path, const std::string &text)
{
  std::FILE *file = std::fopen(path.c_str(), "a");
  if (file == nullptr)
    throw meshes::BadInput(path +
                           ": cannot be written; expected a folder that exists and is writable");
  const bool good = std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                    std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !good)
    throw meshes::BadInput(path + ": cannot be written: is the disk full?");
}
} // namespace

TableFile::TableFile(std::string path_of_file, std::vector<ColumnDescription> descriptions,
                     const std::size_t n_keys, const Use use)
    : path(std::move(path_of_file))
    , columns(std::move(descriptions))
    , n_keys(n_keys)
{
  if (!std::filesystem::exists(path))
  {
    if (use == Use::read)
      throw meshes::BadInput(path + ": no such file; expected the table of a run");
    replace({});
    return;
  }
  std::ifstream input(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  const std::size_t end = text.rfind('\n');
  const bool was_cut    = end == std::string::npos || end + 1 != text.size();
  text.resize(end == std::string::npos ? 0 : end + 1);

  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line + "\n" != header())
  {
    const std::string expected = header();
    throw meshes::BadInput(path + ":1: found the header `" + line + "`; expected `" +
                           expected.substr(0, expected.size() - 1) + "`: " +
                           (use == Use::read
                              ? "another version of homespun wrote it: run the study again"
                              : "begin anew with --overwrite, or choose another --output"));
  }
  for (std::size_t number = 2; std::getline(lines, line); ++number)
  {
    std::vector<std::string> fields = fields_of(line);
    if (fields.size() != columns.size())
      throw meshes::BadInput(path + ":" + std::to_string(number) + ": found " +
                             std::to_string(fields.size()) + " fields; expected " +
                             std::to_string(columns.size()) + ": delete that line");
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (const std::string expected = fault_of(fields[k], columns[k].domain); !expected.empty())
        refuse(number, k, fields[k], expected);
    found.push_back(std::move(fields));
  }
  if (was_cut && use == Use::take_up)
    meshes::write_whole(path, text);
}

void TableFile::refuse(const std::size_t line, const std::size_t column,
                       const std::string &found_text, const std::string &expected) const
{
  throw meshes::BadInput(path + ":" + std::to_string(line) + ": column `" + columns[column].name +
                         "`: found `" + found_text + "`; expected " + expected +
                         ": delete that line, its row is computed again");
}

void TableFile::append(const std::vector<std::string> &fields) const
{
  append_text(path, joined(fields));
}

void TableFile::replace(const std::vector<std::vector<std::string>> &rows) const
{
  std::string text = header();
  for (const std::vector<std::string> &row : rows)
    text += joined(row);
  meshes::write_whole(path, text);
}

std::string TableFile::header() const
{
  std::vector<std::string> names;
  for (const ColumnDescription &column : columns)
    names.push_back(column.name);
  return joined(names);
}
} // namespace homespun::verification
