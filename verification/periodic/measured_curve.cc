// SPDX-License-Identifier: MIT
#include "verification/periodic/measured_curve.h"

#include "meshes/plain/errors.h"
#include "verification/record/given_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

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

} // namespace

std::vector<LoadRow> read_measured_curve(const std::string &file)
{
  const GivenTable table = read_given_table(file);
  std::vector<const TakenColumn *> of_field;
  for (const std::string &name : table.columns)
  {
    const auto column = std::find_if(taken.begin(), taken.end(),
                                     [&](const TakenColumn &one) { return one.name == name; });
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
    throw meshes::BadInput(file + ": found the columns " + meshes::one_of(table.columns) +
                           "; expected strain and stress of one component at least, like "
                           "strain_11,stress_11_N_per_m");
  std::vector<LoadRow> rows;
  std::vector<std::string> faults;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
  {
    LoadRow &row = rows.emplace_back();
    row          = {std::filesystem::path(file).stem().string(), "measured", "measured",
                    static_cast<int>(rows.size())};
    for (std::size_t k = 0; k < of_field.size(); ++k)
      if (double value = 0.; of_field[k])
      {
        const std::string &field = table.rows[r][k];
        if (!read_field(field, value) || (!field.empty() && !std::isfinite(value)))
          faults.push_back(table.places[r] + ", column " + of_field[k]->name + ": found `" + field +
                           "`; expected a number with a decimal point, or nothing");
        row.*(of_field[k]->member) = value;
      }
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return rows;
}
} // namespace homespun::verification
