// SPDX-License-Identifier: MIT
// What a strain study leaves on the disk as it goes on: the tables strain.csv (errors), steps.csv (times),
// uncertainty.csv, notes.csv, budget.csv and runtime.csv, and at its end validity.csv. First rank alone.
#pragma once

#include "meshes/sheet.h"
#include "verification/laws.h"
#include "verification/result_files.h"
#include "verification/strain_study.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What rows are named after.
struct StrainLevel
{
  std::string cell, load;
  Law law;
  double strain;
};

/// A row of strain.csv.
struct StrainErrors
{
  Eigen::VectorXd distance;      ///< from the reference, per fine vertex [m]
  double fluctuation       = 0.; ///< mean over the vertices [m]
  double side              = 0.; ///< of the cell [m]
  double uncertainty       = 0.; ///< of the reference [m]
  double seconds           = 0.; ///< of the method
  double seconds_reference = 0.;
};

/// A row of steps.csv.
struct StrainStep
{
  double seconds_coarse = 0., seconds_upsample = 0., seconds_fine = 0.;
  int coarse_iterations        = 0;
  unsigned int fine_iterations = 0;
  unsigned long fine_dofs      = 0;
  unsigned int ranks           = 1;
};

/// Tables in a folder. Rows that are there already are not written again.
class StrainOutput
{
public:
  /// Opens the tables that the options ask for, or takes them up.
  /// @throws BadInput where a table has another header
  explicit StrainOutput(const StrainStudyOptions &options);

  /// Whether a level has a row of every method that has a meaning for its law, or is known to have no equilibrium.
  bool is_complete(const StrainLevel &level) const;

  bool has_errors(const StrainLevel &level, const std::string &method) const;

  bool is_unreached(const StrainLevel &level) const;

  void write_errors(const StrainLevel &level, const std::string &method, const meshes::Sheet &sheet,
                    int n_coarse_triangles, const StrainErrors &errors);

  void write_step(const StrainLevel &level, const StrainStep &step);

  /// A level without equilibrium.
  void write_unreached(const StrainLevel &level, const meshes::Sheet &sheet);

  /// A remark on a level, for the report.
  /// @return the line for the terminal
  std::string write_note(const StrainLevel &level, std::string text);

  /// validity.csv, from all rows of strain.csv.
  void write_validity() const;

  /// Every note of the study, those of earlier runs too. Ready sentences.
  std::vector<std::string> notes() const;

  /// Levels without equilibrium, among all rows.
  int n_unreached() const;

  const std::vector<std::vector<std::string>> &strain_rows() const
  {
    return strain->rows();
  }

  /// uncertainty.csv; and budget.csv and runtime.csv, null where they are left out.
  const std::unique_ptr<ResultTable> uncertainty, budget, run_time;

private:
  const std::string folder;
  const std::vector<std::string> methods;
  const std::unique_ptr<ResultTable> strain, steps, note_table;
};
} // namespace homespun::verification
