// SPDX-License-Identifier: MIT
#include "verification/load/measured_curve.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace homespun::verification
{
namespace
{
/// The columns that are taken over, and where they go.
struct TakenColumn
{
  std::string name;
  double MeasuredRow::*member;
};

std::vector<TakenColumn> taken_columns()
{
  std::vector<TakenColumn> taken;
  MeasuredRow::columns(
    [&](const char *name, const auto member, const Domain)
    {
      if constexpr (std::is_same_v<decltype(member), double MeasuredRow::*const>)
        taken.push_back({name, member});
    });
  return taken;
}

std::string read_line(std::ifstream &input, bool &is_there)
{
  std::string line;
  is_there = static_cast<bool>(std::getline(input, line));
  if (line.rfind("\xef\xbb\xbf", 0) == 0)
    line.erase(0, 3); // a byte order mark
  if (!line.empty() && line.back() == '\r')
    line.pop_back();
  return line;
}

std::string without_blanks(std::string text)
{
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}
} // namespace

std::vector<MeasuredRow> read_measured_curve(const std::string &file)
{
  std::ifstream input(file);
  bool is_there            = false;
  const std::string header = read_line(input, is_there);
  if (!is_there)
    throw meshes::BadInput(file +
                           ": cannot be read, or is empty; expected a CSV file with a header");
  const std::vector<TakenColumn> taken = taken_columns();
  std::vector<const TakenColumn *> of_field;
  std::vector<std::string> found;
  for (const std::string &name : fields_of(header))
  {
    const auto column =
      std::find_if(taken.begin(), taken.end(),
                   [&](const TakenColumn &one) { return one.name == without_blanks(name); });
    of_field.push_back(column == taken.end() ? nullptr : &*column);
    if (column == taken.end())
      continue;
    if (std::find(found.begin(), found.end(), column->name) != found.end())
      throw meshes::BadInput(file + ": has the column `" + column->name +
                             "` twice; expected it once");
    found.push_back(column->name);
  }
  const auto has = [&](const std::string &name)
  { return std::find(found.begin(), found.end(), name) != found.end(); };
  bool has_pair = false;
  for (const std::string component : {"11", "22", "12"})
    has_pair = has_pair || (has("strain_" + component) && has("stress_" + component + "_N_per_m"));
  if (!has_pair)
    throw meshes::BadInput(file + ": found the columns `" + header +
                           "`; expected strain and stress of one component at least, like "
                           "strain_11,stress_11_N_per_m");
  std::vector<MeasuredRow> rows;
  std::vector<std::string> faults;
  int line = 1;
  for (std::string text = read_line(input, is_there); is_there; text = read_line(input, is_there))
  {
    ++line;
    if (without_blanks(text).empty())
      continue;
    const std::vector<std::string> fields = fields_of(text);
    MeasuredRow row;
    row.curve = std::filesystem::path(file).stem().string();
    row.point = static_cast<int>(rows.size()) + 1;
    if (fields.size() != of_field.size())
      faults.push_back(file + ", line " + std::to_string(line) + ": found " +
                       std::to_string(fields.size()) + " fields; expected " +
                       std::to_string(of_field.size()) + " as in the header");
    else
      for (std::size_t k = 0; k < fields.size(); ++k)
        if (double value = 0.; of_field[k])
        {
          const std::string field = without_blanks(fields[k]);
          if (!read_field(field, value) || (!field.empty() && !std::isfinite(value)))
            faults.push_back(file + ", line " + std::to_string(line) + ", column " +
                             of_field[k]->name + ": found `" + field +
                             "`; expected a number with a decimal point, or nothing");
          row.*(of_field[k]->member) = value;
        }
    rows.push_back(row);
  }
  if (rows.empty())
    faults.push_back(file + ": found no line below the header; expected a point at least");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return rows;
}
} // namespace homespun::verification
