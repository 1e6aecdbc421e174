// SPDX-License-Identifier: MIT
#include "verification/periodic/measured_curve.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace homespun::verification
{
namespace
{
/// A column that is taken over, and where it goes.
struct TakenColumn
{
  std::string name;
  double LoadRow::*member;
};

/// Strain and stress of each component, one after the other.
const std::array<TakenColumn, 6> taken = {{{"strain_11", &LoadRow::strain_11},
                                           {"stress_11_N_per_m", &LoadRow::stress_11},
                                           {"strain_22", &LoadRow::strain_22},
                                           {"stress_22_N_per_m", &LoadRow::stress_22},
                                           {"strain_12", &LoadRow::strain_12},
                                           {"stress_12_N_per_m", &LoadRow::stress_12}}};

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

std::vector<LoadRow> read_measured_curve(const std::string &file)
{
  std::ifstream input(file);
  bool is_there            = false;
  const std::string header = read_line(input, is_there);
  if (!is_there)
    throw meshes::BadInput(file +
                           ": cannot be read, or is empty; expected a CSV file with a header");
  std::vector<const TakenColumn *> of_field;
  for (const std::string &name : fields_of(header))
  {
    const auto column =
      std::find_if(taken.begin(), taken.end(),
                   [&](const TakenColumn &one) { return one.name == without_blanks(name); });
    of_field.push_back(column == taken.end() ? nullptr : &*column);
    if (of_field.back() && std::count(of_field.begin(), of_field.end(), of_field.back()) > 1)
      throw meshes::BadInput(file + ": has the column `" + column->name +
                             "` twice; expected it once");
  }
  const auto has = [&](const TakenColumn &column)
  { return std::count(of_field.begin(), of_field.end(), &column) > 0; };
  bool has_pair = false;
  for (std::size_t k = 0; k < taken.size(); k += 2)
    has_pair = has_pair || (has(taken[k]) && has(taken[k + 1]));
  if (!has_pair)
    throw meshes::BadInput(file + ": found the columns `" + header +
                           "`; expected strain and stress of one component at least, like "
                           "strain_11,stress_11_N_per_m");
  std::vector<LoadRow> rows;
  std::vector<std::string> faults;
  int line = 1;
  for (std::string text = read_line(input, is_there); is_there; text = read_line(input, is_there))
  {
    ++line;
    if (without_blanks(text).empty())
      continue;
    const std::vector<std::string> fields = fields_of(text);
    LoadRow row{std::filesystem::path(file).stem().string(), "measured", "measured",
                static_cast<int>(rows.size()) + 1};
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
