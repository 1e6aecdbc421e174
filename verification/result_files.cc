// SPDX-License-Identifier: MIT
#include "verification/result_files.h"

#include "meshes/errors.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

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
  return line;
}

std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

/// Appends a line and waits until it is on the disk.
void append_line(const std::string &path, const std::string &line)
{
  std::FILE *file = std::fopen(path.c_str(), "a");
  if (file == nullptr)
    throw meshes::BadInput(path +
                           ": cannot be written; expected a folder that exists and is writable");
  const std::string text = line + "\n";
  const bool good        = std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                    std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !good)
    throw meshes::BadInput(path + ": cannot be written: is the disk full?");
}
} // namespace

std::string csv_number(const double value)
{
  if (!std::isfinite(value))
    return "";
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

double csv_value(const std::string &field)
{
  char *end          = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  return field.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

ResultTable::ResultTable(const std::string &path, const std::vector<std::string> &columns,
                         const std::size_t n_keys, const bool resume)
    : path(path)
    , header(joined(columns))
    , n_keys(n_keys)
{
  if (!resume || !std::filesystem::exists(path))
  {
    write_whole(path, joined(columns) + "\n");
    return;
  }
  std::ifstream input(path);
  std::stringstream content;
  content << input.rdbuf();
  std::string text      = content.str();
  const std::size_t end = text.rfind('\n');
  const bool was_cut    = end == std::string::npos || end + 1 != text.size();
  text.resize(end == std::string::npos ? 0 : end + 1);

  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != joined(columns))
    throw meshes::BadInput(path + ":1: found the header `" + line + "`; expected `" +
                           joined(columns) + "`: choose another --output, or leave out --resume");
  for (int number = 2; std::getline(lines, line); ++number)
  {
    std::vector<std::string> fields = fields_of(line);
    if (fields.size() != columns.size())
      throw meshes::BadInput(path + ":" + std::to_string(number) + ": found " +
                             std::to_string(fields.size()) + " fields; expected " +
                             std::to_string(columns.size()) + ": delete that line");
    row_of_keys[{fields.begin(), fields.begin() + static_cast<long>(n_keys)}] = all_rows.size();
    all_rows.push_back(std::move(fields));
  }
  if (was_cut)
    write_whole(path, text);
}

bool ResultTable::contains(const std::vector<std::string> &keys) const
{
  return row_of_keys.count(keys) != 0;
}

void ResultTable::append(const std::vector<std::string> &fields)
{
  append_line(path, joined(fields));
  row_of_keys[{fields.begin(), fields.begin() + static_cast<long>(n_keys)}] = all_rows.size();
  all_rows.push_back(fields);
}

void ResultTable::keep(const std::function<bool(const std::vector<std::string> &row)> &is_kept)
{
  std::vector<std::vector<std::string>> kept;
  std::string text = header + "\n";
  row_of_keys.clear();
  for (const std::vector<std::string> &row : all_rows)
    if (is_kept(row))
    {
      row_of_keys[{row.begin(), row.begin() + static_cast<long>(n_keys)}] = kept.size();
      kept.push_back(row);
      text += joined(row) + "\n";
    }
  if (kept.size() < all_rows.size())
    write_whole(path, text);
  all_rows = std::move(kept);
}
} // namespace homespun::verification
