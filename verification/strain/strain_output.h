// SPDX-License-Identifier: MIT
// What a strain study leaves on the disk as it goes on: the tables strain.csv (errors), forces.csv,
// levels.csv (times, ellipticity, remarks), uncertainty.csv, budget.csv, cross-checks.csv and
// runtime.csv, and at its end gains.csv and validity.csv. First rank alone.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/reference_uncertainty.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_tables.h"

#include <Eigen/Core>

#include <functional>
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

/// What is written of a method at a level.
struct StrainErrors
{
  Eigen::VectorXd distance;      ///< from the reference, per fine vertex [m]
  double fluctuation = 0.;       ///< of the reference, mean over the vertices [m]
  ReferenceBar reference_bar;    ///< [m]
  ErrorBar bar;                  ///< of the mean [m]
  double seconds           = 0.; ///< of the method
  double seconds_reference = 0.;
};

/// The norms of an error in a row that has the keys and sizes of the level.
void set_errors(StrainRow &row, const Eigen::VectorXd &distance, const meshes::Sheet &sheet,
                double fluctuation);

/// Tables in a folder. Rows that are there already are not written again.
class StrainOutput
{
public:
  /// Takes up the tables that the options ask for, or begins them.
  /// @throws BadInput where a table is damaged
  /// @param tell receives each note as it is written
  StrainOutput(const StrainStudyOptions &options, std::function<void(const std::string &)> tell);

  /// Whether a level has a row of every method that has a meaning for its law, or is known to have
  /// no equilibrium.
  bool is_complete(const StrainLevel &level) const;

  bool has_errors(const StrainLevel &level, const std::string &method) const;

  bool is_unreached(const StrainLevel &level) const;

  void write_errors(const StrainLevel &level, const std::string &method, const meshes::Sheet &sheet,
                    int n_coarse_triangles, const StrainErrors &errors);

  /// @param step its keys are those of the level
  void write_step(const StrainLevel &level, LevelRow step);

  /// Whether the triangles of a part are elliptic at a level.
  void write_ellipticity(const LevelRow &of_part)
  {
    levels.append_if_missing(of_part);
  }

  void write_forces(const ForceRow &row)
  {
    forces.append_if_missing(row);
  }

  /// A level at which a method alone has no equilibrium: a row without errors.
  void write_without_errors(const StrainLevel &level, const std::string &method,
                            const meshes::Sheet &sheet, int n_coarse_triangles);

  /// A level without equilibrium.
  void write_unreached(const StrainLevel &level, const meshes::Sheet &sheet);

  /// A remark on a level, for the report and the terminal.
  void write_note(const StrainLevel &level, std::string text);

  /// gains.csv and validity.csv, from all rows of strain.csv and levels.csv.
  void write_gains() const;

  /// Every note of the study, those of earlier runs too. Ready sentences.
  std::vector<std::string> notes() const;

  const std::vector<StrainRow> &strain_rows() const
  {
    return strain.rows();
  }

  const std::vector<LevelRow> &level_rows() const
  {
    return levels.rows();
  }

  const std::vector<ForceRow> &force_rows() const
  {
    return forces.rows();
  }

  Table<UncertaintyRow> uncertainty;
  std::unique_ptr<Table<BudgetRow>> budget;     ///< none where it is left out
  std::unique_ptr<Table<CrossCheckRow>> checks; ///< with the budget
  std::unique_ptr<Table<RunTimeRow>> run_time;  ///< none where it is left out

private:
  const std::string folder;
  const std::vector<std::string> methods;
  const std::function<void(const std::string &)> tell;
  Table<StrainRow> strain;
  Table<LevelRow> levels;
  Table<ForceRow> forces;
};
} // namespace homespun::verification
