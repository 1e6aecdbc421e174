// SPDX-License-Identifier: MIT
#include "verification/strain_output.h"

#include "verification/budget_rows.h"
#include "verification/lightweight_cloth.h"
#include "verification/reference_uncertainty.h"
#include "verification/run_time.h"
#include "verification/validity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
const std::vector<std::string> &strain_columns()
{
  static const std::vector<std::string> columns = {"cell",
                                                   "load",
                                                   "strain",
                                                   "reference",
                                                   "method",
                                                   "cells",
                                                   "coarse_triangles",
                                                   "fine_triangles",
                                                   "error_mean_m",
                                                   "error_rms_m",
                                                   "error_max_m",
                                                   "error_mean_per_cell",
                                                   "error_mean_per_fluctuation",
                                                   "reference_uncertainty_m",
                                                   "seconds_method",
                                                   "seconds_reference"};
  return columns;
}

namespace
{
const std::vector<std::string> step_columns = {"cell",
                                               "load",
                                               "reference",
                                               "strain",
                                               "seconds_coarse_solve",
                                               "seconds_upsample",
                                               "seconds_fine_step",
                                               "coarse_iterations",
                                               "fine_iterations",
                                               "fine_dofs",
                                               "ranks"};

std::unique_ptr<ResultTable> table(const StrainStudyOptions &options, const char *name,
                                   const std::vector<std::string> &columns,
                                   const std::size_t n_keys)
{
  return std::make_unique<ResultTable>(options.output + "/" + name, columns, n_keys,
                                       options.resume);
}

std::vector<std::string> error_keys(const StrainLevel &level, const std::string &method)
{
  return {level.cell, level.load, csv_number(level.strain), name_of(level.law), method};
}

/// Of notes and steps.
std::vector<std::string> level_keys(const StrainLevel &level)
{
  return {level.cell, level.load, name_of(level.law), csv_number(level.strain)};
}
} // namespace

StrainOutput::StrainOutput(const StrainStudyOptions &options)
    : uncertainty(table(options, "uncertainty.csv", uncertainty_columns(), 5))
    , budget(options.budget ? table(options, "budget.csv", budget_columns(), 6) : nullptr)
    , run_time(options.run_time ? table(options, "runtime.csv", run_time_columns(), 5) : nullptr)
    , folder(options.output)
    , methods(options.methods)
    , strain(table(options, "strain.csv", strain_columns(), 5))
    , steps(table(options, "steps.csv", step_columns, 4))
    , note_table(table(options, "notes.csv", {"cell", "load", "reference", "strain", "note"}, 5))
{
}

bool StrainOutput::is_complete(const StrainLevel &level) const
{
  return is_unreached(level) || std::all_of(methods.begin(), methods.end(),
                                            [&](const std::string &method) {
                                              return !Method(method).has_meaning(level.law) ||
                                                     has_errors(level, method);
                                            });
}

bool StrainOutput::has_errors(const StrainLevel &level, const std::string &method) const
{
  return strain->contains(error_keys(level, method));
}

bool StrainOutput::is_unreached(const StrainLevel &level) const
{
  return has_errors(level, "unreached");
}

void StrainOutput::write_errors(const StrainLevel &level, const std::string &method,
                                const meshes::Sheet &sheet, const int n_coarse_triangles,
                                const StrainErrors &errors)
{
  const Eigen::VectorXd &distance = errors.distance;
  std::vector<std::string> row    = error_keys(level, method);
  for (const std::string &field :
       {std::to_string(sheet.n1), std::to_string(n_coarse_triangles),
        std::to_string(sheet.mesh.n_triangles()), csv_number(distance.mean()),
        csv_number(std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size()))),
        csv_number(distance.maxCoeff()), csv_number(distance.mean() / errors.side),
        csv_number(errors.fluctuation > 0. ? distance.mean() / errors.fluctuation
                                           : std::numeric_limits<double>::quiet_NaN()),
        csv_number(errors.uncertainty), csv_number(errors.seconds),
        csv_number(errors.seconds_reference)})
    row.push_back(field);
  strain->append(row);
}

void StrainOutput::write_step(const StrainLevel &level, const StrainStep &step)
{
  std::vector<std::string> row = level_keys(level);
  if (steps->contains(row))
    return;
  for (const std::string &field :
       {csv_number(step.seconds_coarse), csv_number(step.seconds_upsample),
        csv_number(step.seconds_fine), std::to_string(step.coarse_iterations),
        std::to_string(step.fine_iterations), std::to_string(step.fine_dofs),
        std::to_string(step.ranks)})
    row.push_back(field);
  steps->append(row);
}

void StrainOutput::write_unreached(const StrainLevel &level, const meshes::Sheet &sheet)
{
  std::vector<std::string> row = error_keys(level, "unreached");
  row.push_back(std::to_string(sheet.n1));
  row.push_back(std::to_string(2 * sheet.n1 * sheet.n2));
  row.push_back(std::to_string(sheet.mesh.n_triangles()));
  row.resize(strain_columns().size());
  strain->append(row);
}

std::string StrainOutput::write_note(const StrainLevel &level, std::string text)
{
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  text                         = text.substr(0, text.find("; residual norms"));
  std::vector<std::string> row = level_keys(level);
  const std::string line =
    row[0] + ", " + row[1] + ", " + row[2] + " reference at strain " + row[3] + ": " + text;
  row.push_back(text);
  if (!note_table->contains(row))
    note_table->append(row);
  return line;
}

void StrainOutput::write_validity() const
{
  std::string text;
  const auto line = [&](const std::vector<std::string> &fields)
  {
    for (std::size_t k = 0; k < fields.size(); ++k)
      text += (k > 0 ? "," : "") + fields[k];
    text += "\n";
  };
  line(validity_columns());
  for (const std::vector<std::string> &row : validity_rows(strain->rows()))
    line(row);
  write_whole(folder + "/validity.csv", text);
}

std::vector<std::string> StrainOutput::notes() const
{
  std::vector<std::string> sentences;
  for (const std::vector<std::string> &row : note_table->rows())
    sentences.push_back(row[0] + ", " + row[1] + ", " + row[2] + " at strain " + row[3] + ": " +
                        row[4]);
  return sentences;
}

int StrainOutput::n_unreached() const
{
  return static_cast<int>(std::count_if(strain->rows().begin(), strain->rows().end(),
                                        [](const std::vector<std::string> &row)
                                        { return row[4] == "unreached"; }));
}
} // namespace homespun::verification
